//! The particle lattice that fills a body.
//!
//! A box is divided into equal parts. Other bodies use a lattice on the grid cells, with spacing
//! `h/n` for n particles along a cell. The outline determines which part of each lattice cell is in
//! the body ([`Outline::cut`](crate::exact::Outline::cut)): all or nothing for a round body, the
//! exact intersection for a polygon. A quadrilateral is filled by its bilinear map, independently
//! of the grid.

use super::Scene;
use super::grid_axis;
use crate::exact::Cut;
use crate::mpm::input::visit_lattice;

/// Offsets of particles from their lattice points, as shares of the particle spacing.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LatticeOffsets {
    /// Translation of all particles as a share of the spacing, one number per axis; empty for none.
    pub shift: Vec<f64>,
    /// Maximum random displacement of each particle along an axis.
    pub perturb: f64,
    /// Seed of the random displacements.
    pub seed: u64,
}

impl LatticeOffsets {
    /// Whether all particles are on the lattice.
    pub fn is_none(&self) -> bool {
        self.perturb == 0.0 && self.shift.iter().all(|share| *share == 0.0)
    }
}

/// Returns the corners (m) of the body if it is a box, otherwise those of whole grid cells.
pub(crate) fn lattice_ends(body: &Scene, scene: &Scene, h: f64) -> (Vec<f64>, Vec<f64>) {
    let node = |axis: usize, x: f64, round: fn(f64) -> f64| {
        let origin = grid_axis(scene, axis, h).0;
        if body.outline.is_some() { origin + round((x - origin) / h) * h } else { x }
    };
    let end = |ends: &[f64], round| {
        ends.iter().enumerate().map(|(axis, x)| node(axis, *x, round)).collect()
    };
    (end(&body.from, libm::floor), end(&body.to, libm::ceil))
}

/// Whether a body with a free surface is smaller than one particle volume, for cell size `h`.
pub(crate) fn is_vacant(scene: &Scene, h: f64, per_axis: usize) -> bool {
    scene.each().iter().filter(|body| body.outline.is_some() && body.mapped.is_none()).any(|body| {
        let mut shares = 0.0;
        !any_particle(body, scene, h, per_axis, |_, share| {
            shares += share;
            shares >= 1.0 - 1e-9
        })
    })
}

/// Whether `holds` returns true for a particle of a `body` with a free surface, given its position
/// (m) and its share of a lattice cell.
pub(crate) fn any_particle(
    body: &Scene,
    scene: &Scene,
    h: f64,
    per_axis: usize,
    mut holds: impl FnMut(&[f64], f64) -> bool,
) -> bool {
    let Some(outline) = &body.outline else { return false };
    let (from, to) = lattice_ends(body, scene, h);
    visit_lattice((&from, &to), h, per_axis, &mut |centre, half| {
        let cell = || half.iter().map(|half| 2.0 * half).product::<f64>();
        match outline.cut(centre, half) {
            Cut::Nothing => false,
            Cut::Whole => holds(centre, 1.0),
            Cut::Pieces(all) => all.iter().any(|one| holds(&one.place, one.volume / cell())),
        }
    })
}
