//! The results of a convergence study.

use crate::verify::{
    Acceptance, Axis, Conserved, ErrorScale, EstimateRefusal, Floor, History, JudgedBox, Judgement,
    Level, LimitEstimate, NormName, Quantity, RunResult, StepKind, Verdict, format_number,
};
use std::ops::Deref;

/// Properties of the study of a case that do not depend on its levels.
#[derive(Debug, Clone)]
pub struct StudySettings {
    /// Axis of refinement.
    pub axis: Axis,
    /// Theoretical order of the method; for particles per cell, that of the midpoint rule.
    pub formal_order: f64,
    /// Norm of the judged error.
    pub norm: NormName,
    /// Quantity whose error is judged.
    pub of: Quantity,
    /// Box to which errors are restricted, if any.
    pub within: Option<JudgedBox>,
    /// Divisor of the error, if any.
    pub scale: Option<f64>,
    /// Scale for comparing errors and work between cases.
    pub error_scale: ErrorScale,
    /// Whether there is an exact solution or a reference against which errors are measured.
    pub compared: bool,
    /// Whether steps advance time or the load.
    pub steps: StepKind,
    /// Reference position (m) of the observed point.
    pub observed_at: Option<Vec<f64>>,
}

/// Results of a convergence study.
#[derive(Debug, Clone)]
pub struct Convergence {
    /// Properties that do not depend on the levels.
    pub settings: StudySettings,
    /// Whether the case has bounds on measured values only. Every usable level then counts.
    pub bounded: bool,
    /// Reason why an external solver meets the requirement of `run --gate`, if it does.
    pub accepted: Option<Acceptance>,
    /// Remarks of `run --gate`: the rounding bound, an order far above the required one, and a
    /// shorter time step that restored the order.
    pub remarks: Vec<String>,
    /// Conserved sums with a reported drift.
    pub drifts: Vec<Conserved>,
    /// Whether the energy rate is reported.
    pub rated: bool,
    /// Judgement of the levels.
    pub judgement: Judgement,
    /// Cause of the error floor, if it was determined.
    pub floor: Option<Floor>,
    /// The levels, coarse to fine.
    pub levels: Vec<LevelOutcome>,
    /// Limit of the displacement (m) at the observed point in 1-D, or the reason why there is none.
    pub observed_limit: Option<Result<LimitEstimate, EstimateRefusal>>,
}

impl Deref for Convergence {
    type Target = StudySettings;

    fn deref(&self) -> &StudySettings {
        &self.settings
    }
}

/// Outcome of one level of a refinement plan.
#[derive(Debug, Clone)]
pub struct LevelOutcome {
    /// Cells along the first axis.
    pub cells: u64,
    /// Cell size (m).
    pub h: f64,
    /// Spacing on the refined axis: cell size (m), time step (s) or particle spacing (m).
    pub spacing: f64,
    /// Time step (s).
    pub dt: f64,
    /// Particles per cell; `None` for FEM.
    pub ppc: Option<u64>,
    /// Results of the run.
    pub run: RunResult,
    /// Error in the judged norm.
    pub error: f64,
    /// Whether the level may count for the verdict.
    pub usable: bool,
    /// Bound on the rounding error in the judged norm, in the unit of the judged quantity, for a
    /// solver in single precision or a case with a requirement of `run --gate`.
    pub rounding_bound: Option<f64>,
    /// Whether the displacement error (m) is smaller than `rounding_bound`.
    pub is_below_rounding: bool,
    /// Largest difference between repeated runs, in the judged norm and divided by the scale of the
    /// error. NaN if the runs cannot be compared; `None` if the level ran once.
    pub spread: Option<f64>,
    /// Order between the next coarser level and this one.
    pub order: Option<f64>,
    /// Predicted stable time step (s), if the step is automatic or exceeds the prediction.
    pub stable_time_step: Option<f64>,
}

impl LevelOutcome {
    /// Whether the time step is longer than the stable time step, if the latter is known.
    pub fn is_too_long(&self) -> bool {
        self.stable_time_step.is_some_and(|stable| self.dt > stable)
    }

