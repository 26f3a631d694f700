//! A weakly compressible Newtonian fluid.
//!
//! `sigma = -p I + 2 eta dev(D)`, `D = sym(grad v)`, with Tait's equation of state in Cole's form,
//! `p = K/7 (J^-7 - 1)` (Cole 1948; Monaghan 1994). K is the bulk modulus at rest. The pressure has
//! no upper limit, so particles do not collapse under compression. The deviator is
//! three-dimensional for bodies of any dimension, `dev(D) = D - tr(D)/3 I`.
//!
//! The pressure depends only on J, which is integrated as `J *= det(I + grad v dt)`. F is not
//! stored, because it grows without limit in a flow.

use super::contract::{Material, MaterialProperties};
use super::stress_update::{StressBlock, StressUpdate};
use crate::mpm::foundation::algebra::{det, identity};
use crate::mpm::foundation::particles::Particles;
use mpm_subject::Failure;

/// A weakly compressible viscous fluid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Newtonian {
    bulk: f64,
    viscosity: f64,
}

impl Newtonian {
    /// Creates the law from the bulk modulus at rest (Pa) and the dynamic viscosity (Pa s).
    pub fn new(bulk: f64, viscosity: f64) -> Self {
        Self { bulk, viscosity }
    }

    #[inline]
    fn pressure(&self, j: f64) -> f64 {
        let cube = 1.0 / (j * j * j);
        self.bulk / 7.0 * (cube * cube / j - 1.0)
    }
}

impl MaterialProperties for Newtonian {
    fn wave_modulus(&self, _: f64) -> f64 {
        self.bulk
    }

    fn depends_on_deformation_alone(&self) -> Result<(), &'static str> {
        Err("viscous stress depends on the rate of deformation")
    }

    fn takes_averaged_volume(&self) -> Result<(), &'static str> {
        Ok(())
    }

    fn starts_stressed(&self) -> Result<(), &'static str> {
        Err("a fluid at rest has the pressure of its volume: state an `initial_displacement`")
    }

    fn starts_deformed(&self) -> Result<(), &'static str> {
        Ok(())
    }
}

impl<const D: usize> Material<D> for Newtonian {
    /// Sets the pressure from J and the viscous stress from the velocity gradient.
    fn start_deformed(&mut self, particles: &mut Particles<D>) -> Result<(), Failure> {
        self.update(&mut StressUpdate::new(0.0, particles));
        Ok(())
    }

    fn reads_deformation(&self) -> bool {
        false
    }

    fn reads_rate(&self) -> bool {
        true
    }

    /// Returns the energy of the pressure, with density `K/7 (J^-6/6 + J - 7/6)`.
    fn energy(&self, particles: &Particles<D>) -> Option<f64> {
        let density = |j: f64| {
            let cube = 1.0 / (j * j * j);
            self.bulk / 7.0 * (cube * cube / 6.0 + j - 7.0 / 6.0)
        };
        let all = particles.vol.iter().zip(&particles.vol0);
        Some(all.map(|(vol, vol0)| vol0 * density(vol / vol0)).sum())
    }

    fn update(&mut self, body: &mut StressUpdate<'_, D>) {
        let dt = body.dt();
        body.by_block(|StressBlock { grad_v, vol, vol0, sigma, .. }| {
            let volumes = vol.iter_mut().zip(vol0.iter());
            for ((grad_v, (vol, vol0)), sigma) in grad_v.iter().zip(volumes).zip(sigma.iter_mut()) {
                *vol *= det(&(identity() + grad_v * dt));
                let pressure = self.pressure(*vol / vol0);
                let isotropic = -pressure - 2.0 / 3.0 * self.viscosity * grad_v.trace();
                let shear = (grad_v + grad_v.transpose()) * self.viscosity;
                *sigma = identity() * isotropic + shear;
            }
        });
    }
}
