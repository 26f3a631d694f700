//! Modified Cam-clay: a yield surface that hardens with plastic compaction.
//!
//! With the mean stress `p`, positive in compression, and `q = sqrt(3 J2)` of the Kirchhoff stress,
//! the clay yields if `q^2/M^2 + p (p - pc) > 0`; the flow is associated (Roscoe & Burland 1968;
//! Borja & Lee 1990). Elastic swelling follows `d eps_v = kappa dp/p`, and plastic compaction
//! hardens the clay by `d pc/pc = d eps_v/(lambda - kappa)`. The shear modulus is `G = r p/kappa`
//! with a constant r, so Poisson's ratio is constant. The elastic law is in rate form and has no
//! energy.
//!
//! The state is the Kirchhoff stress and `pc`. A step multiplies the deformation by
//! `I + grad v dt`, whose polar decomposition is `v R`: R rotates the stress, and `ln v` is the
//! strain increment. The integration of a pure rotation is exact. In general, the result agrees
//! with the Jaumann rate to second order in the step. The return mapping is implicit. It is exact
//! at a constant stress ratio, and of first order in the step otherwise.

use super::contract::{Contradiction, Material, MaterialProperties};
use super::plastic_flow::{MARGIN, length_squared};
use super::spectral::MatrixBatch;
use super::stress_update::{StressBlock, StressUpdate};
use super::stretch::turned_by_steps;
use crate::mpm::foundation::algebra::{Matrix, det, identity};
use crate::mpm::foundation::particles::Particles;
use crate::mpm::foundation::simd::{BATCH, vectorized};
use mpm_subject::{Column, Entry, Failure};
use std::any::Any;

/// Modified Cam-clay at finite strain.
#[derive(Debug, Clone, PartialEq)]
pub struct CamClay {
    /// Slope M of the critical-state line in the plane of p and q.
    slope: f64,
    /// Slope kappa of the swelling line.
    swelling: f64,
    /// `lambda - kappa`, the slope of plastic compaction.
    hardening: f64,
    /// Ratio `G/K` of shear modulus and bulk modulus.
    ratio: f64,
    /// State of each particle at rest.
    start: Clay,
    /// State of each particle; empty before the first step.
    states: Vec<Clay>,
}

#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Clay {
    /// Kirchhoff stress (Pa).
    tau: Matrix<3>,
    /// Preconsolidation pressure `pc` (Pa).
    consolidation: f64,
}

/// Reports contain only the preconsolidation pressure of the state.
impl Entry for Clay {
    fn write(&self, numbers: &mut Vec<f64>) {
        numbers.push(self.consolidation);
    }
}

/// Input of the return mapping: the stress before the step, and the strain increment of the step.
struct ClayTrial {
    /// Mean stress before the step (Pa), positive in compression.
    pressure: f64,
    consolidation: f64,
    /// Deviator of the stress before the step (Pa).
    deviator: Matrix<3>,
    /// Logarithmic volume strain, positive in compression.
    compaction: f64,
    /// Deviator of the logarithmic strain.
    shear: Matrix<3>,
}

/// Maximum number of iterations of the return mapping; about ten suffice.
const MAX_ITERATIONS: usize = 100;

impl CamClay {
    /// Creates the law from the slope M of the critical-state line, the slopes of the swelling and
    /// compression lines (logarithmic strain over ln p), Poisson's ratio, and the mean stress and
    /// preconsolidation pressure at rest (Pa). Both pressures are positive in compression.
    pub fn new(
        critical_state_slope: f64,
        swelling_slope: f64,
        compression_slope: f64,
        poisson: f64,
        initial_pressure: f64,
        preconsolidation: f64,
    ) -> Self {
        let tau = Matrix::from_diagonal_element(-initial_pressure);
        Self {
            slope: critical_state_slope,
            swelling: swelling_slope,
            hardening: compression_slope - swelling_slope,
            ratio: 1.5 * (1.0 - 2.0 * poisson) / (1.0 + poisson),
            start: Clay { tau, consolidation: preconsolidation },
            states: Vec::new(),
        }
    }

    fn initial_pressure(&self) -> f64 {
        -self.start.tau[(0, 0)]
    }

