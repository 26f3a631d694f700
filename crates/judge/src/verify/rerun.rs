//! Runs levels again with other settings if the verdict depends on the results.
//!
//! - To find why the error has stopped decreasing (an error floor), the finest level runs again
//!   with half the spacing on another axis.
//! - Some suites have one time step on all levels. In a solver that is accurate in space, the error
//!   of this step may dominate, so that the total error stops decreasing or has a low order. If an
//!   external solver then misses the requirement of `run --gate`, the levels run again with shorter
//!   steps.

use super::judge_plan::{JudgePlan, LevelRun, series, usable_series};
use crate::verify::{
    Acceptance, Axis, Floor, GateResult, Judgement, LevelOutcome, Probe, Requirement, Verdict,
};
use rayon::prelude::*;
use std::fmt::Display;

/// Runs levels of a case again.
pub trait Reruns: Sync {
    /// Reason why a level cannot be run.
    type Error: Display + Send;

    /// Whether halving a spacing can reveal which axis causes an error. False if the reference is
    /// computed by the same method, because the spacings of the reference are not halved.
    fn can_halve(&self) -> bool;

    /// Runs the level with half the spacing on an axis; `None` if the level has no such spacing.
    fn run_halved(&self, level: &LevelOutcome, axis: Axis)
    -> Option<Result<LevelRun, Self::Error>>;

    /// Runs the level with the time step `dt` (s), as often as the other levels of the case.
    ///
    /// # Errors
    /// If the level cannot be set up.
    fn run_with_step(&self, level: &LevelOutcome, dt: f64) -> Result<LevelRun, Self::Error>;

    /// Returns the sizes of the numbers that the solver rounds; `None` if the judged quantity has
    /// no natural size.
    fn rounding(&self) -> Option<RoundingSizes>;
}

/// Sizes of the numbers that a solver rounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoundingSizes {
    /// Largest exact value of the judged quantity.
    pub value: f64,
    /// Largest number from which the judged quantity is computed.
    pub number: f64,
    /// Half of the distance between 1 and the next floating-point number.
    pub unit: f64,
}

/// Number of roundings of a value per step, for the prediction of rounding errors.
const ROUNDINGS: f64 = 8.0;

/// Maximum fraction of the judged quantity that is attributed to rounding.
const MOST_ROUNDING: f64 = 0.01;

/// Maximum number of times that the time step is halved.
const HALVINGS: i32 = 3;

/// Minimum relative decrease of the error on the finest level after the time step is halved. With a
/// smaller decrease the other levels do not run again.
const LEAST_FALL: f64 = 0.05;

/// Minimum exponent of h for which a time step counts as refined together with the cells.
const FOLLOWS: f64 = 0.5;

/// Measures the effect of halving the spacings of the other axes on the error of the finest level
/// that counts. `None` if the error has not stopped decreasing and the suite expects no floor, if
/// this level failed, or if spacings cannot be halved.
///
/// Runs one to three probes in parallel. The results are listed in the order of the axes.
pub(super) fn floor<R: Reruns>(
    plan: &JudgePlan<'_>,
    judgement: &Judgement,
    levels: &[LevelOutcome],
    reruns: &R,
) -> Option<Floor> {
    let expected = plan.expectation.is_some_and(|expectation| expectation.floor.is_some());
    let asked = judgement.verdict == Verdict::AtFloor || expected;
    let counts = |level: &&LevelOutcome| level.exclusion().is_none();
    let finest = levels.iter().rev().find(counts).filter(|_| asked)?;
    if finest.run.failure.is_some() || !reruns.can_halve() {
        return None;
    }
    let others = [Axis::Time, Axis::Particles, Axis::Space].into_par_iter();
    let probe = |axis: Axis| {
        let run = reruns.run_halved(finest, axis)?;
        let outcome = run.map(|run| plan.level(run)).map_err(|error| error.to_string());
        let error = outcome.and_then(|outcome| outcome.run.failure.map_or(Ok(outcome.error), Err));
        Some(Probe { axis, error })
    };
    let probes = others.filter(|axis| *axis != plan.settings.axis).filter_map(probe).collect();
    Some(Floor { error: finest.error, probes })
}

