//! Runs a solver on one level and compares the result with the exact solution.

use super::judged_sum::{JudgedSum, over_instants};
use super::norm::{NormName, RunErrors, larger, largest_length};
use crate::exact::Truth;
use crate::verify::conservation::{Balance, ConservationError};
use crate::verify::energy_rate::energy_rate;
use crate::verify::{
    Clock, History, Interval, JudgedBox, Quantity, RunRecord, StepKind, displacement_at,
};
use mpm_subject::{Failure, RunCounters, Samples, Subject, Totals};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// Settings of the comparison between a run and the exact solution.
#[derive(Debug, Clone, Copy, Default)]
pub struct Comparison<'a> {
    /// Quantity whose error is judged.
    pub of: Quantity,
    /// Exact value of the judged quantity, if it is a sum over the body.
    pub sum: Option<&'a JudgedSum>,
    /// Box to which errors are restricted; `None` for the whole body.
    pub within: Option<&'a JudgedBox>,
    /// Reference position (m) of the observed point, if any.
    pub observe: Option<&'a [f64]>,
    /// Speed (m/s) by which residual speeds are divided. Set if the exact solution is a state of
    /// rest; errors are then measured at the end only.
    pub at_rest: Option<f64>,
    /// Whether steps advance time or the load.
    pub steps: StepKind,
}

impl Comparison<'_> {
    fn is_of_another(&self) -> bool {
        self.sum.is_some() || self.of != Quantity::default()
    }
}

/// Fraction of a run at its end in which a body must be at rest. One instant does not suffice,
/// because an oscillating body has zero velocity at its turning points.
const LAST: f64 = 0.1;

/// Advances `subject` over all steps of `clock`, and measures its error against `truth` at every
/// instant. Also records the velocity of the label nearest to the observed point.
pub fn run(
    subject: &mut dyn Subject,
    truth: &dyn Truth,
    clock: &Clock,
    comparison: &Comparison<'_>,
) -> RunResult {
    RunMonitor::new(subject, truth, comparison).run(subject, clock).0
}

/// Runs `subject` like [`run`]. Also records the judged quantity, for a comparison in `norm` with
/// other runs of the same level; the record of a failed run is empty.
pub fn run_recorded(
    subject: &mut dyn Subject,
    truth: &dyn Truth,
    clock: &Clock,
    comparison: &Comparison<'_>,
    norm: NormName,
) -> (RunResult, RunRecord) {
    let mut monitor = RunMonitor::new(subject, truth, comparison);
    monitor.record = Some(RunRecord::for_norm(norm));
    monitor.run(subject, clock)
}

struct RunMonitor<'a> {
    truth: &'a dyn Truth,
    comparison: &'a Comparison<'a>,
    samples: Samples,
    errors: RunErrors,
    displacement_errors: Option<RunErrors>,
    sum_errors: Vec<[f64; 3]>,
    balance: Option<Balance>,
    account: Vec<(f64, Totals)>,
    residual_speed: Option<f64>,
    history: Option<(usize, History)>,
    record: Option<RunRecord>,
}

impl<'a> RunMonitor<'a> {
    fn new(subject: &dyn Subject, truth: &'a dyn Truth, comparison: &'a Comparison<'a>) -> Self {
        let mut samples = Samples::default();
        subject.sample(&mut samples);
        let history = comparison.observe.and_then(|place| {
            let (at, mut history) = History::start(&samples, place)?;
            history.record(at, &samples, truth, 0.0);
            Some((at, history))
        });
        Self {
            truth,
            comparison,
            samples,
            errors: RunErrors::START,
            displacement_errors: comparison.is_of_another().then_some(RunErrors::START),
            sum_errors: Vec::new(),
            balance: subject.totals().map(Balance::start),
            account: subject.totals().map(|totals| (0.0, totals)).into_iter().collect(),
            residual_speed: comparison.at_rest.map(|_| 0.0),
            history,
            record: None,
        }
    }

    fn run(mut self, subject: &mut dyn Subject, clock: &Clock) -> (RunResult, RunRecord) {
        for step in 1..=clock.steps {
            if let Err(failure) = subject.step(clock.dt()) {
                let failed = self.failed(subject, step, clock.time(step), &failure);
                return (failed, RunRecord::default());
            }
            self.look(subject, clock, step);
        }
        let record = self.record.take().map(|mut record| {
            record.sums.clone_from(&self.sum_errors);
            record
        });
        (self.finished(subject, clock), record.unwrap_or_default())
    }

