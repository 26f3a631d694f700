//! A polytropic gas, `sigma = -p I`, `p = K rho^g`, with the energy `p J/(g - 1)` per unit of
//! reference volume (Landau & Lifshitz 1987, section 83, with K constant over the body).
//!
//! The pressure is a function of the current density `rho = m/V`, the particle mass divided by the
//! particle volume. Each particle therefore has its own reference density `m/V0`, which may vary
//! over the body. The pressure is not zero at J = 1. Pressure and energy tend to zero under
//! infinite expansion.
//!
//! The volume is integrated as `J *= det(I + grad v dt)`. F is not stored.

use super::contract::{Material, MaterialProperties};
use super::stress_update::{StressBlock, StressUpdate};
use crate::mpm::foundation::algebra::{Matrix, det, identity};
use crate::mpm::foundation::particles::Particles;
use mpm_subject::Failure;

/// An inviscid gas whose pressure is a power of its density.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Polytropic {
    stiffness: f64,
    exponent: f64,
}

impl Polytropic {
    /// Creates the law from the stiffness K (Pa (m3/kg)^g) and the exponent g, which must be above
    /// one.
    pub fn new(stiffness: f64, exponent: f64) -> Self {
        Self { stiffness, exponent }
    }

    /// Returns the pressure (Pa) at the current density `density` (kg/m3).
    fn pressure(&self, density: f64) -> f64 {
        self.stiffness * libm::pow(density, self.exponent)
    }
}

impl MaterialProperties for Polytropic {
    fn wave_modulus(&self, density: f64) -> f64 {
        self.exponent * self.pressure(density)
    }

    /// Returns the wave speed, also at zero density, where the modulus divided by the density is
    /// NaN.
    fn wave_speed(&self, density: f64) -> f64 {
        (self.exponent * self.stiffness * libm::pow(density, self.exponent - 1.0)).sqrt()
    }

    fn starts_stressed(&self) -> Result<(), &'static str> {
        Err("a gas at rest has the pressure of its density: state an `initial_displacement`")
    }
}

impl<const D: usize> Material<D> for Polytropic {
    fn start_deformed(&mut self, particles: &mut Particles<D>) -> Result<(), Failure> {
        self.update(&mut StressUpdate::new(0.0, particles));
        Ok(())
    }

    fn reads_deformation(&self) -> bool {
        false
    }

    fn is_stressed_at_rest(&self) -> bool {
        true
    }

    fn energy(&self, particles: &Particles<D>) -> Option<f64> {
        let all = particles.vol.iter().zip(&particles.mass);
        let work: f64 = all.map(|(vol, mass)| vol * self.pressure(mass / vol)).sum();
        Some(work / (self.exponent - 1.0))
    }

    fn update(&mut self, body: &mut StressUpdate<'_, D>) {
        let dt = body.dt();
        body.by_block(|StressBlock { grad_v, mass, vol, sigma, .. }| {
            let volumes = vol.iter_mut().zip(mass.iter());
            for ((grad_v, (vol, mass)), sigma) in grad_v.iter().zip(volumes).zip(sigma.iter_mut()) {
                *vol *= det(&(identity() + grad_v * dt));
                *sigma = Matrix::from_diagonal_element(-self.pressure(mass / *vol));
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;

    /// Expects c = sqrt(g K rho^(g - 1)).
    #[test]
    fn wave_speed_vanishes_with_the_density() {
        let gas = Polytropic::new(2.0, 3.0);
        assert_relative_eq!(gas.wave_speed(0.5), 1.5_f64.sqrt(), max_relative = 1e-15);
        assert_eq!(gas.wave_speed(0.0).to_bits(), 0);
    }
}
