//! A uniform acceleration, constant or a function of time.
//!
//! `f_ext_i = sum_p m_p b N_i(x_p) = m_i b`. Because b is the same for all particles, the sum is
//! the nodal mass times b, and no particle is visited.

use super::contract::{BodyOnGrid, Effect};
use crate::mpm::foundation::algebra::Vector;

/// Gravity with the acceleration b(t) (m/s2).
pub struct Gravity<const D: usize>(pub Box<dyn Fn(f64) -> Vector<D> + Send>);

impl<const D: usize> Effect<D> for Gravity<D> {
    fn name(&self) -> &'static str {
        "gravity"
    }

    fn add_force(&mut self, t: f64, body: &mut BodyOnGrid<'_, D>) -> u64 {
        let b = (self.0)(t);
        for (f, m) in body.grid.force.iter_mut().zip(&body.grid.mass) {
            *f += b * *m;
        }
        0
    }
}
