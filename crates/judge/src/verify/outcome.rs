//! The results of a suite: the input of all reports.

use crate::verify::{
    CaseJudgement, Convergence, Gating, GradientStudy, SpectrumStudy, StabilityStudy, Unmet,
    UnmetCode, Verdict,
};
use mpm_subject::{Profile, SubjectError, named};
use std::sync::Arc;

/// Results of one suite.
#[derive(Debug, Clone)]
pub struct SuiteOutcome {
    /// Name of the suite.
    pub suite: String,
    /// Name of the folder of the suite file.
    pub group: String,
    /// One-line title of the suite.
    pub title: String,
    /// Literature reference for the problem.
    pub source: String,
    /// Introduction by the suite's author.
    pub about: String,
    /// The problem as rows of name and value: parameters, scene, exact solution, time step.
    pub statement: Vec<(String, String)>,
    /// Hash of the problem, independent of the notation of the statement.
    pub meaning: u64,
    /// One outcome for each case, in suite order.
    pub cases: Vec<CaseOutcome>,
}

impl SuiteOutcome {
    /// Appends the cases of `other`, a run of the same suite with another solver, to `joined`.
    pub fn join(joined: &mut Option<Self>, other: Self) {
        match joined {
            None => *joined = Some(other),
            Some(joined) => joined.cases.extend(other.cases),
        }
    }

    /// Whether every case passed.
    pub fn passed(&self) -> bool {
        self.cases.iter().all(CaseOutcome::passed)
    }

    /// Returns the results of one kind of study, accessed by `of`, with the names of their cases.
    pub fn results<'a, R: 'a>(
        &'a self,
        of: fn(&'a CaseOutcome) -> Option<&'a R>,
    ) -> impl Iterator<Item = (&'a str, &'a R)> {
        self.cases.iter().filter_map(move |case| Some((case.case.as_str(), of(case)?)))
    }
}

/// Result of one case.
#[derive(Debug, Clone)]
pub struct CaseOutcome {
    /// Name of the case, unique in its suite.
    pub case: String,
    /// Kind of solver, such as `mpm`, `fem` or `external`.
    pub subject: &'static str,
    /// Settings of the method: basis, transfer, mass matrix, start, kind of reference.
    pub settings: Vec<(String, String)>,
    /// Loads, passes and memory of a step on the coarsest level, if the solver reports a profile.
    pub profile: Option<Profile>,
    /// Expectation in one line; `None` if the suite only explores and expects nothing.
    pub expected: Option<String>,
    /// Reason for the expectation, from the suite; empty if nothing is expected.
    pub because: String,
    /// Verdict, as text.
    pub verdict: String,
    /// Explanation of the verdict, with the measured values that led to it.
    pub reason: String,
    /// Unmet expectations; empty if the case passed.
    pub unmet: Vec<Unmet>,
    /// Missing capabilities of the solver; empty if the case applies.
    pub lacks: Vec<String>,
    /// Reason why `run --gate` has no requirement for the case; `None` if it has one.
    pub exemption: Option<Exemption>,
    /// Results of the study; `None` if the case could not be set up, as `reason` explains.
    pub study: Option<StudyResults>,
}

named! {
    /// Result of a case, with its name in all reports.
    pub enum CaseResult {
        /// The expectations are met, and the method does not fail.
        Pass = "pass",
        /// The method fails, as the suite predicts and explains. With `run --gate` also a case that
        /// the author of the solver excepts.
        KnownLimit = "known limit",
        /// An expectation is not met, or the case could not be run.
        Fail = "FAIL",
        /// The solver lacks a capability that the problem requires.
        NotApplicable = "not applicable",
        /// Nothing is expected: neither the suite nor the gate has a requirement.
        Explored = "explored",
    }
}

/// Results of a study, by its kind. The functions that report them are listed in `report::study`.
#[derive(Debug, Clone)]
pub enum StudyResults {
    /// Errors on several levels of refinement.
    Convergence(Arc<Convergence>),
    /// The internal force on a node while a particle moves.
    InternalForce(Arc<InternalForce>),
    /// Growth of energy in runs.
    Stability(Arc<StabilityStudy>),
    /// Derivatives that a solver reports.
    Gradient(Arc<GradientStudy>),
    /// Phase speed and damping of waves.
    Spectrum(Arc<SpectrumStudy>),
}

impl StudyResults {
    /// Whether the method fails at the problem. Such a failure may be expected.
    pub fn fails(&self) -> bool {
        match self {
            Self::Convergence(study) => study.fails(),
            Self::InternalForce(_) => false,
            Self::Stability(study) => study.fails(),
            Self::Gradient(study) => study.fails(),
            Self::Spectrum(study) => study.fails(),
        }
    }
}

/// Results of an internal-force study.
#[derive(Debug, Clone)]
pub struct InternalForce {
    /// Internal force on the node for every position of the moving particle.
    pub rows: Vec<ForceRow>,
}

/// Results for one position of the moving particle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ForceRow {
    /// Position of the moving particle, in cells from the node.
    pub position: f64,
    /// Number of particles in the cell on the left.
    pub left: u64,
    /// Number of particles in the cell on the right.
    pub right: u64,
    /// Internal force on the node (N).
    pub force: f64,
    /// Internal force by the formula of the suite (N).
    pub predicted: f64,
}

