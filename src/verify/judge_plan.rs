//! Everything that the judgement of a case depends on, and the judgement of its levels.

use super::conservation::Conserved;
use super::convergence::LevelOutcome;
use super::error::clock::StepKind;
use super::error::judged_box::JudgedBox;
use super::error::norm::ErrorScale;
use super::error::norm::NormName;
use super::error::quantity::Quantity;
use super::error::run::RunResult;
use super::exclusion::{rounding_bound, with_exclusions};
use super::expectation::gate::Gating;
use super::expectation::{Bounds, Expectation};
use super::order::hypothesis::OrderHypothesis;
use super::order::level::{Axis, Level};
use super::verdict::judge::{Judgement, judge};

/// All inputs of the judgement of a case, except its levels.
#[derive(Debug, Clone)]
pub struct JudgePlan<'a> {
    /// Axis of refinement.
    pub axis: Axis,
    /// Theoretical order of the method.
    pub formal_order: f64,
    /// Norm of the judged error.
    pub norm: NormName,
    /// The judged quantity.
    pub of: Quantity,
    /// Box to which errors are restricted, if any.
    pub within: Option<&'a JudgedBox>,
    /// Divisor of the error, if any.
    pub scale: Option<f64>,
    /// Scale that makes errors and work comparable with those of other cases.
    pub error_scale: ErrorScale,
    /// Whether errors are measured against an exact solution or a reference.
    pub is_compared: bool,
    /// Kind of the steps.
    pub steps: StepKind,
    /// Whether levels on which particles change their cell are excluded.
    pub excludes_crossings: bool,
    /// Distance (m) of neighbouring positions of a solver in single precision, if its displacement
    /// is judged and the exact motion is known.
    pub position_spacing: Option<f64>,
    /// Reference position that is observed (m).
    pub observed_at: Option<&'a [f64]>,
    /// Conserved sums whose drift is shown if the case has no expectation.
    pub sums: Vec<Conserved>,
    /// Expectation of the suite, if it states one.
    pub expectation: Option<&'a Expectation>,
    /// Treatment by the gate of external solvers, if it applies.
    pub gating: Option<&'a Gating>,
}

/// Sizes of a level.
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
    /// Distance of neighbouring particles (m).
    pub particle_spacing: f64,
}

impl JudgePlan<'_> {
    /// The outcome of a level, from its run.
    pub fn level(&self, sizes: LevelSizes, run: RunResult) -> LevelOutcome {
        let LevelSizes { cells, h, dt, ppc, particle_spacing } = sizes;
        let is_crossed = run.counters.crossings.is_some_and(|n| n > 0);
        let error = run.errors.in_norm(self.norm);
        let spacing = self.position_spacing;
        let bound = spacing.map(|spacing| rounding_bound(run.steps, spacing, self.norm));
        LevelOutcome {
            cells,
            h,
            spacing: match self.axis {
                Axis::Space => h,
                Axis::Time => dt,
                Axis::Particles => particle_spacing,
            },
            dt,
            ppc: ppc.filter(|_| run.counters.particles.is_some()),
            error: self.scale.map_or(error, |scale| error / scale),
            usable: !(is_crossed && self.excludes_crossings),
            rounding_bound: bound,
            is_below_rounding: bound.is_some_and(|bound| error < bound),
            spread: None,
            order: None,
            stable_time_step: None,
            run,
        }
    }

    /// The judgement of levels that have run.
    pub(super) fn judge_levels(&self, levels: &[LevelOutcome]) -> Judgement {
        let is_sound = levels.iter().all(|level| level.run.failure.is_none());
        if !self.is_compared && is_sound {
            return Judgement::without_comparison(levels.len());
        }
        let expected = self.expectation.and_then(|expectation| expectation.order);
        let judgement = self.judge_series(&series(levels), expected);
        with_exclusions(judgement, levels, self.axis)
    }

    /// The judgement of a series of errors, with the expected bounds of the order, if any.
    pub(super) fn judge_series(&self, levels: &[Level], expected: Option<Bounds>) -> Judgement {
        let (formal_order, axis) = (self.formal_order, self.axis);
        judge(levels, &OrderHypothesis { formal_order, expected, axis })
    }

    /// Why the gate requires nothing of a case with these levels; `None` if it does.
    pub(super) fn exemption(&self, levels: &[LevelOutcome]) -> Option<String> {
        match self.gating {
            Some(Gating::NotGated(reason)) => Some(reason.clone()),
            Some(Gating::Required(required)) => required.untestable(&usable_series(levels)),
            _ => None,
        }
    }
}

/// The levels as input of the judge, with marks on those that do not count.
pub(super) fn series(levels: &[LevelOutcome]) -> Vec<Level> {
    let marked = |level: &LevelOutcome| {
        let judged = level.to_level();
        if level.exclusion().is_none() { judged } else { judged.unusable() }
    };
    levels.iter().map(marked).collect()
}

/// The levels whose errors are compared with a bound: here levels count that rounding or spread
/// exclude from the order.
pub(super) fn usable_series(levels: &[LevelOutcome]) -> Vec<Level> {
    let marked = |level: &LevelOutcome| {
        let judged = level.to_level();
        if level.usable { judged } else { judged.unusable() }
    };
    levels.iter().map(marked).collect()
}