    /// Returns the state after a logarithmic `strain`. The stress before the strain must already be
    /// rotated.
    fn after(&self, before: &Clay, strain: &Matrix<3>) -> Clay {
        let tau = before.tau;
        let (pressure, compaction) = (-tau.trace() / 3.0, -strain.trace());
        let trial = ClayTrial {
            pressure,
            consolidation: before.consolidation,
            deviator: tau + Matrix::from_diagonal_element(pressure),
            compaction,
            shear: strain + Matrix::from_diagonal_element(compaction / 3.0),
        };
        let (pressure, deviator) = self.swollen(&trial, compaction);
        let q = equivalent(&deviator);
        let excess = square(q / self.slope) + pressure * (pressure - trial.consolidation);
        let (pressure, deviator, consolidation) = if excess > 0.0 {
            self.returned(&trial)
        } else {
            (pressure, deviator, trial.consolidation)
        };
        Clay { tau: deviator - Matrix::from_diagonal_element(pressure), consolidation }
    }

    /// Returns the stresses of a batch of particles after logarithmic `strains`, if all strain is
    /// elastic. Also returns whether the state of a particle is certainly elastic. The stress of
    /// any other particle is not valid.
    fn elastic(
        &self,
        before: &[Clay],
        turned: &MatrixBatch<3>,
        strains: &MatrixBatch<3>,
    ) -> (MatrixBatch<3>, [bool; BATCH]) {
        vectorized(
            #[inline(always)]
            || {
                let mut consolidation = [f64::NAN; BATCH];
                for (lane, clay) in before.iter().enumerate() {
                    consolidation[lane % BATCH] = clay.consolidation;
                }
                let (mut stresses, mut inside) = (MatrixBatch::ZERO, [false; BATCH]);
                let (exponent_per_strain, stiffness) =
                    (-3.0 / self.swelling, -self.ratio / self.swelling);
                let shear_share = 1.5 / square(self.slope);
                for lane in 0..BATCH {
                    let (mut deviator, mut shear) = (turned.get::<3>(lane), strains.get::<3>(lane));
                    let mean = (deviator[(0, 0)] + deviator[(1, 1)] + deviator[(2, 2)]) / 3.0;
                    let mean_strain = (shear[(0, 0)] + shear[(1, 1)] + shear[(2, 2)]) / 3.0;
                    let t = mean_strain * exponent_per_strain;
                    let growth = small_mean_growth(t);
                    let modulus = stiffness * mean * growth;
                    for i in 0..3 {
                        deviator[(i, i)] -= mean;
                        shear[(i, i)] -= mean_strain;
                    }
                    for (tau, e) in deviator.iter_mut().zip(&shear) {
                        *tau += 2.0 * modulus * e;
                    }
                    let mean = mean * (1.0 + t * growth);
                    let shear = shear_share * length_squared(&deviator);
                    let bound = -mean * consolidation[lane];
                    inside[lane] = (t.abs() <= SMALL_GROWTH)
                        & (shear + square(mean) <= (1.0 - MARGIN) * bound);
                    for i in 0..3 {
                        deviator[(i, i)] += mean;
                    }
                    stresses.set(lane, &deviator);
                }
                (stresses, inside)
            },
        )
    }

    /// Returns the mean stress (Pa) and the stress deviator (Pa) after the elastic volume strain
    /// `compaction`, if all shear is elastic. Volume strain and shear strain grow in proportion, so
    /// the result is the exact integral of the rate form.
    fn swollen(&self, trial: &ClayTrial, compaction: f64) -> (f64, Matrix<3>) {
        let t = compaction / self.swelling;
        let growth = mean_growth(t);
        // The sum is faster than the exponential function, but would cancel below -1.
        let factor = if t > -1.0 { 1.0 + t * growth } else { libm::exp(t) };
        let modulus = self.ratio / self.swelling * trial.pressure * growth;
        (trial.pressure * factor, trial.deviator + trial.shear * (2.0 * modulus))
    }

