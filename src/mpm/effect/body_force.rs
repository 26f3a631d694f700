//! A body force that depends on the particle: b(X, t), as manufactured solutions need.
//!
//! `f_ext_i = sum_p m_p b(X_p, t) N_i(x_p)`.

use super::contract::Effect;
use crate::mpm::algebra::Vector;
use crate::mpm::grid::Grid;
use crate::mpm::kernel::contract::Kernel;
use crate::mpm::particles::Particles;
use crate::subject::Column;

/// Writes the force per unit mass (m/s2) of every particle at a time (s), from their reference
/// positions. The particles of a run, their order and their reference positions never change.
pub type ForceField<const D: usize> = Box<dyn FnMut(f64, &[Vector<D>], &mut [Vector<D>]) + Send>;

/// A body force b(X, t) (m/s2).
pub struct BodyForce<const D: usize> {
    field: ForceField<D>,
    /// Of every particle, at the present time.
    b: Vec<Vector<D>>,
}

impl<const D: usize> BodyForce<D> {
    /// A body force that `field` gives.
    pub fn new(field: ForceField<D>) -> Self {
        Self { field, b: Vec::new() }
    }

    /// A body force that is computed for one particle at a time, from X and t.
    pub fn pointwise(b: impl Fn(&Vector<D>, f64) -> Vector<D> + Send + 'static) -> Self {
        Self::new(Box::new(move |t, labels, into| {
            for (into, label) in into.iter_mut().zip(labels) {
                *into = b(label, t);
            }
        }))
    }
}

impl<const D: usize> Effect<D> for BodyForce<D> {
    fn name(&self) -> &'static str {
        "body_force"
    }

    fn columns(&self) -> Vec<Column> {
        vec![Column::of_particles("b", &self.b)]
    }

    fn add_force(
        &mut self,
        t: f64,
        particles: &Particles<D>,
        kernel: &dyn Kernel<D>,
        grid: &mut Grid<D>,
    ) -> u64 {
        self.b.resize(particles.len(), Vector::zeros());
        (self.field)(t, &particles.x0, &mut self.b);
        for (p, (b, mass)) in self.b.iter().zip(&particles.mass).enumerate() {
            kernel.p2g_point_force(particles, p, &(b * *mass), grid);
        }
        particles.len() as u64 * kernel.support()
    }
}
