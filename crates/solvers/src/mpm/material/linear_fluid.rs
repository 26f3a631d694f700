//! An inviscid fluid with linear compressibility: the medium of linear acoustics.
//!
//! `sigma = -p I`, `p = -K (J - 1)`, from the energy `K/2 (J - 1)^2`. In uniaxial strain
//! `P = K u_X` for any amplitude, so plane waves of finite strain retain their shape. (In other
//! fluids, waves steepen because p is a nonlinear function of the specific volume: Landau &
//! Lifshitz 1987, section 101.) To first order in the strain, `p = c^2 (rho - rho0)`,
//! `c^2 = K/rho0`. The pressure at collapse, J = 0, is finite: p = K.
//!
//! The stress depends only on J, which is integrated as `J *= det(I + grad v dt)`.

use super::contract::{Material, MaterialProperties};
use super::stress_update::{StressBlock, StressUpdate};
use crate::mpm::foundation::algebra::{det, identity};
use crate::mpm::foundation::particles::Particles;
use mpm_subject::Failure;

/// An inviscid, linearly compressible fluid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearFluid {
    bulk: f64,
}

impl LinearFluid {
    /// Creates the law from the bulk modulus (Pa).
    pub fn new(bulk: f64) -> Self {
        Self { bulk }
    }
}

impl MaterialProperties for LinearFluid {
    fn wave_modulus(&self, _: f64) -> f64 {
        self.bulk
    }

    fn starts_stressed(&self) -> Result<(), &'static str> {
        Err("a fluid at rest has the pressure of its volume: state an `initial_displacement`")
    }
}

impl<const D: usize> Material<D> for LinearFluid {
    fn start_deformed(&mut self, particles: &mut Particles<D>) -> Result<(), Failure> {
        self.update(&mut StressUpdate::new(0.0, particles));
        Ok(())
    }

    fn reads_deformation(&self) -> bool {
        false
    }

    fn energy(&self, particles: &Particles<D>) -> Option<f64> {
        let density = |j: f64| 0.5 * self.bulk * (j - 1.0) * (j - 1.0);
        let all = particles.vol.iter().zip(&particles.vol0);
        Some(all.map(|(vol, vol0)| vol0 * density(vol / vol0)).sum())
    }

    fn update(&mut self, body: &mut StressUpdate<'_, D>) {
        let dt = body.dt();
        body.by_block(|StressBlock { grad_v, vol, vol0, sigma, .. }| {
            let volumes = vol.iter_mut().zip(vol0.iter());
            for ((grad_v, (vol, vol0)), sigma) in grad_v.iter().zip(volumes).zip(sigma.iter_mut()) {
                *vol *= det(&(identity() + grad_v * dt));
                let dilation = *vol / vol0 - 1.0;
                *sigma = identity() * (self.bulk * dilation);
            }
        });
    }
}
