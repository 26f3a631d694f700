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
