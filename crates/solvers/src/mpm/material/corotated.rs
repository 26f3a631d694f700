//! Fixed corotated elasticity: the small-strain law, with the principal stretches minus one as
//! strains.
//!
//! `sigma = (2 mu/J) (F - R) F^T + lambda (J - 1) I`, with the rotation R of `F = V R` (Stomakhin,
//! Howes, Schroeder & Teran 2012, SCA, "Energetically consistent invertible elasticity"; Jiang et
//! al. 2016, SIGGRAPH Courses, section 6.3). The stress derives from the energy
//! `W = mu sum (s_i - 1)^2 + lambda/2 (J - 1)^2` of the principal stretches s_i. In uniaxial strain
//! P is linear in the displacement gradient. The law assumes plane strain in 2-D and uniaxial
//! strain in 1-D.

use super::contract::{Material, MaterialProperties};
use super::hyperelastic::{linear, set_stress_of_stretch, stored_energy};
use super::linear_elastic::LinearElastic;
use super::spectral::spectral;
use super::stress_update::StressUpdate;
use super::stretch::SquaredStretch;
use crate::mpm::foundation::algebra::{Matrix, det, product};
use crate::mpm::foundation::particles::Particles;

/// Fixed corotated elasticity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Corotated {
    lambda: f64,
    mu: f64,
}

impl Corotated {
    /// Creates the law from Young's modulus (Pa) and Poisson's ratio.
    pub fn new(young: f64, poisson: f64) -> Self {
        let LinearElastic { lambda, mu } = LinearElastic::new(young, poisson);
        Self { lambda, mu }
    }

    /// Returns the energy density W (J/m^D).
    fn density<const D: usize>(&self, f: &Matrix<D>) -> f64 {
        let excess = spectral(&product(f, &f.transpose())).0.map(|square| square.sqrt() - 1.0);
        let dilation = det(f) - 1.0;
        0.5 * self.lambda * dilation * dilation + self.mu * excess.norm_squared()
    }
}

impl MaterialProperties for Corotated {
    fn wave_modulus(&self, _: f64) -> f64 {
        self.lambda + 2.0 * self.mu
    }

    fn is_elastic(&self) -> bool {
        true
    }
}

impl<const D: usize> Material<D> for Corotated {
    fn reads_deformation(&self) -> bool {
        true
    }

    fn energy(&self, particles: &Particles<D>) -> Option<f64> {
        Some(stored_energy(particles, |f| self.density(f)))
    }

    /// Uses `(F - R) F^T = V^2 - V`.
    fn update(&mut self, body: &mut StressUpdate<'_, D>) {
        set_stress_of_stretch(
            body,
            SquaredStretch::minus_root,
            #[inline(always)]
            |excess, j| linear(self.lambda * (j - 1.0), 2.0 * self.mu / j, excess),
        );
    }
}