    fn look(&mut self, subject: &dyn Subject, clock: &Clock, step: u64) {
        if !clock.is_instant(step) {
            return;
        }
        subject.sample(&mut self.samples);
        let t = clock.time(step);
        if let Some(balance) = &mut self.balance {
            let totals = subject.totals();
            balance.look(totals.as_ref());
            self.account.extend(totals.map(|totals| (t, totals)));
        }
        if let Some((at, history)) = &mut self.history {
            history.record(*at, &self.samples, self.truth, t);
        }
        if let Some(speed) = self.comparison.at_rest {
            if t >= (1.0 - LAST) * clock.until {
                let residual_speed = larger(
                    self.residual_speed.unwrap_or(0.0),
                    largest_length(&self.samples.velocity, self.samples.dimension) / speed,
                );
                self.residual_speed = Some(residual_speed);
            }
            if step < clock.steps {
                return;
            }
        }
        let judged = match self.comparison.within {
            Some(within) => Cow::Owned(within.restrict(&self.samples)),
            None => Cow::Borrowed(&self.samples),
        };
        if let Some(displacement) = &mut self.displacement_errors {
            displacement.add(Quantity::Displacement.errors(&judged, self.truth, t));
        }
        if let Some(sum) = self.comparison.sum {
            self.sum_errors.push(sum.error(subject, t));
            return;
        }
        let of = self.comparison.of;
        self.errors.add(of.errors(&judged, self.truth, t));
        if let Some(record) = &mut self.record {
            record.add(of, &judged, self.truth, t);
        }
    }

    fn finished(mut self, subject: &dyn Subject, clock: &Clock) -> RunResult {
        if self.comparison.sum.is_some() {
            let errors = over_instants(&self.sum_errors);
            self.errors = RunErrors { at_end: errors, largest: errors };
        }
        let place = self.comparison.observe;
        let displacement = place.and_then(|place| displacement_at(&self.samples, place));
        let exact_at = |(place, u): (&[f64], &Vec<f64>)| {
            let mut exact = vec![0.0; u.len()];
            self.truth.displacement(place, clock.until, &mut exact);
            exact
        };
        let observed_exact = place.zip(displacement.as_ref()).map(exact_at);
        let distance = |(u, exact): (&Vec<f64>, &Vec<f64>)| {
            u.iter().zip(exact).fold(0.0, |all, (u, e)| libm::hypot(all, u - e))
        };
        RunResult {
            errors: self.errors,
            displacement_errors: self.displacement_errors,
            drift: self.balance.as_ref().map(Balance::drift),
            energy_rate: energy_rate(&self.account),
            counters: subject.counters(),
            steps: clock.steps,
            failure: None,
            observed_error: displacement.as_ref().zip(observed_exact.as_ref()).map(distance),
            observed_exact,
            displacement,
            residual_speed: self.residual_speed,
            history: self.history.map(|(_, history)| history),
        }
    }

    fn failed(self, subject: &dyn Subject, step: u64, t: f64, failure: &Failure) -> RunResult {
        let reason = match self.comparison.steps {
            StepKind::Load => format!("{failure} (load step {step})"),
            StepKind::Time => format!("{failure} (step {step}, t = {t:.4} s)"),
        };
        RunResult {
            errors: RunErrors::NONE,
            displacement_errors: self.displacement_errors.map(|_| RunErrors::NONE),
            drift: self.balance.map(|_| ConservationError::NONE),
            energy_rate: None,
            counters: subject.counters(),
            steps: step,
            failure: Some(reason),
            history: None,
            displacement: None,
            observed_error: None,
            observed_exact: None,
            residual_speed: self.residual_speed.map(|_| f64::NAN),
        }
    }
}

