//! The inputs that determine the judgement of a case, and the judgement of its levels.

use super::exclusion::{rounding_bound, with_exclusions};
use crate::verify::{
    Axis, Bounds, Conserved, Expectation, Gating, Judgement, Level, LevelOutcome, OrderHypothesis,
    RunResult, StudySettings, judge,
};

/// All inputs of the judgement of a case, except its levels.
#[derive(Debug, Clone)]
pub struct JudgePlan<'a> {
    /// Properties of the study.
    pub settings: StudySettings,
    /// Whether to exclude levels on which particles change their cell.
    pub excludes_crossings: bool,
    /// Distance (m) between neighbouring positions in single precision. Set if a solver in single
    /// precision is judged by its displacement and the exact motion is known.
    pub position_spacing: Option<f64>,
    /// Conserved sums whose drift is reported for a case without an expectation.
    pub sums: Vec<Conserved>,
    /// Expectation of the suite, if any.
    pub expectation: Option<&'a Expectation>,
    /// Treatment of an external solver's case by `run --gate`; `None` without `--gate`.
    pub gating: Option<&'a Gating>,
}

/// Resolution of a level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LevelSizes {
    /// Cells along the first axis.
    pub cells: u64,
    /// Cell size (m).
    pub h: f64,
    /// Actual time step (s).
    pub dt: f64,
    /// Particles per cell; `None` without particles.
    pub ppc: Option<u64>,
    /// Distance between neighbouring particles (m).
    pub particle_spacing: f64,
}

/// A level that has run, before it is judged.
#[derive(Debug, Clone)]
pub struct LevelRun {
    /// Resolution.
    pub sizes: LevelSizes,
    /// Results of the run.
    pub run: RunResult,
    /// Largest difference between repeated runs, in the judged norm; `None` if the level ran once.
    pub spread: Option<f64>,
    /// Predicted stable time step (s), if the step is automatic or exceeds the prediction.
    pub stable_time_step: Option<f64>,
}

impl JudgePlan<'_> {
    pub(super) fn level(&self, level: LevelRun) -> LevelOutcome {
        let LevelRun { sizes, run, spread, stable_time_step } = level;
        let LevelSizes { cells, h, dt, ppc, particle_spacing } = sizes;
        let is_crossed = run.counters.crossings.is_some_and(|n| n > 0);
        let StudySettings { axis, norm, compared, .. } = self.settings;
        let error = run.errors.in_norm(norm);
        let spacing = self.position_spacing;
        let bound = spacing.map(|spacing| rounding_bound(run.steps, spacing, norm));
        LevelOutcome {
            cells,
            h,
            spacing: match axis {
                Axis::Space => h,
                Axis::Time => dt,
                Axis::Particles => particle_spacing,
            },
            dt,
            ppc: ppc.filter(|_| run.counters.particles.is_some()),
            error: self.relative(error),
            usable: !(is_crossed && self.excludes_crossings),
            rounding_bound: bound,
            is_below_rounding: bound.is_some_and(|bound| error < bound),
            spread: spread.filter(|_| compared).map(|spread| self.relative(spread)),
            order: None,
            stable_time_step,
            run,
        }
    }

    fn relative(&self, difference: f64) -> f64 {
        self.settings.scale.map_or(difference, |scale| difference / scale)
    }

    pub(super) fn judge_levels(&self, levels: &[LevelOutcome]) -> Judgement {
        let is_sound = levels.iter().all(|level| level.run.failure.is_none());
        if !self.settings.compared && is_sound {
            return Judgement::without_comparison(levels.len());
        }
        let expected = self.expectation.and_then(|expectation| expectation.order);
        let judgement = self.judge_series(&series(levels), expected);
        with_exclusions(judgement, levels, self.settings.axis)
    }

    /// Judges a series of errors. `expected` contains the expected bounds of the order, if any.
    pub(super) fn judge_series(&self, levels: &[Level], expected: Option<Bounds>) -> Judgement {
        let StudySettings { formal_order, axis, .. } = self.settings;
        judge(levels, &OrderHypothesis { formal_order, expected, axis })
    }

    /// Returns the reason why `run --gate` requires nothing of a case with these levels; `None` if
    /// it requires something.
    pub(super) fn exemption(&self, levels: &[LevelOutcome]) -> Option<String> {
        match self.gating {
            Some(Gating::NotGated(reason)) => Some(reason.clone()),
            Some(Gating::Required(required)) => required.untestable(&usable_series(levels)),
            _ => None,
        }
    }
}

