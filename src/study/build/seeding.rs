//! Bodies filled with particles.
//!
//! A box is filled with equal shares of itself. A round body takes the lattice that fills the cells
//! of the grid, `h/n` apart with n particles along a cell, and of it the particles whose reference
//! position lies inside: each has its whole share, so the rim is a stair, and volume and mass are
//! those of the body but for a share that falls with h. A quadrilateral is filled by its bilinear map, and
//! knows no grid.

use crate::{
    mpm::{Block, Particles, Vector},
    suite::model::Scene,
};

/// The particles of a scene on a grid that starts at `origin`, with cells of size `h`.
pub(crate) fn particles<const D: usize>(
    scene: &Scene,
    origin: &Vector<D>,
    h: f64,
    per_axis: usize,
) -> Particles<D> {
    if let Some(panel) = &scene.quadrilateral {
        return panel.fill(scene.density, h, per_axis);
    }
    Particles::fill_where(&block(scene, origin, h), h, per_axis, |x0| holds(scene, x0))
}

/// Whether the lattice misses the body.
pub(crate) fn is_empty<const D: usize>(
    scene: &Scene,
    origin: &Vector<D>,
    h: f64,
    per_axis: usize,
) -> bool {
    let block = block(scene, origin, h);
    let mut centres = block.centres(h, per_axis);
    !centres.any(|x0| holds(scene, &x0))
}

fn holds<const D: usize>(scene: &Scene, x0: &Vector<D>) -> bool {
    scene.round.as_ref().is_none_or(|round| round.holds(x0.as_slice()))
}

/// The box that is to be filled: the body's own or, around a round body, whole cells of the grid.
fn block<const D: usize>(scene: &Scene, origin: &Vector<D>, h: f64) -> Block<D> {
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

/// Particles that are not where the lattice has them.
#[derive(Debug, Clone, Default)]
pub(crate) struct Placed {
    /// What every particle is moved by (m), one number for each axis; empty: nothing.
    pub(crate) shift: Vec<f64>,
    /// Places of further particles (m), each like the first particle of the lattice.
    pub(crate) extra: Vec<Vec<f64>>,
}

impl Placed {
    /// Moves and adds particles.
    pub(crate) fn put<const D: usize>(&self, particles: &mut Particles<D>) {
        let vector =
            |numbers: &[f64]| Vector::<D>::from_fn(|i, _| numbers.get(i).copied().unwrap_or(0.0));
        let shift = vector(&self.shift);
        particles.x0.iter_mut().for_each(|x| *x += shift);
        for place in &self.extra {
            particles.add(vector(place));
        }
        particles.x.clone_from(&particles.x0);
    }
}