    /// Converts the level to input of the judge, including the reason of a failure.
    pub fn to_level(&self) -> Level {
        let judged = Level::new(self.spacing, self.error);
        match &self.run.failure {
            Some(reason) => judged.failing(reason.clone()),
            None => judged,
        }
    }

    /// Returns the name of the level in its study, such as `64 cells` or `dt = 1e-3 s`.
    pub fn name(&self, axis: Axis) -> String {
        match (axis, self.ppc) {
            (Axis::Time, _) => format!("dt = {} s", format_number(self.dt)),
            (Axis::Particles, Some(ppc)) => format!("{ppc} particles per cell"),
            _ => format!("{} cells", self.cells),
        }
    }
}

impl Convergence {
    /// Whether the method fails at the problem. Such a failure may be expected.
    pub fn fails(&self) -> bool {
        use Verdict::{AtFloor, Divergent, Failed, Oscillatory, TooLow};
        let failures = [TooLow, AtFloor, Oscillatory, Divergent, Failed];
        !self.bounded && self.accepted.is_none() && failures.contains(&self.judgement.verdict)
    }

    /// Returns the exact displacement (m) of the observed point in 1-D at the end of the run.
    pub fn observed_exact(&self) -> Option<f64> {
        let exact = self.levels.last()?.run.observed_exact.as_deref()?;
        let [u] = exact else { return None };
        u.is_finite().then_some(*u)
    }

    /// Whether the interval of the observed limit contains the exact displacement, if both exist.
    pub fn limit_is_covered(&self) -> Option<bool> {
        let estimate = self.observed_limit?.ok()?;
        self.observed_exact().map(|exact| estimate.covers(exact))
    }

    /// Returns the verdict of the judge.
    pub fn verdict(&self) -> Verdict {
        self.judgement.verdict
    }

    /// Returns the position of the observed point, as written in titles.
    pub fn place(&self) -> Option<String> {
        let coordinates: Vec<String> =
            self.observed_at.as_ref()?.iter().map(ToString::to_string).collect();
        Some(if coordinates.len() == 1 {
            coordinates.concat()
        } else {
            format!("({})", coordinates.join(", "))
        })
    }

    /// Describes the judged error, with the time of the comparison and its unit.
    pub fn judged(&self) -> String {
        let is_over_instants = self.norm.is_over_instants() || self.of.is_sum();
        // An equilibrium is compared only at the end.
        let is_at_rest = self.levels.iter().any(|level| level.run.residual_speed.is_some());
        let time =
            if is_over_instants && !is_at_rest { " over all instants" } else { " at the end" };
        self.judged_error(time)
    }

    /// Describes the judged error, with its unit, for the axis of a figure.
    pub fn axis_label(&self) -> String {
        self.judged_error("")
    }

    fn judged_error(&self, time: &str) -> String {
        let (norm, name, unit) =
            (self.norm.name().replace('_', " "), self.of.words(), self.of.unit());
        let error = format!("{norm} error of {name}{time}");
        match self.scale.map(|scale| self.of.shown_scale(scale)) {
            Some(scale) => format!("{error}, divided by {scale} {unit}").trim_end().to_owned(),
            None if unit.is_empty() => error,
            None => format!("{error} ({unit})"),
        }
    }

    /// Returns the velocity history at the observed label, from the finest level that has one.
    pub fn history(&self) -> Option<&History> {
        self.levels.iter().rev().find_map(|level| level.run.history.as_ref())
    }
}

#[cfg(test)]
pub(in crate::verify) mod tests {
    use super::*;
    use crate::verify::{OrderHypothesis, RunErrors, SeriesPoint, estimate_limit, judge};
    use mpm_subject::RunCounters;
    use rstest::rstest;

