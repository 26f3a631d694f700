//! Bodies filled with particles, see [`lattice`](crate::suite::model::lattice).

use crate::exact::Random;
use crate::mpm::{Particles, Vector};
use crate::suite::model::Scene;
use crate::suite::model::lattice::{LatticeOffsets, block};
use crate::suite::model::stability::LatticeEdits;

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
    Particles::fill_where(&block(scene, origin, h), h, per_axis, |x0| {
        scene.round.as_ref().is_none_or(|round| round.holds(x0.as_slice()))
    })
}

impl LatticeEdits {
    /// Moves and adds particles.
    pub(crate) fn apply<const D: usize>(&self, particles: &mut Particles<D>) {
        let vector =
            |numbers: &[f64]| Vector::<D>::from_fn(|i, _| numbers.get(i).copied().unwrap_or(0.0));
        let shift = vector(&self.shift);
        particles.x0.iter_mut().for_each(|x| *x += shift);
        if !self.scatter.is_none() {
            let LatticeOffsets { shift, perturb, seed } = &self.scatter;
            let (shift, spacing) = (vector(shift), particles.spacing);
            let mut random = Random::new(*seed);
            for x in &mut particles.x0 {
                let mut share = |axis: usize| shift[axis] + perturb * random.between(-1.0, 1.0);
                *x += Vector::from_fn(|axis, _| share(axis) * spacing[axis]);
            }
        }
        for place in &self.extra {
            particles.add(vector(place));
        }
        particles.x.clone_from(&particles.x0);
    }
}