/// Results of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RunResult {
    /// Errors of the judged quantity.
    pub errors: RunErrors,
    /// Errors of the displacement (m), if the judged quantity is another one.
    pub displacement_errors: Option<RunErrors>,
    /// Drifts of the sums over the body, if the solver reports these sums; NaN if the run failed.
    pub drift: Option<ConservationError>,
    /// Energy rate d ln E/dt (1/s) with its confidence interval, if it could be computed.
    pub energy_rate: Option<Interval>,
    /// Counters at the end of the run or at its failure.
    pub counters: RunCounters,
    /// Number of steps.
    pub steps: u64,
    /// Reason and time of the failure; `None` if the run reached its end.
    pub failure: Option<String>,
    /// Velocity history at the observed label, if it was requested and the run reached its end.
    pub history: Option<History>,
    /// Displacement (m) of the observed point at the end, if it could be interpolated.
    pub displacement: Option<Vec<f64>>,
    /// Distance (m) between the computed and the exact displacement of the observed point.
    pub observed_error: Option<f64>,
    /// Exact displacement (m) of the observed point at the end.
    pub observed_exact: Option<Vec<f64>>,
    /// Largest speed near the end, divided by
    /// [`Comparison::at_rest`](crate::verify::Comparison::at_rest), if that is set.
    pub residual_speed: Option<f64>,
}

impl RunResult {
    /// Returns the errors of the displacement (m), regardless of the judged quantity.
    pub fn errors_of_displacement(&self) -> &RunErrors {
        self.displacement_errors.as_ref().unwrap_or(&self.errors)
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use mpm_subject::RunCounters;

    /// A solver with one point, whose velocity oscillates and whose displacement decays.
    struct Swing(f64);

    impl Subject for Swing {
        fn step(&mut self, dt: f64) -> Result<(), Failure> {
            self.0 += dt;
            Ok(())
        }

        fn sample(&self, samples: &mut Samples) {
            samples.clear();
            samples.dimension = 1;
            samples.label.push(0.0);
            samples.weight.push(1.0);
            samples.displacement.push(1.0 / (1.0 + self.0));
            samples.velocity.push(libm::cos(self.0));
        }

        fn counters(&self) -> RunCounters {
            RunCounters::new(0)
        }
    }

    pub(in crate::verify) struct AtRest;

    impl Truth for AtRest {
        fn displacement(&self, _: &[f64], _: f64, into: &mut [f64]) {
            into.fill(0.0);
        }

        fn velocity(&self, _: &[f64], _: f64, into: &mut [f64]) {
            into.fill(0.0);
        }
    }

    /// A solver that fails in its third step.
    struct Unbalanced(u64);

    impl Subject for Unbalanced {
        fn step(&mut self, _: f64) -> Result<(), Failure> {
            self.0 += 1;
            let failure = Failure::NotConverged { residual: 0.25, node: 7 };
            if self.0 < 3 { Ok(()) } else { Err(failure) }
        }

        fn sample(&self, samples: &mut Samples) {
            samples.restart(1);
            samples.push(&[0.0], &[0.0], &[0.0], 1.0);
        }

        fn counters(&self) -> RunCounters {
            RunCounters::new(0)
        }
    }

    #[test]
    fn failure_in_load_steps_names_the_load_step() {
        let clock = Clock::new(5.0, 1.0, 5).unwrap();
        let comparison = Comparison { steps: StepKind::Load, ..Comparison::default() };
        let result = run(&mut Unbalanced(0), &AtRest, &clock, &comparison);
        let expected = "Newton's method did not converge: the largest residual is 2.5e-1 of the \
                        load, at node 7 (load step 3)";
        assert_eq!(result.failure.as_deref(), Some(expected));
        let in_time = run(&mut Unbalanced(0), &AtRest, &clock, &Comparison::default());
        assert!(in_time.failure.unwrap().ends_with("(step 3, t = 3.0000 s)"));
    }

    /// The run ends at cos t = 0, where errors before the end must not count.
    #[test]
    fn oscillating_body_is_not_at_rest() {
        let until = 2.5 * std::f64::consts::PI;
        let clock = Clock::new(until, until / 100.0, 100).unwrap();
        let comparison = Comparison { at_rest: Some(2.0), ..Comparison::default() };
        let found = run(&mut Swing(0.0), &AtRest, &clock, &comparison);
        assert_relative_eq!(
            found.residual_speed.unwrap(),
            libm::cos(0.9 * until) / 2.0,
            max_relative = 1e-9
        );
        assert_relative_eq!(found.errors.largest.rms, 1.0 / (1.0 + until), max_relative = 1e-12);
        let moving = run(&mut Swing(0.0), &AtRest, &clock, &Comparison::default());
        assert_eq!((moving.residual_speed, moving.errors.largest.rms > 0.9), (None, true));
    }
}