    /// Creates a study with the spacings 1, 1/2, 1/4, ... and these errors, judged against order 2.
    pub(in crate::verify) fn study(errors: &[f64]) -> Convergence {
        let spacing = |k: usize| libm::exp2(-(k as f64));
        let level = |(k, error): (usize, &f64)| LevelOutcome {
            cells: 1 << k,
            h: spacing(k),
            spacing: spacing(k),
            dt: 0.5 * spacing(k),
            ppc: Some(2),
            run: result(),
            error: *error,
            usable: true,
            rounding_bound: None,
            is_below_rounding: false,
            spread: None,
            order: None,
            stable_time_step: None,
        };
        let levels: Vec<Level> =
            errors.iter().enumerate().map(|(k, error)| Level::new(spacing(k), *error)).collect();
        let settings = StudySettings {
            axis: Axis::Space,
            formal_order: 2.0,
            norm: NormName::Rms,
            of: Quantity::Displacement,
            within: None,
            scale: None,
            error_scale: ErrorScale { problem: String::new(), size: 1.0, growth: 2.0 },
            compared: true,
            steps: StepKind::Time,
            observed_at: None,
        };
        Convergence {
            settings,
            bounded: false,
            accepted: None,
            remarks: Vec::new(),
            drifts: Vec::new(),
            rated: false,
            judgement: judge(&levels, &OrderHypothesis::formal(2.0)),
            floor: None,
            levels: errors.iter().enumerate().map(level).collect(),
            observed_limit: None,
        }
    }

    fn result() -> RunResult {
        RunResult {
            errors: RunErrors::NONE,
            displacement_errors: None,
            drift: None,
            energy_rate: None,
            counters: RunCounters::new(0),
            steps: 1,
            failure: None,
            history: None,
            displacement: None,
            observed_error: None,
            observed_exact: None,
            residual_speed: None,
        }
    }

    #[test]
    fn verdicts_that_contradict_the_order_fail() {
        use Verdict::{AtFloor, Divergent, Failed, Oscillatory, TooLow};
        let fails = |verdict: Verdict, bounded: bool, accepted: Option<Acceptance>| {
            let mut study = study(&[1.0, 0.25]);
            (study.judgement.verdict, study.bounded) = (verdict, bounded);
            study.accepted = accepted;
            study.fails()
        };
        for &verdict in Verdict::ALL {
            let contradicts = [TooLow, AtFloor, Oscillatory, Divergent, Failed].contains(&verdict);
            assert_eq!(fails(verdict, false, None), contradicts, "{verdict}");
            assert!(!fails(verdict, true, None), "{verdict}");
            assert!(!fails(verdict, false, Some(Acceptance::Bound)), "{verdict}");
        }
    }

    #[test]
    fn a_step_at_the_limit_is_stable() {
        let mut level = study(&[1.0]).levels.remove(0);
        for (stable, is_too_long) in [(Some(0.5), false), (Some(0.499), true), (None, false)] {
            level.stable_time_step = stable;
            assert_eq!(level.is_too_long(), is_too_long, "{stable:?}");
        }
    }

    /// For order 2 the limit is 2.04, and the interval extends to the finest value, 2.
    #[rstest]
    #[case(2.0, true)]
    #[case(2.079, true)]
    #[case(1.999, false)]
    #[case(2.081, false)]
    fn an_observed_limit_covers_the_exact_displacement(#[case] exact: f64, #[case] covers: bool) {
        let mut study = study(&[1.0, 0.25, 0.0625, 0.015_625]);
        let series: Vec<SeriesPoint> = [-0.52, 1.4, 1.88, 2.0]
            .into_iter()
            .zip(&study.levels)
            .map(|(value, level)| SeriesPoint { h: level.spacing, value, resolution: 0.0 })
            .collect();
        study.observed_limit = Some(estimate_limit(&series));
        assert_eq!(study.limit_is_covered(), None);
        study.levels[3].run.observed_exact = Some(vec![exact]);
        assert_eq!(study.limit_is_covered(), Some(covers));
        study.observed_limit = Some(estimate_limit(&series[1..]));
        assert_eq!(study.limit_is_covered(), None);
    }
}
