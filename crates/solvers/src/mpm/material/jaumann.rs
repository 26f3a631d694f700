//! Linear elasticity with the Jaumann rate.
//!
//! `tau_dot = lambda tr(d) I + 2 mu d + w tau - tau w` for the Kirchhoff stress `tau = J sigma`,
//! with the symmetric part d and the skew part w of the velocity gradient (Johnson & Bammann 1984).
//! In a step, `I + grad v dt = v R`: R rotates the stress and `ln v` is the strain increment. The
//! integration of a pure rotation is exact; in general, the order in the time step is 2. The work
//! of the stress in a closed cycle of deformation is not zero, so the law has no energy.

use super::contract::{Material, MaterialProperties};
use super::hyperelastic::linear;
use super::linear_elastic::LinearElastic;
use super::spectral::MatrixBatch;
use super::stress_update::{StressBlock, StressUpdate};
use super::stretch::turned_by_steps;
use crate::mpm::foundation::algebra::{det, identity};
use crate::mpm::foundation::simd::BATCH;

/// Isotropic linear elasticity with the Jaumann rate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Jaumann(LinearElastic);

impl Jaumann {
    /// Creates the law from Young's modulus (Pa) and Poisson's ratio.
    pub fn new(young: f64, poisson: f64) -> Self {
        Self(LinearElastic::new(young, poisson))
    }
}

impl MaterialProperties for Jaumann {
    fn wave_modulus(&self, _: f64) -> f64 {
        self.0.lambda + 2.0 * self.0.mu
    }

    fn is_in_rate_form(&self) -> bool {
        true
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
                let mut tau = MatrixBatch::<D>::ZERO;
                for (lane, (sigma, (vol, vol0))) in
                    sigma.iter().zip(vol.iter().zip(vol0)).enumerate()
                {
                    tau.set(lane, &linear(0.0, vol / vol0, sigma));
                }
                let (turned, strains) = turned_by_steps(grad_v, dt, &tau);
                let tau = turned.plus(&self.0.increments(&strains));
                let results = vol.iter_mut().zip(vol0).zip(sigma);
                for (lane, (grad_v, ((vol, vol0), sigma))) in grad_v.iter().zip(results).enumerate()
                {
                    *vol *= det(&(identity() + grad_v * dt));
                    *sigma = linear(0.0, vol0 / *vol, &tau.get(lane));
                }
            }
        });
    }
}