/// Reason why `run --gate` requires nothing of a case; [`CaseOutcome::reason`] explains it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Exemption {
    /// The suite cannot test the requirement.
    NotGated,
    /// The author of the solver excepts the case, so it has not run.
    Excepted,
}

impl CaseOutcome {
    /// Creates the outcome of a case that has not run, without an expectation.
    pub fn new(case: &str, subject: &'static str, settings: Vec<(String, String)>) -> Self {
        Self {
            case: case.to_owned(),
            subject,
            settings,
            profile: None,
            expected: None,
            because: String::new(),
            verdict: String::new(),
            reason: String::new(),
            unmet: Vec::new(),
            lacks: Vec::new(),
            exemption: None,
            study: None,
        }
    }

    /// Returns all unmet expectations in one line.
    pub fn failure(&self) -> String {
        self.unmet.iter().map(|unmet| unmet.text.as_str()).collect::<Vec<_>>().join("; ")
    }

    /// Whether all expectations are met.
    pub fn passed(&self) -> bool {
        self.unmet.is_empty()
    }

    /// Whether the case applies to the solver and is not exempted by `run --gate`.
    pub fn is_tested(&self) -> bool {
        self.lacks.is_empty() && self.exemption.is_none()
    }

    /// Returns the value of the method's setting `name`.
    pub fn setting(&self, name: &str) -> Option<&str> {
        self.settings.iter().find(|(known, _)| known == name).map(|(_, value)| value.as_str())
    }

    /// Whether the method fails at the problem. Such a failure may be expected.
    pub fn fails(&self) -> bool {
        self.study.as_ref().is_some_and(StudyResults::fails)
    }

    /// Returns the result of the case.
    pub fn result(&self) -> CaseResult {
        if !self.lacks.is_empty() {
            return CaseResult::NotApplicable;
        }
        match self.exemption {
            Some(Exemption::NotGated) => return CaseResult::Explored,
            Some(Exemption::Excepted) => return CaseResult::KnownLimit,
            None => {}
        }
        match (self.passed(), &self.expected) {
            (false, _) => CaseResult::Fail,
            (true, None) => CaseResult::Explored,
            (true, Some(_)) if self.fails() => CaseResult::KnownLimit,
            (true, Some(_)) => CaseResult::Pass,
        }
    }

    /// Converts the outcome to that of a case that does not apply to its solver. `lacks` are the
    /// missing capabilities; `verb` introduces them in the reason.
    #[must_use]
    pub fn not_applicable(self, lacks: Vec<String>, verb: &str) -> Self {
        let verdict = CaseResult::NotApplicable.name().to_owned();
        let reason = format!("the solver {verb} {}", lacks.join(", "));
        Self { verdict, reason, lacks, ..self }
    }

