//! The results of a convergence study.

use super::conservation::Conserved;
use super::error::error_scale::ErrorScale;
use super::error::observer::History;
use super::error::quantity::Quantity;
use super::error::run_result::RunResult;
use super::order::axis::Axis;
use super::order::format_number::format_number;
use super::order::richardson::Richardson;
use super::study_results::StudyResults;
use super::verdict::floor::Floor;
use super::verdict::judge::Judgement;
use super::verdict::name::Verdict;

/// Results of a convergence study.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Convergence {
    /// Axis of refinement.
    pub axis: Axis,
    /// Order that theory gives the method on a smooth solution; for particles per cell, where it
    /// gives none in general, that of the midpoint rule.
    pub formal_order: f64,
    /// Name of the error that was judged.
    pub norm: &'static str,
    /// The judged quantity.
    pub of: Quantity,
    /// Divisor of the error, if any.
    pub scale: Option<f64>,
    /// Scale that makes its errors and its work comparable with those of other cases.
    pub error_scale: ErrorScale,
    /// Whether there is a truth that errors are taken against.
    pub compared: bool,
    /// Whether bounds on figures are all that binds the case: then no order is asked for, and
    /// every usable level counts.
    pub bounded: bool,
    /// The totals whose drift was asked for.
    pub drifts: Vec<Conserved>,
    /// Whether the rate of the energy was asked for.
    pub rated: bool,
    /// The judge's finding.
    pub judgement: Judgement,
    /// Whose error the finest level shows, where that was asked.
    pub floor: Option<Floor>,
    /// The levels, coarse to fine.
    pub levels: Vec<LevelOutcome>,
    /// Richardson's extrapolation at the observed place, for each triple of levels with spacings
    /// 4, 2 and 1.
    pub richardson: Vec<([usize; 3], Richardson)>,
    /// Reference position that was observed (m).
    pub observed_at: Option<Vec<f64>>,
}

/// One level of a refinement plan.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct LevelOutcome {
    /// Cells along the first axis.
    pub cells: u64,
    /// Cell size (m).
    pub h: f64,
    /// The spacing that is judged: of cells (m), time (s) or particles (m).
    pub spacing: f64,
    /// Time step (s).
    pub dt: f64,
    /// Particles per cell (MPM).
    pub ppc: Option<u64>,
    /// Results of the run.
    pub run: RunResult,
    /// The error that was judged.
    pub error: f64,
    /// Whether the judge may count the level.
    pub usable: bool,
    /// Order between the next coarser level and this one.
    pub order: Option<f64>,
    /// The longest time step (s) that was predicted stable, where a rule asked for it, or where the
    /// step is longer.
    pub stable_time_step: Option<f64>,
}

impl StudyResults for Convergence {
    fn fails(&self) -> bool {
        use Verdict::{AtFloor, Divergent, Failed, Oscillatory, TooLow};
        let failures = [TooLow, AtFloor, Oscillatory, Divergent, Failed];
        !self.bounded && failures.contains(&self.judgement.verdict)
    }
}

impl LevelOutcome {
    /// Whether its step is longer than the stable time step, where that is known.
    pub fn is_too_long(&self) -> bool {
        self.stable_time_step.is_some_and(|stable| self.dt > stable)
    }

    /// Name of the level among those of its study: `64 cells`, `dt = 1e-3 s`.
    pub fn name(&self, axis: Axis) -> String {
        match (axis, self.ppc) {
            (Axis::Time, _) => format!("dt = {} s", format_number(self.dt)),
            (Axis::Particles, Some(ppc)) => format!("{ppc} particles per cell"),
            _ => format!("{} cells", self.cells),
        }
    }
}

impl Convergence {
    /// True relative error at the observed place of the finest level of a Richardson triple, and
    /// whether its grid convergence index covers that; absent where there is no index or no truth.
    pub fn covered(&self, (levels, found): &([usize; 3], Richardson)) -> Option<(f64, bool)> {
        let run = &self.levels.get(levels[2])?.run;
        let [u] = run.displacement.as_deref()? else { return None };
        let error = run.observed_error? / u.abs();
        found.gci.map(|gci| (error, error <= gci))
    }

    /// Verdict of the judge.
    pub fn verdict(&self) -> Verdict {
        self.judgement.verdict
    }

    /// The observed place, as titles write it.
    pub fn place(&self) -> Option<String> {
        let coordinates: Vec<String> =
            self.observed_at.as_ref()?.iter().map(ToString::to_string).collect();
        Some(if coordinates.len() == 1 {
            coordinates.concat()
        } else {
            format!("({})", coordinates.join(", "))
        })
    }

    /// The judged error in words, with its unit.
    pub fn judged(&self) -> String {
        judged_error(self.norm, self.of, self.scale)
    }

    /// The observed label's history on the finest level that has one.
    pub fn history(&self) -> Option<&History> {
        self.levels.iter().rev().find_map(|level| level.run.history.as_ref())
    }
}

/// An error in words, with its unit: a norm of a quantity, over a scale if there is one.
pub(crate) fn judged_error(norm: &str, of: Quantity, scale: Option<f64>) -> String {
    let (norm, name, unit) = (norm.replace('_', " "), of.words(), of.unit());
    match scale.map(|scale| of.shown_scale(scale)) {
        Some(scale) => format!("{norm} error of {name} over {scale} {unit}").trim_end().to_owned(),
        None if unit.is_empty() => format!("{norm} error of {name}"),
        None => format!("{norm} error of {name} ({unit})"),
    }
}
