//! Neo-Hookean elasticity: the stress is a function of the deformation gradient F.
//!
//! `sigma = (lambda ln(J)/J) I + (mu/J) (F F^T - I)` (Wallstedt & Guilkey 2008; Kamojjala et al.
//! 2015). The law assumes plane strain in 2-D and uniaxial strain in 1-D.

use super::contract::{Material, MaterialProperties};
use super::hyperelastic::{set_stress_by_batch, stored_energy};
use super::linear_elastic::LinearElastic;
use super::plane_stress::{FreeAcross, PlaneStress, thinning};
use super::stress_update::StressUpdate;
use super::tangent::{StressResponse, isotropic_modulus};
use crate::mpm::foundation::algebra::{Matrix, Vector, det, identity, zeros};
use crate::mpm::foundation::particles::Particles;
use crate::mpm::foundation::simd::{BATCH, F64Batch, ln};

/// Compressible neo-Hookean elasticity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NeoHookean {
    lambda: f64,
    mu: f64,
}

impl NeoHookean {
    /// Creates the law from Young's modulus (Pa) and Poisson's ratio.
    pub fn new(young: f64, poisson: f64) -> Self {
        let LinearElastic { lambda, mu } = LinearElastic::new(young, poisson);
        Self { lambda, mu }
    }

    /// Returns the two factors of [`isotropic`] (Pa).
    #[inline(always)]
    fn factors(&self, j: f64, log_j: f64) -> [f64; 2] {
        [(self.lambda * log_j - self.mu) / j, self.mu / j]
    }

    fn cauchy<const D: usize>(&self, f: &Matrix<D>, j: f64) -> Matrix<D> {
        isotropic(f, self.factors(j, libm::log(j)))
    }

    /// Returns the energy density `W = lambda/2 ln(J)^2 + mu/2 (F : F - D - 2 ln J)` (J/m^D). The
    /// computation uses `H = F - I` to avoid cancellation: for small strains, F : F - D and 2 ln J
    /// are nearly equal.
    fn density<const D: usize>(&self, f: &Matrix<D>) -> f64 {
        let h = f - identity();
        let log = log_det(&h);
        0.5 * self.lambda * log * log + self.mu * (h.trace() - log + 0.5 * h.norm_squared())
    }
}

/// Returns `pressure I + shear F F^T`.
#[inline(always)]
fn isotropic<const D: usize>(f: &Matrix<D>, [pressure, shear]: [f64; 2]) -> Matrix<D> {
    let mut sigma = zeros();
    for j in 0..D {
        for i in 0..D {
            let square = (1..D).fold(f[(i, 0)] * f[(j, 0)], |sum, k| sum + f[(i, k)] * f[(j, k)]);
            let diagonal = if i == j { pressure } else { 0.0 };
            sigma[(i, j)] = diagonal + square * shear;
        }
    }
    sigma
}

fn log_det<const D: usize>(h: &Matrix<D>) -> f64 {
    let trace = h.trace();
    let minors = 0.5 * (trace * trace - (h * h).trace());
    libm::log1p(trace + minors + if D == 3 { det(h) } else { 0.0 })
}

/// Maximum number of Newton steps for the out-of-plane stretch of a plate.
const MOST_STEPS: usize = 100;

impl FreeAcross for NeoHookean {
    /// Finds the root of `lambda ln(area s) + mu (s^2 - 1)` by Newton's method in ln s. The method
    /// converges from above; NaN if it does not converge, for example for nu < 0 under extreme
    /// compression.
    fn stretch(&self, area: f64) -> f64 {
        let (Self { lambda, mu }, log) = (*self, libm::log(area));
        let mut above = -thinning(lambda, mu) * log;
        for _ in 0..MOST_STEPS {
            // Computes s^2 - 1 without cancellation for small strains.
            let excess = libm::expm1(2.0 * above);
            let slope = lambda + 2.0 * mu * (1.0 + excess);
            let next = above - (lambda * (log + above) + mu * excess) / slope;
            if next >= above {
                return libm::exp(above);
            }
            above = next;
        }
        f64::NAN
    }

    fn cauchy<const D: usize>(&self, f: &Matrix<D>, j: f64) -> Matrix<D> {
        self.cauchy(f, j)
    }

    fn density<const D: usize>(&self, f: &Matrix<D>, across: f64) -> f64 {
        let (h, thicker) = (f - identity(), across - 1.0);
        let log = log_det(&h) + libm::log1p(thicker);
        let squares = h.norm_squared() + thicker * thicker;
        0.5 * self.lambda * log * log + self.mu * (h.trace() + thicker - log + 0.5 * squares)
    }
}

impl MaterialProperties for NeoHookean {
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

impl<const D: usize> Material<D> for NeoHookean {
    fn reads_deformation(&self) -> bool {
        true
    }

    fn in_plane_stress(&self) -> Option<Box<dyn Material<D>>> {
        Some(Box::new(PlaneStress(*self)))
    }

    fn energy(&self, particles: &Particles<D>) -> Option<f64> {
        Some(stored_energy(particles, |f| self.density(f)))
    }

    /// Uses `tau_A = lambda ln J + mu (b_A - 1)`.
    fn response(&self, _: usize, f: &Matrix<3>) -> Option<StressResponse> {
        let Self { lambda, mu } = *self;
        let principal = |strain: &Vector<3>| {
            let squares = strain.map(|strain| libm::exp(2.0 * strain));
            let stress = squares.map(|square| lambda * strain.sum() + mu * (square - 1.0));
            let modulus = isotropic_modulus(lambda, 0.0);
            (stress, modulus + Matrix::<3>::from_diagonal(&(squares * (2.0 * mu))))
        };
        Some(StressResponse::new(f, &identity(), principal))
    }

    fn update(&mut self, body: &mut StressUpdate<'_, D>) {
        set_stress_by_batch(
            body,
            #[inline(always)]
            |j| {
                let (log_j, mut factors) = (ln(j), [F64Batch::ZERO; 2]);
                for lane in 0..BATCH {
                    let [pressure, shear] = self.factors(j.0[lane], log_j.0[lane]);
                    (factors[0].0[lane], factors[1].0[lane]) = (pressure, shear);
                }
                factors
            },
            isotropic,
        );
    }
}

#[cfg(test)]
mod tests {
    use super::super::MaterialPlan;
    use super::super::specimen::{SLOW, Specimen, scattered};
    use super::*;
    use approx::assert_relative_eq;

    /// The square of a strain of 1e-9 is below the rounding error of 1. At such strains, all
    /// elastic laws have the same quadratic energy.
    #[test]
    fn energy_of_tiny_strains_is_accurate() {
        let NeoHookean { lambda, mu } = NeoHookean::new(100.0, 0.3);
        let h = scattered::<3>(1e-9, 0.4);
        let plan = MaterialPlan::NeoHookean { young: 100.0, poisson: 0.3 };
        let mut specimen = Specimen::<3>::new(plan);
        specimen.deform(&(Matrix::identity() + h), SLOW);
        let eps = (h + h.transpose()) * 0.5;
        let expected = 0.5 * lambda * eps.trace() * eps.trace() + mu * eps.norm_squared();
        assert_relative_eq!(specimen.energy().unwrap(), expected, max_relative = 1e-6);
    }
}