/// Checks a requirement. If shorter time steps are needed to test it, the levels run again.
pub(super) fn gate<R: Reruns>(
    plan: &JudgePlan<'_>,
    required: &Requirement,
    levels: &[LevelOutcome],
    judgement: &Judgement,
    reruns: &R,
) -> GateResult {
    let rounding = rounding(plan, levels, reruns);
    let result = required.check(&usable_series(levels), plan.settings.axis, judgement, rounding);
    let remark = match result {
        Err(_) if is_step_fixed(plan, levels) => shorten(plan, required, levels, rounding, reruns),
        _ => None,
    };
    match remark {
        Some((met, remark)) => GateResult { result: Ok(met), remark: Some(remark), rounding },
        None => GateResult { result, remark: None, rounding },
    }
}

/// Tries to meet the requirement with shorter steps. Returns the acceptance with a remark.
fn shorten<R: Reruns>(
    plan: &JudgePlan<'_>,
    required: &Requirement,
    levels: &[LevelOutcome],
    rounding: f64,
    reruns: &R,
) -> Option<(Acceptance, String)> {
    let (last, coarser) = levels.split_last()?;
    let mut before = last.error;
    for halving in 1..=HALVINGS {
        let share = libm::exp2(-f64::from(halving));
        let shorter = |level: &LevelOutcome| {
            reruns.run_with_step(level, share * level.dt).map(|run| plan.level(run))
        };
        // The finest level alone shows whether the time step contributes to the error.
        let finest = shorter(last).ok()?;
        if !(finest.error <= (1.0 - LEAST_FALL) * before) {
            return None;
        }
        before = finest.error;
        let again: Result<Vec<LevelOutcome>, R::Error> = coarser.par_iter().map(shorter).collect();
        let mut again = again.ok()?;
        again.push(finest);
        let judgement = plan.judge_series(&series(&again), None);
        let usable = usable_series(&again);
        if let Ok(met) = required.check(&usable, plan.settings.axis, &judgement, rounding) {
            let order = judgement.order.map_or("none".to_owned(), |order| order.shown());
            let remark = format!(
                "with 1/{} of the time step, which the suite does not refine, the order is {order}",
                1_u32 << halving
            );
            return Some((met, remark));
        }
    }
    None
}

/// Whether the cells are refined while the time step is constant or nearly constant.
fn is_step_fixed(plan: &JudgePlan<'_>, levels: &[LevelOutcome]) -> bool {
    let (Some(first), Some(last)) = (levels.first(), levels.last()) else { return false };
    plan.settings.axis == Axis::Space
        && last.h < first.h
        && first.dt < last.dt * libm::pow(first.h / last.h, FOLLOWS)
}

/// Estimates the error due to rounding, in the judged norm and relative to the judged scale:
/// rounding errors of the largest number from which the judged quantity is computed are added like
/// the steps of a random walk.
pub(super) fn rounding<R: Reruns>(
    plan: &JudgePlan<'_>,
    levels: &[LevelOutcome],
    reruns: &R,
) -> f64 {
    let Some(RoundingSizes { value, number, unit }) = reruns.rounding() else { return 0.0 };
    let steps = levels.iter().map(|level| level.run.steps).max().unwrap_or(0);
    let walk = ROUNDINGS * unit * number * libm::sqrt(steps as f64 + 1.0);
    walk.min(MOST_ROUNDING * value) / plan.settings.scale.unwrap_or(1.0)
}

#[cfg(test)]
pub(in crate::verify) mod tests {
    use super::*;
    use crate::verify::judge_plan::tests::{level_run, plan};
    use crate::verify::{Expectation, FloorCause, Requirement, UnmetCode};
    use approx::assert_relative_eq;
    use rstest::rstest;
    use std::sync::Mutex;

    pub(in crate::verify) const SIZES: RoundingSizes =
        RoundingSizes { value: 1e-3, number: 1e3, unit: f64::EPSILON / 2.0 };

