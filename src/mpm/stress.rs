//! The stage of strains and stresses: the same for every basis and transfer.

use super::{algebra::Matrix, effect::strain, frame::FrameName, setup::Setup, solver::Solver};
use crate::subject::{Failure, Site};

impl<const D: usize> Solver<D> {
    /// Deformation, stress and volume from the gradients of velocity that the particles have taken.
    pub(super) fn stress(&mut self, dt: f64) -> Result<(), Failure> {
        let Setup { particles, material, frame, effects, .. } = &mut self.setup;
        if *frame == FrameName::Total {
            particles.push_gradients_forward();
        }
        for (f, grad_v) in particles.def_grad.iter_mut().zip(&particles.grad_v) {
            *f = (Matrix::identity() + grad_v * dt) * *f;
        }
        strain(effects, material.as_mut(), dt, particles);
        for (p, (vol, vol0)) in
            self.setup.particles.vol.iter().zip(&self.setup.particles.vol0).enumerate()
        {
            let (j, site) = (vol / vol0, Site::Particle(p));
            if !j.is_finite() {
                return Err(Failure::NonFinite { quantity: "J", site });
            }
            self.min_j = self.min_j.min(j);
            if j <= 0.0 {
                return Err(Failure::Inverted { site, j });
            }
        }
        self.setup.particles.strained_finite()
    }
}
