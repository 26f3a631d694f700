//! Linear elasticity with the Green-Naghdi rate.
//!
//! `tau_dot = lambda tr(d) I + 2 mu d + Omega tau - tau Omega` for the Kirchhoff stress
//! `tau = J sigma`, with `Omega = R_dot R^T` and the polar decomposition `F = R U` (Green & Naghdi
//! 1965; Johnson & Bammann 1984). The state is the stress `R^T tau R`, whose rate is
//! `lambda tr(D) I + 2 mu D` with `D = sym(U_dot U^-1)`. A step from U to U' adds
//! `sym(ln(U' U^-1))` to the integral of D. The integration of a pure rotation is exact; in
//! general, the order in the time step is 2. The work of the stress in a closed cycle of
//! deformation is not zero, so the law has no energy.

use super::contract::{Material, MaterialProperties};
use super::hyperelastic::linear;
use super::linear_elastic::{LinearElastic, logarithm};
use super::spectral::MatrixBatch;
use super::stress_update::{StressBlock, StressUpdate};
use super::stretch::{HALF_LOG, PowerSeries, SquaredStretch};
use crate::mpm::foundation::algebra::{Matrix, det, identity, zeros};
use crate::mpm::foundation::simd::{BATCH, F64Batch, vectorized};
use mpm_subject::{Column, Entry};
use std::any::Any;

/// Isotropic linear elasticity with the Green-Naghdi rate.
#[derive(Debug, Clone, PartialEq)]
pub struct GreenNaghdi {
    elasticity: LinearElastic,
    /// State of each particle; empty before the first step.
    states: Vec<Unrotated>,
}

/// State of a particle in three dimensions.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Unrotated {
    /// `R^T tau R` (Pa).
    stress: Matrix<3>,
    inverse_stretch: Matrix<3>,
}

impl Default for Unrotated {
    fn default() -> Self {
        Self { stress: zeros(), inverse_stretch: identity() }
    }
}

impl Entry for Unrotated {
    fn write(&self, numbers: &mut Vec<f64>) {
        self.stress.write(numbers);
    }
}

impl GreenNaghdi {
    /// Creates the law from Young's modulus (Pa) and Poisson's ratio.
    pub fn new(young: f64, poisson: f64) -> Self {
        Self { elasticity: LinearElastic::new(young, poisson), states: Vec::new() }
    }

    /// Advances the states of a batch of particles by a step to F. Returns J and the
    /// Cauchy stresses (Pa).
    #[inline(always)]
    fn advance<const D: usize>(
        &self,
        def_grad: &[Matrix<D>],
        states: &mut [Unrotated],
    ) -> (F64Batch, MatrixBatch<D>) {
        let mut volume_ratio = F64Batch([1.0; BATCH]);
        let (mut f, mut stress) = (MatrixBatch::identity(), MatrixBatch::<D>::ZERO);
        let mut inverse_before = MatrixBatch::identity();
        for (lane, (own, state)) in def_grad.iter().zip(&*states).enumerate() {
            f.set(lane, own);
            volume_ratio.0[lane % BATCH] = det(own);
            for j in 0..D {
                for i in 0..D {
                    stress.0[i][j].0[lane % BATCH] = state.stress[(i, j)];
                    inverse_before.0[i][j].0[lane % BATCH] = state.inverse_stretch[(i, j)];
                }
            }
        }
        let right = f.transpose();
        let inverse_stretch = SquaredStretch::new(&right, &right.minus_identity()).inverse_root();
        let turn = f.times(&inverse_stretch);
        let step = turn.transpose().times(&f).times(&inverse_before);
        let small = PowerSeries::new(step.minus_identity());
        let mut half_logs = small.sum(&HALF_LOG);
        if !small.all_small() {
            for lane in (0..BATCH).filter(|lane| !small.is_small(*lane)) {
                half_logs.set(lane, &(logarithm(&step.get::<D>(lane)) * 0.5));
            }
        }
        let strains = half_logs.plus(&half_logs.transpose());
        let stress = stress.plus(&self.elasticity.increments(&strains));
        for (lane, state) in states.iter_mut().enumerate() {
            for j in 0..D {
                for i in 0..D {
                    state.stress[(i, j)] = stress.0[i][j].get(lane);
                    state.inverse_stretch[(i, j)] = inverse_stretch.0[i][j].get(lane);
                }
            }
        }
        let mut sigma = turn.times(&stress).times(&turn.transpose());
        for lane in 0..BATCH {
            let inverse_j = 1.0 / volume_ratio.get(lane);
            sigma.set(lane, &linear(0.0, inverse_j, &sigma.get::<D>(lane)));
        }
        (volume_ratio, sigma)
    }
}

impl MaterialProperties for GreenNaghdi {
    fn wave_modulus(&self, _: f64) -> f64 {
        self.elasticity.lambda + 2.0 * self.elasticity.mu
    }

    fn is_in_rate_form(&self) -> bool {
        true
    }
}

impl<const D: usize> Material<D> for GreenNaghdi {
    fn reads_deformation(&self) -> bool {
        true
    }

    fn columns(&self) -> Vec<Column<'_>> {
        vec![Column::of_particles("unrotated stress", &self.states)]
    }

    fn state(&self) -> Option<Box<dyn Any>> {
        Some(Box::new(self.states.clone()))
    }

    fn set_state(&mut self, state: &dyn Any) {
        if let Some(state) = state.downcast_ref() {
            self.states.clone_from(state);
        }
    }

    fn update(&mut self, body: &mut StressUpdate<'_, D>) {
        let mut states = std::mem::take(&mut self.states);
        body.by_block_with(&mut states, &|StressBlock { def_grad, vol, vol0, sigma, .. },
                                          states| {
            let columns = def_grad.chunks(BATCH).zip(states.chunks_mut(BATCH));
            let volumes = vol.chunks_mut(BATCH).zip(vol0.chunks(BATCH));
            let results = volumes.zip(sigma.chunks_mut(BATCH));
            for ((def_grad, states), ((vol, vol0), sigma)) in columns.zip(results) {
                let (j, stresses) = vectorized(
                    #[inline(always)]
                    || self.advance(def_grad, states),
                );
                let results = vol.iter_mut().zip(vol0).zip(sigma).enumerate();
                for (lane, ((vol, vol0), sigma)) in results {
                    *vol = j.get(lane) * vol0;
                    *sigma = stresses.get(lane);
                }
            }
        });
        self.states = states;
    }
}
