//! The stage of strains and stresses: the same for every basis and transfer.

use super::{
    algebra::Matrix, effect::strain, frame::FrameName, particles::Particles, setup::Setup,
    solver::Solver,
};
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
        self.jacobians()?;
        self.setup.particles.strained_finite()
    }

    /// `J = V / V0` of every particle: the smallest so far is kept.
    fn jacobians(&mut self) -> Result<(), Failure> {
        let all = || {
            let Particles { vol, vol0, .. } = &self.setup.particles;
            vol.iter().zip(vol0).map(|(vol, vol0)| vol / vol0)
        };
        // As in most steps all are sound, the loop has no early way out: it divides several at a time.
        let (mut sound, mut least) = (true, self.min_j);
        for j in all() {
            sound &= j > 0.0 && j < f64::INFINITY;
            least = if j < least { j } else { least };
        }
        let broken = if sound { None } else { all().position(|j| !(j > 0.0 && j.is_finite())) };
        let Some(p) = broken else {
            self.min_j = least;
            return Ok(());
        };
        let (j, site) = (all().nth(p).unwrap_or(f64::NAN), Site::Particle(p));
        if !j.is_finite() {
            return Err(Failure::NonFinite { quantity: "J", site });
        }
        self.min_j = all().take(p + 1).fold(self.min_j, f64::min);
        Err(Failure::Inverted { site, j })
    }
}