    /// Converts the outcome to that of a case that an external solver rejected or failed to run.
    #[must_use]
    pub fn not_run(self, error: &SubjectError) -> Self {
        match error {
            SubjectError::Unsupported(reason) => {
                self.not_applicable(vec![reason.clone()], "refuses the problem:")
            }
            SubjectError::Failed(_) => self.could_not_run(error),
        }
    }

    /// Converts the outcome to that of a case whose solver failed.
    #[must_use]
    pub fn could_not_run(self, error: &SubjectError) -> Self {
        let text = format!("the case could not be run: {error}");
        let unmet = vec![Unmet::new(UnmetCode::RunFailed, text)];
        let (verdict, reason) = (Verdict::Failed.to_string(), error.to_string());
        Self { verdict, reason, unmet, ..self }
    }

    /// Converts the outcome to that of a case that `run --gate` does not judge, for `reason`.
    #[must_use]
    pub(crate) fn not_gated(self, reason: &str) -> Self {
        let reason = format!("{reason}; {}", self.reason);
        Self { reason, exemption: Some(Exemption::NotGated), ..self }
    }

    /// Completes the outcome by calling `run`. The case does not run if `gating` excepts it, or if
    /// the solver lacks capabilities (`lacks`).
    #[must_use]
    pub fn after(
        self,
        gating: Option<&Gating>,
        lacks: Vec<String>,
        run: impl FnOnce(Self) -> Self,
    ) -> Self {
        if let Some(Gating::Excepted(reason)) = gating {
            return self.excepted(reason.clone());
        }
        if !lacks.is_empty() {
            return self.not_applicable(lacks, "lacks");
        }
        let outcome = run(self);
        match gating {
            Some(Gating::NotGated(reason)) if outcome.lacks.is_empty() => outcome.not_gated(reason),
            _ => outcome,
        }
    }

    /// Completes the outcome with the judgement of a case.
    #[must_use]
    pub fn judged(self, judgement: CaseJudgement) -> Self {
        let CaseJudgement { verdict, reason, unmet, exemption, study } = judgement;
        let outcome = Self {
            verdict,
            reason,
            unmet,
            study: Some(StudyResults::Convergence(Arc::new(study))),
            ..self
        };
        match exemption {
            Some(reason) => outcome.not_gated(&reason),
            None => outcome,
        }
    }

    /// Converts the outcome to that of a case that the solver's author excludes from `run --gate`.
    #[must_use]
    pub fn excepted(self, reason: String) -> Self {
        let (verdict, exemption) = ("not run".to_owned(), Some(Exemption::Excepted));
        Self { verdict, reason, exemption, expected: None, ..self }
    }

    /// Returns the expectation and its reason in one line.
    pub fn expectation(&self) -> String {
        match &self.expected {
            _ if self.exemption.is_some() => format!("nothing: {}", self.reason),
            Some(expected) => format!("{expected}; reason: {}", self.because),
            None => "nothing: neither the suite nor a gate has an expectation for it".to_owned(),
        }
    }

    /// Returns the convergence study; `None` for other kinds of study.
    pub fn convergence(&self) -> Option<&Convergence> {
        let StudyResults::Convergence(study) = self.study.as_ref()? else { return None };
        Some(study)
    }

    /// Returns the internal-force study; `None` for other kinds of study.
    pub fn internal_force(&self) -> Option<&InternalForce> {
        let StudyResults::InternalForce(study) = self.study.as_ref()? else { return None };
        Some(study)
    }

    /// Returns the stability study; `None` for other kinds of study.
    pub fn stability(&self) -> Option<&StabilityStudy> {
        let StudyResults::Stability(study) = self.study.as_ref()? else { return None };
        Some(study)
    }

    /// Returns the gradient study; `None` for other kinds of study.
    pub fn gradient(&self) -> Option<&GradientStudy> {
        let StudyResults::Gradient(study) = self.study.as_ref()? else { return None };
        Some(study)
    }

    /// Returns the spectrum study; `None` for other kinds of study.
    pub fn spectrum(&self) -> Option<&SpectrumStudy> {
        let StudyResults::Spectrum(study) = self.study.as_ref()? else { return None };
        Some(study)
    }
}
