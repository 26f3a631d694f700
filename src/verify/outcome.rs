//! The results of a suite: all that reports are made of.

use super::conservation::Conserved;
use super::error::error_scale::ErrorScale;
use super::error::observer::History;
use super::error::quantity::Quantity;
use super::error::run_result::RunResult;
use super::order::axis::Axis;
use super::order::format_number::format_number;
use super::order::richardson::Richardson;
use super::stability::StabilityStudy;
use super::verdict::floor::Floor;
use super::verdict::judge::Judgement;
use super::verdict::name::Verdict;
use crate::subject::Profile;
use std::any::Any;
use std::fmt::Debug;
use std::sync::Arc;

/// One suite, run.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct SuiteOutcome {
    /// Name of the suite.
    pub suite: String,
    /// Name of the folder of its file.
    pub group: String,
    /// Headline.
    pub title: String,
    /// Where the problem comes from.
    pub source: String,
    /// Introduction by the author.
    pub about: String,
    /// The problem as rows of name and value: parameters, scene, exact solution, dt rule.
    pub statement: Vec<(String, String)>,
    /// One outcome for each case, in the order of the suite.
    pub cases: Vec<CaseOutcome>,
}

/// One case, run and judged.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct CaseOutcome {
    /// Name of the case, unique in its suite.
    pub case: String,
    /// Which subject: `mpm` or `fem`.
    pub subject: &'static str,
    /// Settings of the method: basis, transfer, mass matrix, start, truth.
    pub settings: Vec<(String, String)>,
    /// Cost of a step on the coarsest level, from a subject that has a profile.
    pub profile: Option<Profile>,
    /// Expectation, in one line; none of a suite that explores, which is no gate.
    pub expected: Option<String>,
    /// The suite's reason for expecting it; empty if nothing is expected.
    pub because: String,
    /// The verdict, in words.
    pub verdict: String,
    /// The figures that led to the verdict.
    pub reason: String,
    /// Expectations that are not met; empty if the case passed.
    pub unmet: Vec<String>,
    /// Everything that the case needs and its solver lacks; empty if the case applies.
    pub lacks: Vec<String>,
    /// Results of its kind of study; absent if the case could not be set up, for the reason in
    /// `reason`.
    pub study: Option<Arc<dyn StudyResults>>,
}

/// Results of one kind of study. What shows them is listed in `report::study`.
pub trait StudyResults: Any + Debug + Send + Sync {}

impl StudyResults for Convergence {}
impl StudyResults for StabilityStudy {}

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

impl SuiteOutcome {
    /// Whether every case passed.
    pub fn passed(&self) -> bool {
        self.cases.iter().all(CaseOutcome::passed)
    }

    /// The results of one kind of study, with the names of their cases.
    pub fn results<'a, R: StudyResults>(&'a self) -> impl Iterator<Item = (&'a str, &'a R)> {
        let study = |case: &'a CaseOutcome| Some((case.case.as_str(), case.results()?));
        self.cases.iter().filter_map(study)
    }
}

impl CaseOutcome {
    /// Whether everything came as expected.
    pub fn passed(&self) -> bool {
        self.unmet.is_empty()
    }

    /// One word: `pass`, `FAIL`, `explored` where nothing is expected, or `n/a` where the solver
    /// lacks something.
    pub fn result(&self) -> &'static str {
        if !self.lacks.is_empty() {
            return "n/a";
        }
        match (self.passed(), &self.expected) {
            (false, _) => "FAIL",
            (true, Some(_)) => "pass",
            (true, None) => "explored",
        }
    }

    /// The outcome of a case that its solver cannot be put to: what it lacks, with a verb.
    #[must_use]
    pub(crate) fn not_applicable(self, lacks: Vec<String>, verb: &str) -> Self {
        let verdict = "not applicable".to_owned();
        let reason = format!("the solver {verb} {}", lacks.join(", "));
        Self { verdict, reason, lacks, ..self }
    }

    /// The expectation and its reason, in one line.
    pub fn expectation(&self) -> String {
        match &self.expected {
            Some(expected) => format!("{expected}, because {}", self.because),
            None => "nothing: the suite has no `expect`, and is no gate".to_owned(),
        }
    }

    /// The convergence study, if the case is one.
    pub fn convergence(&self) -> Option<&Convergence> {
        self.results()
    }

    /// The results, if they are of this kind of study.
    pub fn results<R: StudyResults>(&self) -> Option<&R> {
        let results: &dyn Any = self.study.as_deref()?;
        results.downcast_ref()
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

    /// Whether the judged error is not among the errors of the primary unknown that tables show.
    pub fn is_judged_by_another_figure(&self) -> bool {
        let shown = ["rms", "l1", "l2", "linf", "max_rms"].contains(&self.norm);
        !self.of.is_primary() || self.scale.is_some() || !shown
    }

    /// The judged error in words, with its unit.
    pub fn judged(&self) -> String {
        let (norm, of, unit) = (self.norm.replace('_', " "), self.of.words(), self.of.unit());
        match self.scale.map(|scale| self.of.shown_scale(scale)) {
            Some(scale) => {
                format!("{norm} error of {of} over {scale} {unit}").trim_end().to_owned()
            }
            None if unit.is_empty() => format!("{norm} error of {of}"),
            None => format!("{norm} error of {of} ({unit})"),
        }
    }

    /// The observed label's history on the finest level that has one.
    pub fn history(&self) -> Option<&History> {
        self.levels.iter().rev().find_map(|level| level.run.history.as_ref())
    }
}