    /// Returns a trial state outside the yield surface to the surface: the mean stress, the
    /// deviator and the preconsolidation pressure (Pa).
    ///
    /// The unknown is `m = q/(M p)`. On the surface `pc = p (1 + m^2)`, and pc gives the plastic
    /// compaction x. The remaining equation is the flow rule,
    /// `6 G x m/M = (q_trial - q) (1 - m^2)`. The root lies between the critical state, m = 1, and
    /// the yield surface before the step.
    fn returned(&self, trial: &ClayTrial) -> (f64, Matrix<3>, f64) {
        let Self { slope, swelling, hardening, ratio, .. } = *self;
        // ln(p/pc) of the trial state.
        let depth = trial.compaction / swelling + libm::log(trial.pressure / trial.consolidation);
        let flow = |m: f64| (libm::log1p(m * m) + depth) / (1.0 / swelling + 1.0 / hardening);
        let residual = |m: f64| {
            let flow = flow(m);
            let (p, deviator) = self.swollen(trial, trial.compaction - flow);
            let t = (trial.compaction - flow) / swelling;
            let modulus = ratio / swelling * trial.pressure * mean_growth(t);
            let beyond = equivalent(&deviator) - slope * m * p;
            6.0 * modulus / slope * flow * m - beyond * (1.0 - m * m)
        };
        // The value of m on the yield surface before the step.
        let m = libm::sqrt(libm::expm1(-depth).max(0.0));
        let m = root(residual, m.min(1.0), m.max(1.0));
        let flow = flow(m);
        let (p, deviator) = self.swollen(trial, trial.compaction - flow);
        let q = equivalent(&deviator);
        let share = if q > 0.0 { slope * m * p / q } else { 0.0 };
        (p, deviator * share, trial.consolidation * libm::exp(flow / hardening))
    }
}

fn square(x: f64) -> f64 {
    x * x
}

/// Returns `(e^t - 1)/t`, the mean of `e^s` for s from 0 to t.
fn mean_growth(t: f64) -> f64 {
    if t == 0.0 { 1.0 } else { libm::expm1(t) / t }
}

/// Largest argument of [`small_mean_growth`].
const SMALL_GROWTH: f64 = 0.125;

/// Coefficients `1/(k + 1)!` of the series of `(e^t - 1)/t`. For arguments up to [`SMALL_GROWTH`],
/// the first omitted term is below `0.125^10/11! = 3e-17`.
const MEAN_GROWTH: [f64; 10] = {
    let mut series = [1.0; 10];
    let mut k = 1;
    while k < series.len() {
        series[k] = series[k - 1] / (k + 1) as f64;
        k += 1;
    }
    series
};

/// Returns `(e^t - 1)/t` for arguments up to [`SMALL_GROWTH`].
#[inline(always)]
fn small_mean_growth(t: f64) -> f64 {
    let mut sum = 0.0;
    for coefficient in MEAN_GROWTH.iter().rev() {
        sum = coefficient + t * sum;
    }
    sum
}

/// Returns `sqrt(3/2) |s|` for a deviator s.
fn equivalent(deviator: &Matrix<3>) -> f64 {
    libm::sqrt(1.5 * deviator.norm_squared())
}

/// Finds the root of a function that is negative at `low` and positive at `high`, by the Illinois
/// variant of false position (Dowell & Jarratt 1971). Returns `low` if `f(low)` is not negative,
/// and `high` if `f(high)` is not positive.
fn root(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    let (mut at_low, mut at_high) = (f(low), f(high));
    if !(at_low < 0.0) {
        return low;
    }
    if !(at_high > 0.0) {
        return high;
    }
    let (mut x, mut last) = (low, 0.0);
    for _ in 0..MAX_ITERATIONS {
        let next = (low * at_high - high * at_low) / (at_high - at_low);
        let is_settled = (next - x).abs() <= f64::EPSILON * next;
        x = next;
        let value = f(x);
        if is_settled || value == 0.0 || value.is_nan() {
            break;
        }
        if value < 0.0 {
            (low, at_low) = (x, value);
            at_high *= if last < 0.0 { 0.5 } else { 1.0 };
        } else {
            (high, at_high) = (x, value);
            at_low *= if last > 0.0 { 0.5 } else { 1.0 };
        }
        last = value;
    }
    x
}

impl MaterialProperties for CamClay {
    /// Returns `K + 4/3 G` at rest plus the initial stress; valid inside the yield surface.
    fn wave_modulus(&self, _: f64) -> f64 {
        let pressure = self.initial_pressure();
        pressure / self.swelling * (1.0 + 4.0 / 3.0 * self.ratio) + pressure
    }

    fn contradiction(&self) -> Option<Contradiction> {
        if !(self.hardening > 0.0) {
            return Some(Contradiction {
                key: "swelling_slope",
                reason: "the slope of swelling is not below that of compression",
                explanation: "plastic compaction has the difference of the two slopes",
            });
        }
        (self.start.consolidation < self.initial_pressure()).then_some(Contradiction {
            key: "preconsolidation",
            reason: "the preconsolidation pressure is below the initial pressure",
            explanation: "the clay would start outside its yield surface",
        })
    }

