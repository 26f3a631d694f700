//! Hencky elasticity: the small-strain law, with logarithmic strain and Kirchhoff stress.
//!
//! The stress is `sigma = (lambda tr(eps) I + 2 mu eps)/J` with `eps = ln(F F^T)/2` (Hencky 1928;
//! de Souza Neto, Peric & Owen 2008, chapter 13; Charlton et al. 2017 in MPM). The stress derives
//! from the energy `W = lambda/2 tr(eps)^2 + mu eps : eps`. The law assumes plane strain in 2-D and
//! uniaxial strain in 1-D.

use super::contract::{Material, MaterialProperties};
use super::hyperelastic::{linear, set_stress_of_stretch, stored_energy};
use super::linear_elastic::LinearElastic;
use super::plane_stress::{FreeAcross, PlaneStress, lambda_of_plate, thinning};
use super::spectral::{assembled, half_log, spectral};
use super::stress_update::StressUpdate;
use super::stretch::SquaredStretch;
use super::tangent::{StressResponse, isotropic_modulus};
use crate::mpm::foundation::algebra::{Matrix, identity, product};
use crate::mpm::foundation::particles::Particles;

/// Hencky elasticity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hencky {
    lambda: f64,
    mu: f64,
}

impl Hencky {
    /// Creates the law from Young's modulus (Pa) and Poisson's ratio.
    pub fn new(young: f64, poisson: f64) -> Self {
        let LinearElastic { lambda, mu } = LinearElastic::new(young, poisson);
        Self { lambda, mu }
    }

    fn cauchy<const D: usize>(&self, f: &Matrix<D>, j: f64) -> Matrix<D> {
        let (squares, axes) = spectral(&product(f, &f.transpose()));
        let strain = half_log(&squares);
        let pressure = self.lambda * strain.sum();
        assembled(&strain.map(|eps| (pressure + 2.0 * self.mu * eps) / j), &axes)
    }

    /// Returns the energy density W (J/m^D).
    fn density<const D: usize>(&self, f: &Matrix<D>) -> f64 {
        let strain = half_log(&spectral(&product(f, &f.transpose())).0);
        0.5 * self.lambda * strain.sum() * strain.sum() + self.mu * strain.norm_squared()
    }
}

/// Hencky elasticity in plane stress: stress and energy depend on the in-plane strains, with the
/// first Lame parameter of a plate.
struct HenckyPlate {
    plane: Hencky,
    thinning: f64,
}

impl FreeAcross for HenckyPlate {
    fn stretch(&self, area: f64) -> f64 {
        libm::pow(area, -self.thinning)
    }

    fn cauchy<const D: usize>(&self, f: &Matrix<D>, j: f64) -> Matrix<D> {
        self.plane.cauchy(f, j)
    }

    fn density<const D: usize>(&self, f: &Matrix<D>, _: f64) -> f64 {
        self.plane.density(f)
    }
}

impl MaterialProperties for Hencky {
    fn wave_modulus(&self, _: f64) -> f64 {
        self.lambda + 2.0 * self.mu
    }

    fn is_elastic(&self) -> bool {
        true
    }

    fn has_tangent(&self) -> Result<(), &'static str> {
        Ok(())
    }
}

impl<const D: usize> Material<D> for Hencky {
    fn reads_deformation(&self) -> bool {
        true
    }

    fn in_plane_stress(&self) -> Option<Box<dyn Material<D>>> {
        let Self { lambda, mu } = *self;
        let plane = Self { lambda: lambda_of_plate(lambda, mu), mu };
        Some(Box::new(PlaneStress(HenckyPlate { plane, thinning: thinning(lambda, mu) })))
    }

    fn energy(&self, particles: &Particles<D>) -> Option<f64> {
        Some(stored_energy(particles, |f| self.density(f)))
    }

    fn response(&self, _: usize, f: &Matrix<3>) -> Option<StressResponse> {
        let modulus = isotropic_modulus(self.lambda, self.mu);
        Some(StressResponse::new(f, &identity(), |strain| (modulus * strain, modulus)))
    }

    fn update(&mut self, body: &mut StressUpdate<'_, D>) {
        set_stress_of_stretch(
            body,
            SquaredStretch::half_log,
            #[inline(always)]
            |strain, j| {
                let trace = (1..D).fold(strain[(0, 0)], |sum, i| sum + strain[(i, i)]);
                linear(self.lambda * trace / j, 2.0 * self.mu / j, strain)
            },
        );
    }
}
