//! A body force that depends on the particle: b(X, t), as manufactured solutions need.
//!
//! `f_ext_i = sum_p m_p b(X_p, t) N_i(x_p)`.

use super::contract::Effect;
use crate::mpm::{algebra::Vector, grid::Grid, kernel::Kernel, particles::Particles};

/// Force per unit mass (m/s2) as a function of reference position and time.
pub type Field<const D: usize> = Box<dyn Fn(&Vector<D>, f64) -> Vector<D> + Send>;

/// A body force b(X, t) (m/s2).
pub struct BodyForce<const D: usize>(pub Field<D>);

impl<const D: usize> Effect<D> for BodyForce<D> {
    fn add_force(
        &self,
        t: f64,
        particles: &Particles<D>,
        kernel: &dyn Kernel<D>,
        grid: &mut Grid<D>,
    ) -> u64 {
        for (p, (x0, mass)) in particles.x0.iter().zip(&particles.mass).enumerate() {
            kernel.p2g_point_force(particles, p, &((self.0)(x0, t) * *mass), grid);
        }
        particles.len() as u64 * kernel.support()
    }
}