    fn is_in_rate_form(&self) -> bool {
        true
    }

    fn depends_on_deformation_alone(&self) -> Result<(), &'static str> {
        Err("plastic flow depends on the whole history of the motion")
    }

    fn has_stress_across(&self) -> bool {
        true
    }

    fn starts_stressed(&self) -> Result<(), &'static str> {
        Err("the clay starts under its `initial_pressure`")
    }
}

impl<const D: usize> Material<D> for CamClay {
    fn reads_deformation(&self) -> bool {
        false
    }

    fn is_stressed_at_rest(&self) -> bool {
        true
    }

    fn columns(&self) -> Vec<Column<'_>> {
        vec![Column::of_particles("preconsolidation", &self.states)]
    }

    fn state(&self) -> Option<Box<dyn Any>> {
        Some(Box::new(self.states.clone()))
    }

    fn set_state(&mut self, state: &dyn Any) {
        if let Some(state) = state.downcast_ref() {
            self.states.clone_from(state);
        }
    }

    /// Sets the initial pressure. Fails for a body that starts deformed.
    fn start_deformed(&mut self, particles: &mut Particles<D>) -> Result<(), Failure> {
        if particles.is_deformed() {
            return Err(Failure::NotOfDeformation);
        }
        particles.sigma.fill(Matrix::from_diagonal_element(-self.initial_pressure()));
        Ok(())
    }

    fn stress_across(&self, p: usize, particles: &Particles<D>) -> Option<f64> {
        let tau = self.states.get(p).unwrap_or(&self.start).tau;
        Some(tau[(2, 2)] * particles.vol0[p] / particles.vol[p])
    }

    fn update(&mut self, body: &mut StressUpdate<'_, D>) {
        let dt = body.dt();
        let mut states = std::mem::take(&mut self.states);
        states.resize(body.count(), self.start);
        body.by_block_with(&mut states, &|StressBlock { grad_v, vol, vol0, sigma, .. }, states| {
            let columns = grad_v.chunks(BATCH).zip(states.chunks_mut(BATCH));
            let volumes = vol.chunks_mut(BATCH).zip(vol0.chunks(BATCH));
            let results = volumes.zip(sigma.chunks_mut(BATCH));
            for ((grad_v, states), ((vol, vol0), sigma)) in columns.zip(results) {
                let mut tau = MatrixBatch::<3>::ZERO;
                for (lane, state) in states.iter().enumerate() {
                    tau.set(lane, &state.tau);
                }
                let (turned, strains) = turned_by_steps(grad_v, dt, &tau);
                let (elastic, inside) = self.elastic(states, &turned, &strains);
                let results = vol.iter_mut().zip(vol0).zip(sigma);
                let particles = grad_v.iter().zip(states).zip(results).enumerate();
                for (lane, ((grad_v, state), ((vol, vol0), sigma))) in particles {
                    if inside[lane % BATCH] {
                        state.tau = elastic.get(lane);
                    } else {
                        let before = Clay { tau: turned.get(lane), ..*state };
                        *state = self.after(&before, &strains.get(lane));
                    }
                    *vol *= det(&(identity() + grad_v * dt));
                    let inverse_j = vol0 / *vol;
                    *sigma = Matrix::from_fn(|i, k| state.tau[(i, k)] * inverse_j);
                }
            }
        });
        self.states = states;
    }
}

#[cfg(test)]
impl CamClay {
    /// Creates clay with M = 1.2, kappa = 0.02, lambda = 0.1 and nu = 0.25, under 100 Pa.
    pub(super) fn example(preconsolidation: f64) -> Self {
        Self::new(1.2, 0.02, 0.1, 0.25, 100.0, preconsolidation)
    }
}

#[cfg(test)]
mod tests {
    use super::super::specimen::{SLOW, Specimen};
    use super::*;
    use crate::mpm::foundation::algebra::Vector;
    use approx::assert_abs_diff_eq;
    use proptest::prelude::*;

