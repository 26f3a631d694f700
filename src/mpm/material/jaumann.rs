//! Linear elasticity with the Jaumann rate.
//!
//! `tau_dot = lambda tr(d) I + 2 mu d + w tau - tau w` for the Kirchhoff stress `tau = J sigma`,
//! with the symmetric part d and the skew part w of the velocity gradient (Johnson & Bammann 1984).
//! In a step, `I + grad v dt = v R`: R rotates the stress and `ln v` is the strain increment. The
//! integration of a pure rotation is exact; in general, the order in the time step is 2. The work
//! of the stress in a closed cycle of deformation is not zero, so the law has no energy.

use super::contract::{Material, MaterialProperties, rate_form_averages_no_volume};
use super::linear_elastic::LinearElastic;
use super::spectral::{MatrixBatch, VectorBatch, assembled, half_log_batch, spectral_batch};
use super::stress_update::{StressBlock, StressUpdate};
use crate::mpm::foundation::algebra::{Matrix, det, product};
use crate::mpm::foundation::simd::{BATCH, vectorized};

/// Isotropic linear elasticity with the Jaumann rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jaumann(LinearElastic);

impl Jaumann {
    /// Creates the law from Young's modulus (Pa) and Poisson's ratio.
    pub fn new(young: f64, poisson: f64) -> Self {
        Self(LinearElastic::new(young, poisson))
    }
}

/// Returns the squares and the logarithms of the left stretch of `I + grad v dt`, and their axes,
/// for a batch of particles.
fn stretch<const D: usize>(
    grad_v: &[Matrix<D>],
    dt: f64,
) -> (VectorBatch<D>, VectorBatch<D>, MatrixBatch<D>) {
    vectorized(
        #[inline(always)]
        || {
            let mut squares = MatrixBatch::identity();
            for (lane, grad_v) in grad_v.iter().enumerate() {
                let step = Matrix::identity() + grad_v * dt;
                squares.set(lane, &product(&step, &step.transpose()));
            }
            let (squares, axes) = spectral_batch(squares);
            (squares, squares.map(half_log_batch), axes)
        },
    )
}

impl MaterialProperties for Jaumann {
    fn wave_modulus(&self, _: f64) -> f64 {
        self.0.lambda + 2.0 * self.0.mu
    }

    fn depends_on_deformation_alone(&self) -> Result<(), &'static str> {
        Err("a law in rate form has no stress of the deformation alone")
    }

    fn takes_averaged_volume(&self) -> Result<(), &'static str> {
        rate_form_averages_no_volume()
    }

    fn has_energy(&self, _: usize) -> Result<(), &'static str> {
        Err("is integrated in rate form and has no stored energy")
    }
}

impl<const D: usize> Material<D> for Jaumann {
    fn reads_deformation(&self) -> bool {
        false
    }

    fn update(&mut self, body: &mut StressUpdate<'_, D>) {
        let dt = body.dt();
        body.by_block(|StressBlock { grad_v, vol, vol0, sigma, .. }| {
            let volumes = vol.chunks_mut(BATCH).zip(vol0.chunks(BATCH));
            let results = volumes.zip(sigma.chunks_mut(BATCH));
            for (grad_v, ((vol, vol0), sigma)) in grad_v.chunks(BATCH).zip(results) {
                let (squares, strains, axes) = stretch(grad_v, dt);
                let results = vol.iter_mut().zip(vol0).zip(sigma);
                for (lane, (grad_v, ((vol, vol0), sigma))) in grad_v.iter().zip(results).enumerate()
                {
                    let step = Matrix::<D>::identity() + grad_v * dt;
                    let axes = axes.get(lane);
                    let inverses = squares.get(lane).map(|square| 1.0 / square.sqrt());
                    let turn = product(&assembled(&inverses, &axes), &step);
                    let strain = assembled(&strains.get(lane), &axes);
                    let turned = product(&product(&turn, sigma), &turn.transpose());
                    let tau = turned * (*vol / vol0) + self.0.increment(&strain);
                    *vol *= det(&step);
                    *sigma = tau / (*vol / vol0);
                }
            }
        });
    }
}

#[cfg(test)]
impl super::contract::ClosedForms for Jaumann {
    /// Returns the stress of one step, whose strain increment is the logarithmic strain.
    fn simple_shear(&self, gamma: f64) -> [f64; 3] {
        let e = libm::asinh(0.5 * gamma);
        let shear = 2.0 * self.0.mu * e;
        [shear * libm::tanh(e), shear / libm::cosh(e), -shear * libm::tanh(e)]
    }

    fn uniaxial_stretch(&self, stretch: f64) -> Option<[f64; 2]> {
        let LinearElastic { lambda, mu } = self.0;
        let strain = libm::log(stretch);
        Some([(lambda + 2.0 * mu) * strain / stretch, lambda * strain / stretch])
    }

    fn energy_density(&self, _: &Matrix<3>) -> Option<f64> {
        None
    }

    /// Returns the stress caused by the rounding error of the stretch.
    fn rounding(&self) -> f64 {
        4.0 * f64::EPSILON * self.wave_modulus(1.0)
    }
}
