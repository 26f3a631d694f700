//! The centrifugal force in a frame that turns about the origin.
//!
//! `f_ext_i = sum_p m_p w(t)^2 x_p N_i(x_p)`: it acts where particles are, not where they were.

use super::contract::{BodyOnGrid, Effect};

/// The rate w(t) (1/s) at which the frame turns.
pub struct Spin(pub Box<dyn Fn(f64) -> f64 + Send>);

impl<const D: usize> Effect<D> for Spin {
    fn name(&self) -> &'static str {
        "spin"
    }

    fn add_force(&mut self, t: f64, body: &mut BodyOnGrid<'_, D>) -> u64 {
        let rate = (self.0)(t);
        let particles = body.particles;
        for (p, (x, mass)) in particles.positions().iter().zip(&particles.mass).enumerate() {
            body.add_point_force(p, &(x * (rate * rate * mass)));
        }
        body.pairs(particles.len())
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