    /// Solver whose repeated runs have the error `error(h, dt)` (m). With half the time step the
    /// error is 2e-7 m, and with half the particle spacing 3e-7 m; other spacings cannot be halved.
    pub(in crate::verify) struct Scripted<E> {
        error: E,
        can_halve: bool,
        pub(in crate::verify) sizes: Option<RoundingSizes>,
        /// Numbers of cells and time steps (s) of the runs with another step.
        steps: Mutex<Vec<(u64, f64)>>,
    }

    pub(in crate::verify) fn scripted<E: Fn(f64, f64) -> f64 + Sync>(error: E) -> Scripted<E> {
        Scripted { error, can_halve: true, sizes: Some(SIZES), steps: Mutex::default() }
    }

    impl<E: Fn(f64, f64) -> f64 + Sync> Reruns for Scripted<E> {
        type Error = String;

        fn can_halve(&self) -> bool {
            self.can_halve
        }

        fn run_halved(&self, of: &LevelOutcome, axis: Axis) -> Option<Result<LevelRun, String>> {
            Some(Ok(match axis {
                Axis::Time => level_run(of.cells, of.dt, 2e-7),
                Axis::Particles => level_run(of.cells, of.dt, 3e-7),
                Axis::Space => return None,
            }))
        }

        fn run_with_step(&self, level: &LevelOutcome, dt: f64) -> Result<LevelRun, String> {
            self.steps.lock().unwrap().push((level.cells, dt));
            Ok(level_run(level.cells, dt, (self.error)(level.h, dt)))
        }

        fn rounding(&self) -> Option<RoundingSizes> {
            self.sizes
        }
    }

    /// Creates levels of 4 to 32 cells with the given time steps (s).
    fn levels(dt: [f64; 4], error: impl Fn(f64, f64) -> f64) -> Vec<LevelOutcome> {
        let runs = [4, 8, 16, 32].into_iter().zip(dt);
        runs.map(|(cells, dt)| plan().level(level_run(cells, dt, error(1.0 / cells as f64, dt))))
            .collect()
    }

    pub(in crate::verify) const SECOND_ORDER: Requirement = Requirement {
        order: Some(2.0),
        error_below: None,
        own_error_below: None,
        because: String::new(),
    };

    /// Runs the gate on levels with nearly constant steps. Returns its result and the runs with
    /// shorter steps.
    fn gate_with_shorter_steps(
        error: impl Fn(f64, f64) -> f64 + Sync,
    ) -> (GateResult, Vec<(u64, f64)>) {
        let (plan, levels) = (plan(), levels([0.011, 0.01, 0.01, 0.01], &error));
        let reruns = scripted(error);
        let result = gate(&plan, &SECOND_ORDER, &levels, &plan.judge_levels(&levels), &reruns);
        let mut steps = reruns.steps.into_inner().unwrap();
        steps.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        (result, steps)
    }

    /// The error of the step is proportional to its sixth power, so half the step leaves 1/64.
    #[rstest]
    #[case::of_a_quarter(0.1, 8, Some("with 1/4 of the time step"))]
    #[case::of_an_eighth(6.4, 12, Some("with 1/8 of the time step"))]
    #[case::of_a_sixteenth(409.6, 12, None)]
    fn steps_are_halved_up_to_three_times(
        #[case] size: f64,
        #[case] runs: usize,
        #[case] remark: Option<&str>,
    ) {
        let error = |h: f64, dt: f64| 1e-6 * (h * h + size * libm::pow(dt / 0.01, 6.0));
        let (result, steps) = gate_with_shorter_steps(error);
        assert_eq!(result.result.is_ok(), remark.is_some());
        let step = result.remark.as_deref().and_then(|text| text.split(',').next());
        assert_eq!(step, remark);
        let first = [(4, 0.0055), (8, 0.005), (16, 0.005), (32, 0.005), (4, 0.00275), (8, 0.0025)];
        assert_eq!(steps[..6], first);
        assert_eq!(steps.len(), runs);
    }

