//! A body force per particle: b(X, t), for manufactured solutions, or b(X, t, u), for example the
//! force of an elastic foundation, `b = -k u/rho0` (Winkler 1867).
//!
//! `f_ext_i = sum_p m_p b(X_p, t, x_p - X_p) N_i(x_p)`. Displacement and stress are both taken at
//! the start of the step, so the order of the leapfrog method does not change.

use super::contract::{BodyOnGrid, Effect};
use crate::mpm::foundation::algebra::{Vector, zeros};
use crate::mpm::foundation::particles::Particles;
use mpm_subject::Column;

/// Function that writes the force per unit mass (m/s2) of every particle at a time (s), from the
/// reference and current positions of the particles. During a run, the particles, their order and
/// their reference positions do not change.
pub type ForceField<const D: usize> = Box<dyn FnMut(f64, &Particles<D>, &mut [Vector<D>]) + Send>;

/// A body force b (m/s2).
pub struct BodyForce<const D: usize> {
    field: ForceField<D>,
    /// Body force of every particle at the current time (m/s2).
    b: Vec<Vector<D>>,
    stiffness: f64,
}

impl<const D: usize> BodyForce<D> {
    /// Creates a body force that `field` computes.
    pub fn new(field: ForceField<D>) -> Self {
        Self { field, b: Vec::new(), stiffness: 0.0 }
    }

    /// Creates a body force that is computed for each particle from X and t.
    pub fn pointwise(b: impl Fn(&Vector<D>, f64) -> Vector<D> + Send + 'static) -> Self {
        Self::new(Box::new(move |t, particles, into| {
            for (into, label) in into.iter_mut().zip(&particles.x0) {
                *into = b(label, t);
            }
        }))
    }

    /// Sets the stiffness: the largest eigenvalue of -db/du (1/s2) over the particles at the start.
    #[must_use]
    pub fn with_stiffness(self, stiffness: f64) -> Self {
        Self { stiffness, ..self }
    }
}

impl<const D: usize> Effect<D> for BodyForce<D> {
    fn name(&self) -> &'static str {
        "body_force"
    }

    fn columns(&self) -> Vec<Column<'_>> {
        vec![Column::of_particles("b", &self.b)]
    }

    fn stiffness(&self) -> f64 {
        self.stiffness
    }

    fn add_force(&mut self, t: f64, body: &mut BodyOnGrid<'_, D>) -> u64 {
        let BodyOnGrid { particles, kernel, grid } = body;
        self.b.resize(particles.len(), zeros());
        (self.field)(t, particles, &mut self.b);
        kernel.p2g_body_force(particles, &self.b, grid);
        body.pairs(self.b.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pointwise_force_stays_with_its_particle() {
        let mut particles = Particles::cubes([2]);
        particles.x.iter_mut().for_each(|x| x[0] += 0.25);
        let mut b = vec![Vector::zeros(); 2];
        (BodyForce::pointwise(|label, t| label * t).field)(3.0, &particles, &mut b);
        assert_eq!(b, [Vector::<1>::new(1.5), Vector::<1>::new(4.5)]);
    }
}