/// Converts levels to input of the judge. Excluded levels are marked as unusable.
pub(super) fn series(levels: &[LevelOutcome]) -> Vec<Level> {
    let marked = |level: &LevelOutcome| {
        let judged = level.to_level();
        if level.exclusion().is_none() { judged } else { judged.unusable() }
    };
    levels.iter().map(marked).collect()
}

/// Converts levels to input of the requirement check, also those excluded from the order.
pub(super) fn usable_series(levels: &[LevelOutcome]) -> Vec<Level> {
    let marked = |level: &LevelOutcome| {
        let judged = level.to_level();
        if level.usable { judged } else { judged.unusable() }
    };
    levels.iter().map(marked).collect()
}

#[cfg(test)]
pub(in crate::verify) mod tests {
    use super::*;
    use crate::verify::convergence::tests::study;
    use crate::verify::{NormName, Norms, RunErrors};
    use approx::assert_relative_eq;
    use rstest::rstest;

    /// Creates the plan of a study in space of order 2, whose errors are divided by 1e-6 m.
    pub(in crate::verify) fn plan() -> JudgePlan<'static> {
        let settings = study(&[1.0]).settings;
        JudgePlan {
            settings: StudySettings { scale: Some(1e-6), norm: NormName::L2, ..settings },
            excludes_crossings: true,
            position_spacing: None,
            sums: Vec::new(),
            expectation: None,
            gating: None,
        }
    }

    /// Creates a level of a body of 1 m with 99 steps of `dt` (s) and the L2 error `error` (m).
    pub(in crate::verify) fn level_run(cells: u64, dt: f64, error: f64) -> LevelRun {
        let [rms, l1, linf] = [2.0, 3.0, 5.0].map(|factor| factor * error);
        let at_end = Norms { rms, l1, l2: error, linf, mass_l2: None };
        let errors = RunErrors { at_end, largest: Norms { l2: 7.0 * error, ..at_end } };
        let run = study(&[1.0]).levels.remove(0).run;
        let h = 1.0 / cells as f64;
        let sizes = LevelSizes { cells, h, dt, ppc: Some(4), particle_spacing: 0.25 * h };
        let run = RunResult { errors, steps: 99, ..run };
        LevelRun { sizes, run, spread: None, stable_time_step: None }
    }

    /// The bound of 300 steps is 3e-6/sqrt(12) = 8.66e-7 m, compared with the error in metres.
    #[rstest]
    fn a_level_has_the_spacing_of_its_axis_and_errors_divided_by_the_scale(
        #[values((Axis::Space, 0.125), (Axis::Time, 0.01), (Axis::Particles, 0.03125))]
        (axis, spacing): (Axis, f64),
        #[values((8.6e-7, true), (8.7e-7, false))] (error, is_below): (f64, bool),
    ) {
        let mut plan = JudgePlan { position_spacing: Some(1e-8), ..plan() };
        plan.settings.axis = axis;
        let mut run = level_run(8, 0.01, error);
        (run.run.steps, run.spread, run.stable_time_step) = (300, Some(2e-8), Some(0.02));
        let bare = plan.level(run.clone());
        assert_eq!((bare.usable, bare.ppc), (true, None));
        (run.run.counters.particles, run.run.counters.crossings) = (Some(32), Some(1));
        let level = plan.level(run.clone());
        assert_eq!((level.spacing, level.is_below_rounding), (spacing, is_below));
        assert_eq!((level.cells, level.h, level.dt, level.ppc), (8, 0.125, 0.01, Some(4)));
        assert_eq!((level.usable, level.stable_time_step), (false, Some(0.02)));
        assert_relative_eq!(level.error, 1e6 * error, max_relative = 1e-14);
        assert_relative_eq!(level.spread.unwrap(), 0.02, max_relative = 1e-14);
        let bound = 3e-6 / 12.0_f64.sqrt();
        assert_relative_eq!(level.rounding_bound.unwrap(), bound, max_relative = 1e-14);
        (plan.excludes_crossings, plan.settings.compared) = (false, false);
        plan.settings.scale = None;
        let other = plan.level(run);
        assert_eq!((other.usable, other.spread, other.error), (true, None, error));
    }
}