    #[rstest]
    #[case::by_six_per_cent(0.94, 8, true)]
    #[case::by_four_per_cent(0.96, 1, false)]
    fn shorter_steps_must_lower_the_finest_error(
        #[case] left: f64,
        #[case] runs: usize,
        #[case] is_met: bool,
    ) {
        let floor = |h: f64, dt: f64| match dt {
            0.01.. => 0.01,
            0.005.. if h < 0.04 => 0.01 * left,
            0.005.. => 0.01,
            _ => h * h,
        };
        let (result, steps) = gate_with_shorter_steps(|h, dt| 1e-6 * floor(h, dt));
        assert_eq!((steps.len(), result.result.is_ok()), (runs, is_met), "{steps:?}");
        assert_eq!(
            result.result.err().map(|unmet| unmet.code),
            (!is_met).then_some(UnmetCode::OrderTooLow)
        );
    }

    /// The spacing falls to an eighth. The step counts as fixed if it falls to more than 0.354.
    #[test]
    fn a_step_that_falls_with_the_root_of_the_spacing_is_refined() {
        let is_fixed = |first: f64, plan: &JudgePlan<'_>| {
            is_step_fixed(plan, &levels([first, 0.02, 0.01, 0.01], |h, _| h))
        };
        let mut plan = plan();
        assert_eq!([0.0282, 0.0284].map(|first| is_fixed(first, &plan)), [true, false]);
        plan.settings.axis = Axis::Time;
        assert!(!is_fixed(0.01, &plan));
    }

    /// By hand for 99 steps: 8 sqrt(100) 1e3 2^-53 m, but at most a hundredth of the value, both
    /// divided by the scale.
    #[rstest]
    #[case::of_many_steps(1e-3, Some(1e-6), 8e10 / 9_007_199_254_740_992.0)]
    #[case::of_a_small_value(1e-10, Some(1e-6), 1e-6)]
    #[case::without_a_scale(1e-10, None, 1e-12)]
    fn rounding_is_a_random_walk_divided_by_the_scale(
        #[case] value: f64,
        #[case] scale: Option<f64>,
        #[case] expected: f64,
    ) {
        let (mut plan, mut levels) = (plan(), levels([0.01; 4], |h, _| h));
        plan.settings.scale = scale;
        levels[3].run.steps = 80;
        let reruns =
            Scripted { sizes: Some(RoundingSizes { value, ..SIZES }), ..scripted(|h, _| h) };
        assert_relative_eq!(rounding(&plan, &levels, &reruns), expected, max_relative = 1e-14);
        assert_eq!(rounding(&plan, &levels, &Scripted { sizes: None, ..reruns }), 0.0);
    }

    /// The finest level does not count, so the probes repeat the level before it.
    #[test]
    fn a_floor_is_probed_on_the_finest_level_that_counts() {
        let of_order = Expectation::of_order(2.0, "");
        let expected = Expectation { floor: Some(FloorCause::Time), ..of_order.clone() };
        let mut plan = JudgePlan { expectation: Some(&expected), ..plan() };
        let mut levels = levels([0.01; 4], |h, _| 1e-6 * h);
        levels[3].usable = false;
        let judgement = plan.judge_levels(&levels);
        let mut reruns = scripted(|h, _| h);
        let found = floor(&plan, &judgement, &levels, &reruns).expect("probes");
        assert_relative_eq!(found.error, 1.0 / 16.0);
        let probes: Vec<_> = found.probes.iter().map(|p| (p.axis, p.error.clone())).collect();
        let [time, particles] = [2e-7 / 1e-6, 3e-7 / 1e-6];
        assert_eq!(probes, [(Axis::Time, Ok(time)), (Axis::Particles, Ok(particles))]);
        plan.settings.axis = Axis::Time;
        let probes = floor(&plan, &judgement, &levels, &reruns).expect("probes").probes;
        assert_eq!((probes.len(), probes[0].axis), (1, Axis::Particles));
        reruns.can_halve = false;
        assert!(floor(&plan, &judgement, &levels, &reruns).is_none());
        plan.expectation = Some(&of_order);
        assert!(floor(&plan, &judgement, &levels, &scripted(|h, _| h)).is_none());
        let flat = Judgement { verdict: Verdict::AtFloor, ..judgement };
        assert!(floor(&plan, &flat, &levels, &scripted(|h, _| h)).is_some());
    }
}
