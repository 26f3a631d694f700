//! The lattice of particles that fills a body.
//!
//! A box is filled with equal shares of itself. A round body takes the lattice that fills the cells
//! of the grid, `h/n` apart with n particles along a cell, and of it the particles whose reference
//! position lies inside. Each has its whole share, so that the rim is a stair, and volume and mass
//! differ from those of the body by a share that falls with h. A quadrilateral is filled by its
//! bilinear map, independent of the grid.

use super::Scene;
use super::grid_size::grid_axis;
use crate::dimension::with_dimension;
use crate::mpm::{Block, Vector};

/// Places of particles beside their lattice, in shares of their spacing.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LatticeOffsets {
    /// Translation of all, a share for each axis; empty: none.
    pub shift: Vec<f64>,
    /// Largest random displacement of each along an axis.
    pub perturb: f64,
    /// Seed of the random displacements.
    pub seed: u64,
}

impl LatticeOffsets {
    /// Whether particles stay on the lattice.
    pub fn is_none(&self) -> bool {
        self.perturb == 0.0 && self.shift.iter().all(|share| *share == 0.0)
    }
}

/// The box that is filled: the body's own or, around a round body, whole cells of the grid that
/// starts at `origin`.
pub(crate) fn block<const D: usize>(scene: &Scene, origin: &Vector<D>, h: f64) -> Block<D> {
    let node = |axis: usize, x: f64, round: fn(f64) -> f64| match scene.round {
        Some(_) => origin[axis] + round((x - origin[axis]) / h) * h,
        None => x,
    };
    Block {
        from: Vector::from_fn(|axis, _| node(axis, scene.from[axis], libm::floor)),
        to: Vector::from_fn(|axis, _| node(axis, scene.to[axis], libm::ceil)),
        density: scene.density,
    }
}

/// Whether some round body of the scene holds no particle with cells of size `h`.
pub(crate) fn is_vacant(scene: &Scene, h: f64, per_axis: usize) -> bool {
    fn vacant<const D: usize>(scene: &Scene, h: f64, per_axis: usize) -> bool {
        let origin = Vector::<D>::from_fn(|axis, _| grid_axis(scene, axis, h).0);
        scene.each().iter().any(|body| {
            body.round.as_ref().is_some_and(|round| {
                let block = block(body, &origin, h);
                !block.centres(h, per_axis).any(|x0| round.holds(x0.as_slice()))
            })
        })
    }
    with_dimension!(scene.dimension(), D => vacant::<D>(scene, h, per_axis))
}
