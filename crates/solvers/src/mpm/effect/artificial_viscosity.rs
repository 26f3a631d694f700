//! Artificial viscosity: a pressure that resists compression and spreads shocks over a few cells.
//!
//! `q = rho l |tr D| (c1 c + c2 l |tr D|)` if `tr D < 0`, and zero otherwise, with the rate of
//! deformation D, the current density rho, the cell size l and the wave speed c at rest. The
//! quadratic term (von Neumann & Richtmyer 1950) acts in strong shocks. The linear term (Landshoff
//! 1955) damps the oscillations behind weak shocks. In smooth motion, the quadratic term is of
//! second order in l, and the linear term of first order.
//!
//! The pressure is part of the stress only while forces are computed. It is removed before the
//! material updates the stress, because a law in rate form adds increments to the old stress.

use super::contract::Effect;
use crate::mpm::foundation::particles::Particles;
use mpm_subject::Column;
use std::any::Any;

/// An artificial viscosity.
#[derive(Debug, Clone, PartialEq)]
pub struct ArtificialViscosity {
    /// Coefficient c1 of the linear term.
    pub linear: f64,
    /// Coefficient c2 of the quadratic term.
    pub quadratic: f64,
    /// Cell size l (m).
    pub length: f64,
    /// Wave speed c (m/s).
    pub speed: f64,
    /// Viscous pressure that is part of the stress of each particle (Pa); empty before the first
    /// step.
    pub q: Vec<f64>,
}

impl<const D: usize> Effect<D> for ArtificialViscosity {
    fn name(&self) -> &'static str {
        "artificial_viscosity"
    }

    fn makes_stress(&self) -> bool {
        true
    }

    fn columns(&self) -> Vec<Column<'_>> {
        vec![Column::of_particles("q", &self.q)]
    }

    fn state(&self) -> Option<Box<dyn Any>> {
        Some(Box::new(self.q.clone()))
    }

    fn set_state(&mut self, state: &dyn Any) {
        if let Some(state) = state.downcast_ref() {
            self.q.clone_from(state);
        }
    }

    fn before_stress(&mut self, particles: &mut Particles<D>) {
        for (sigma, q) in particles.sigma.iter_mut().zip(&self.q) {
            for i in 0..D {
                sigma[(i, i)] += q;
            }
        }
    }

    fn after_stress(&mut self, particles: &mut Particles<D>) {
        self.q.resize(particles.len(), 0.0);
        for (p, q) in self.q.iter_mut().enumerate() {
            let closing = -particles.grad_v[p].trace() * self.length;
            *q = 0.0;
            if closing > 0.0 {
                let density = particles.mass[p] / particles.vol[p];
                *q = density * closing * (self.linear * self.speed + self.quadratic * closing);
                for i in 0..D {
                    particles.sigma[p][(i, i)] -= *q;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mpm::{Block, LinearElastic, Material, Matrix, StressUpdate, Vector};
    use approx::assert_relative_eq;

    /// In each step one of two particles is compressed and the other one is stretched, alternately.
    #[test]
    fn compression_is_resisted_and_nothing_of_it_stays() {
        let block = Block { from: Vector::zeros(), to: Vector::<2>::new(2.0, 1.0), density: 3.0 };
        let (mut body, mut plain) =
            (Particles::fill(&block, 1.0, 1), Particles::fill(&block, 1.0, 1));
        let mut law = LinearElastic::new(1.0, 0.3);
        let mut effect = ArtificialViscosity {
            linear: 0.5,
            quadratic: 2.0,
            length: 0.1,
            speed: 4.0,
            q: Vec::new(),
        };
        for step in 0..4 {
            let rate =
                Matrix::<2>::new(-0.3, 0.2, 0.0, 0.1) * if step % 2 == 0 { 1.0 } else { -1.0 };
            for particles in [&mut body, &mut plain] {
                (particles.grad_v[0], particles.grad_v[1]) = (rate, -rate);
            }
            law.update(&mut StressUpdate::new(1e-3, &mut plain));
            effect.before_stress(&mut body);
            law.update(&mut StressUpdate::new(1e-3, &mut body));
            effect.after_stress(&mut body);
            let compressed = step % 2;
            let density = body.mass[compressed] / body.vol[compressed];
            let q = density * 0.02 * (0.5 * 4.0 + 2.0 * 0.02);
            let expected = plain.sigma[compressed] - Matrix::identity() * q;
            assert_relative_eq!(body.sigma[compressed], expected, max_relative = 1e-12);
            let (stretched, same) = (body.sigma[1 - compressed], plain.sigma[1 - compressed]);
            assert_relative_eq!(stretched, same, epsilon = 1e-15);
        }
    }
}
