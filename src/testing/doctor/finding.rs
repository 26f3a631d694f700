//! Findings, in the words that the author of a solver needs.

use crate::named::named;
use serde::Serialize;

named! {
    /// Weight of a finding.
    pub enum FindingWeight {
        /// Something to be mended.
        Defect = "defect",
        /// A property of a sound scheme that an author should know.
        Remark = "remark",
    }
}

/// A finding on a solver.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct SolverFinding {
    /// Its weight.
    pub weight: FindingWeight,
    /// Its name: `gravity-left-on`.
    pub name: &'static str,
    /// Figures that were seen.
    pub seen: String,
    /// The likely cause.
    pub cause: String,
    /// Parts of a solver to look at.
    pub look_at: String,
}

impl SolverFinding {
    pub(super) fn defect(name: &'static str, seen: String, cause: &str, look_at: &str) -> Self {
        let (cause, look_at) = (cause.to_owned(), look_at.to_owned());
        Self { weight: FindingWeight::Defect, name, seen, cause, look_at }
    }

    pub(super) fn remark(name: &'static str, seen: String, cause: &str, look_at: &str) -> Self {
        Self { weight: FindingWeight::Remark, ..Self::defect(name, seen, cause, look_at) }
    }
}

/// Result of one examination.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "result", rename_all = "snake_case")]
#[non_exhaustive]
pub enum ExaminationResult {
    /// It was made.
    Examined {
        /// Figures that were measured.
        measured: String,
        /// Findings; none if all is well.
        findings: Vec<SolverFinding>,
    },
    /// The solver lacks what it takes.
    NotApplicable {
        /// Capabilities that are missing, or the solver's own reason.
        lacks: String,
    },
    /// It says nothing as long as another one has findings.
    LeftOut {
        /// Name of that examination.
        after: &'static str,
    },
}

/// One examination, with its result.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ExaminationReport {
    /// Its name: `fall`.
    pub examination: &'static str,
    /// The sight of a sound solver, in one sentence.
    pub expected: &'static str,
    /// Its result.
    #[serde(flatten)]
    pub result: ExaminationResult,
}

/// All examinations of a solver.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct DoctorReport {
    /// Name of the solver.
    pub solver: String,
    /// The solver's account of itself, as rows of name and value.
    pub settings: Vec<(String, String)>,
    /// Why no examination could be made, if none could.
    pub silent: Option<String>,
    /// The examinations, the plainest first.
    pub examinations: Vec<ExaminationReport>,
}

impl DoctorReport {
    /// The findings of all examinations.
    pub fn findings(&self) -> impl Iterator<Item = &SolverFinding> {
        self.examinations.iter().flat_map(|report| report.result.findings())
    }

    /// The number of defects.
    pub fn defects(&self) -> usize {
        self.findings().filter(|finding| finding.weight == FindingWeight::Defect).count()
    }
}

impl ExaminationResult {
    /// Its findings; none of an examination that was not made.
    pub fn findings(&self) -> &[SolverFinding] {
        match self {
            Self::Examined { findings, .. } => findings,
            Self::NotApplicable { .. } | Self::LeftOut { .. } => &[],
        }
    }
}

/// Where to look if nodes with little mass are left out.
pub(super) const MASS_THRESHOLD: &str = "a threshold on the mass of nodes, below which they get no velocity: it must \
     be zero, or far below the mass of a particle times the smallest weight";
