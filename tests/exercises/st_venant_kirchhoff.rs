//! St. Venant-Kirchhoff elasticity: the law of small strains between S and the Green strain.
//!
//! `sigma = F S F^T/J`, `S = lambda tr(E) I + 2 mu E`, `E = (F^T F - I)/2` (Bonet & Wood 2008,
//! section 6.3). Derived from the energy `W = lambda/2 tr(E)^2 + mu E : E`. Softens under strong
//! compression. Fewer than three dimensions mean plane or uniaxial strain.

use crate::mpm::foundation::algebra::Matrix;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::material::contract::{Material, MaterialProperties};
use crate::mpm::material::hyperelastic::{set_stress_by_batch, stored_energy};
use crate::mpm::material::linear_elastic::LinearElastic;
use crate::mpm::material::stress_update::StressUpdate;

/// St. Venant-Kirchhoff elasticity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StVenantKirchhoff {
    lambda: f64,
    mu: f64,
}

impl StVenantKirchhoff {
    /// From Young's modulus (Pa) and Poisson's ratio.
    pub fn new(young: f64, poisson: f64) -> Self {
        let LinearElastic { lambda, mu } = LinearElastic::new(young, poisson);
        Self { lambda, mu }
    }

    /// Cauchy stress (Pa), `F S F^T/J`.
    fn cauchy<const D: usize>(&self, f: &Matrix<D>, j: f64) -> Matrix<D> {
        let strain = green_strain(f);
        let pressure = Matrix::identity() * (self.lambda * strain.trace());
        f * (pressure + strain * (2.0 * self.mu)) * f.transpose() / j
    }

    /// W (J/m^D).
    fn density<const D: usize>(&self, f: &Matrix<D>) -> f64 {
        let strain = green_strain(f);
        let trace = strain.trace();
        0.5 * self.lambda * trace * trace + self.mu * strain.norm_squared()
    }
}

/// `E = (H + H^T + H^T H)/2`, of `H = F - I`: small strains keep their digits.
fn green_strain<const D: usize>(f: &Matrix<D>) -> Matrix<D> {
    let h = f - Matrix::identity();
    (h + h.transpose() + h.transpose() * h) * 0.5
}

impl MaterialProperties for StVenantKirchhoff {
    fn wave_modulus(&self, _: f64) -> f64 {
        self.lambda + 2.0 * self.mu
    }

    fn depends_on_deformation_alone(&self) -> Result<(), &'static str> {
        Ok(())
    }

    fn is_elastic(&self) -> bool {
        true
    }
}

impl<const D: usize> Material<D> for StVenantKirchhoff {
    fn reads_deformation(&self) -> bool {
        true
    }

    fn energy(&self, particles: &Particles<D>) -> Option<f64> {
        Some(stored_energy(particles, |f| self.density(f)))
    }

    fn update(&mut self, body: &mut StressUpdate<'_, D>) {
        set_stress_by_batch(body, |j| [*j], |f, [j]| self.cauchy(f, j));
    }
}