    proptest! {
        /// After a return the yield function is zero, the flow is associated and the hardening
        /// follows the plastic compaction, on both sides of the critical state.
        #[test]
        fn return_satisfies_flow_rule_and_hardening(
            overconsolidation in 1.0..20.0_f64,
            compaction in -0.05..0.05_f64,
            shear in proptest::array::uniform3(-0.05..0.05_f64),
        ) {
            let law = CamClay::example(100.0 * overconsolidation);
            let e = Vector::<3>::from(shear);
            let shear = e.add_scalar(-e.sum() / 3.0);
            let strain = Matrix::from_diagonal(&shear.add_scalar(-compaction / 3.0));
            let after = law.after(&law.start, &strain);
            let (p, pc) = (-after.tau.trace() / 3.0, after.consolidation);
            let deviator = after.tau + Matrix::from_diagonal_element(p);
            let q = equivalent(&deviator);
            let excess = square(q / 1.2) + p * (p - pc);
            if pc == law.start.consolidation {
                prop_assert!(excess <= 1e-12 * pc * pc);
            } else {
                assert_abs_diff_eq!(excess, 0.0, epsilon = 1e-11 * pc * pc);
                let elastic = 0.02 * libm::log(p / 100.0);
                let flow = 0.08 * libm::log(pc / law.start.consolidation);
                assert_abs_diff_eq!(elastic + flow, compaction, epsilon = 1e-12);
                // The plastic shear divided by the gradient of q^2/M^2, and the plastic compaction
                // divided by the gradient of p (p - pc), both equal the plastic multiplier.
                let modulus = 0.6 * (p - 100.0) / elastic;
                let plastic = Matrix::from_diagonal(&shear) - deviator / (2.0 * modulus);
                let flowed = plastic.dot(&deviator) / deviator.norm_squared();
                let direction = (2.0 * p - pc) * flowed - flow * 3.0 / 1.44;
                prop_assert!(flowed >= -1e-12);
                if elastic.abs() > 1e-4 && q > 1e-3 * p {
                    assert_abs_diff_eq!(direction, 0.0, epsilon = 1e-8);
                }
            }
        }
    }

    proptest! {
        /// The states of a batch that are certainly elastic are those of the return mapping.
        #[test]
        fn elastic_states_of_a_batch_are_inside_the_yield_surface(
            strain in proptest::array::uniform6(-2e-3..2e-3_f64),
            stress in proptest::array::uniform6(-40.0..40.0_f64),
        ) {
            let symmetric = |m: [f64; 6]| {
                let [a, b, c, d, e, f] = m;
                Matrix::<3>::new(a, d, e, d, b, f, e, f, c)
            };
            let law = CamClay::example(300.0);
            let tau = symmetric(stress) - Matrix::from_diagonal_element(100.0);
            let (before, strain) = (Clay { tau, consolidation: 300.0 }, symmetric(strain));
            let (mut turned, mut strains) = (MatrixBatch::ZERO, MatrixBatch::ZERO);
            turned.set(0, &tau);
            strains.set(0, &strain);
            let (elastic, inside) = law.elastic(&[before], &turned, &strains);
            prop_assert_eq!(&inside[1..], &[false; BATCH - 1]);
            let after = law.after(&before, &strain);
            prop_assert!(!inside[0] || after.consolidation == 300.0);
            prop_assert!(inside[0] || after.consolidation > 300.0 || strain.trace().abs() > 0.0025);
            if inside[0] {
                assert_abs_diff_eq!(elastic.get::<3>(0), after.tau, epsilon = 1e-12);
            }
        }
    }

    #[test]
    fn a_body_at_rest_is_under_its_initial_pressure() {
        let mut body = Particles::cubes([1; 2]);
        assert_eq!(CamClay::example(150.0).start_deformed(&mut body), Ok(()));
        assert_eq!(body.sigma[0], Matrix::<2>::from_diagonal_element(-100.0));
        body.deform(|_| (Vector::zeros(), Matrix::<2>::from_diagonal_element(1.1)));
        assert_eq!(
            CamClay::example(150.0).start_deformed(&mut body),
            Err(Failure::NotOfDeformation)
        );
    }

    #[test]
    fn large_rotation_in_a_step_only_rotates_the_stress() {
        let step = Matrix::<3>::new(1.02, 0.05, 0.0, -0.01, 0.93, 0.02, 0.0, 0.03, 0.97);
        let (c, s) = (libm::cos(2.5), libm::sin(2.5));
        let turn = Matrix::<3>::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0);
        let run = |turn: &Matrix<3>| {
            let mut clay = Specimen::<3>::with(Box::new(CamClay::example(120.0)));
            clay.deform(&step, SLOW);
            clay.deform(&(turn * step), SLOW)
        };
        let (turned, plain) = (run(&turn), run(&Matrix::identity()));
        assert_abs_diff_eq!(turned, turn * plain * turn.transpose(), epsilon = 1e-9);
    }
}
