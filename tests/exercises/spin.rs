//! The centrifugal force in a frame that turns about the origin.
//!
//! `f_ext_i = sum_p m_p w(t)^2 x_p N_i(x_p)`: it acts where particles are, not where they were.

use super::contract::Effect;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::kernel::contract::Kernel;

/// The rate w(t) (1/s) at which the frame turns.
pub struct Spin(pub Box<dyn Fn(f64) -> f64 + Send>);

impl<const D: usize> Effect<D> for Spin {
    fn name(&self) -> &'static str {
        "spin"
    }

    fn add_force(
        &mut self,
        t: f64,
        particles: &Particles<D>,
        kernel: &dyn Kernel<D>,
        grid: &mut Grid<D>,
    ) -> u64 {
        let rate = (self.0)(t);
        for (p, (x, mass)) in particles.positions().iter().zip(&particles.mass).enumerate() {
            kernel.p2g_point_force(particles, p, &(x * (rate * rate * mass)), grid);
        }
        particles.len() as u64 * kernel.support()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spin_keeps_nothing_between_steps() {
        let spin = Spin(Box::new(|t| t));
        assert!(Effect::<2>::columns(&spin).is_empty());
    }
}
