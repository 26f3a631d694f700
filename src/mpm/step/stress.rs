//! Strains and stresses, the same for every basis and transfer.

use super::setup::Setup;
use super::solver::Solver;
use crate::mpm::effect::strain;
use crate::mpm::foundation::frame::FrameName;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::material::StressUpdate;
use crate::subject::{Failure, Site};

impl<const D: usize> Solver<D> {
    /// Deformation, stress and volume from the velocity gradients of the particles.
    pub(in crate::mpm) fn stress(&mut self, dt: f64) -> Result<(), Failure> {
        let Setup { particles, material, frame, effects, kernel, grid, .. } = &mut self.setup;
        if *frame == FrameName::Total {
            particles.push_gradients_forward();
        }
        for effect in effects.iter_mut() {
            self.transfers += effect.map_velocity(dt, kernel.as_ref(), grid, particles);
        }
        let least_j = strain(effects, material.as_mut(), StressUpdate::straining(dt, particles));
        if let Some(least) = least_j {
            self.min_j = self.min_j.min(least);
        } else {
            self.jacobians()?;
        }
        let Setup { particles, material, .. } = &self.setup;
        // A law of F takes J from F: each number of F is a factor in J, which is finite by now.
        if !material.reads_deformation() {
            particles.deformed_finite()?;
        }
        if least_j.is_none() { particles.stressed_finite() } else { Ok(()) }
    }

    /// `J = V / V0` of every particle, of which one may fail: the smallest so far is kept.
    fn jacobians(&mut self) -> Result<(), Failure> {
        let Particles { vol, vol0, .. } = &self.setup.particles;
        for (p, (vol, vol0)) in vol.iter().zip(vol0).enumerate() {
            let (j, site) = (vol / vol0, Site::Particle(p));
            if !j.is_finite() {
                return Err(Failure::NonFinite { quantity: "J", site });
            }
            self.min_j = self.min_j.min(j);
            if j <= 0.0 {
                return Err(Failure::Inverted { site, j });
            }
        }
        Ok(())
    }
}
