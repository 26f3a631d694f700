//! The results of a suite: the input of all reports.

use super::case::CaseJudgement;
use super::convergence::Convergence;
use super::study_results::StudyResults;
use crate::subject::Profile;
use std::any::Any;
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
    /// Reference for the problem.
    pub source: String,
    /// Introduction by the author.
    pub about: String,
    /// The problem as rows of name and value: parameters, scene, exact solution, dt rule.
    pub statement: Vec<(String, String)>,
    /// Fingerprint of the meaning of the statement, independent of its notation.
    pub meaning: u64,
    /// One outcome for each case, in the order of the suite.
    pub cases: Vec<CaseOutcome>,
}

impl SuiteOutcome {
    /// Appends the cases of `other`, a run of the same suite with another solver, to those of
    /// `joined`.
    pub fn join(joined: &mut Option<Self>, other: Self) {
        match joined {
            None => *joined = Some(other),
            Some(joined) => joined.cases.extend(other.cases),
        }
    }
}

/// Result of one case.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct CaseOutcome {
    /// Name of the case, unique in its suite.
    pub case: String,
    /// Which subject: `mpm` or `fem`.
    pub subject: &'static str,
    /// Settings of the method: basis, transfer, mass matrix, start, kind of reference.
    pub settings: Vec<(String, String)>,
    /// Cost of a step on the coarsest level, from a subject that has a profile.
    pub profile: Option<Profile>,
    /// Expectation, in one line; `None` for an exploring suite, which is not a gate.
    pub expected: Option<String>,
    /// The reason for the expectation in the suite; empty if nothing is expected.
    pub because: String,
    /// The verdict, as text.
    pub verdict: String,
    /// The figures that led to the verdict.
    pub reason: String,
    /// Expectations that are not met; empty if the case passed.
    pub unmet: Vec<String>,
    /// Missing capabilities of the solver; empty if the case applies.
    pub lacks: Vec<String>,
    /// Why `run --gate` requires nothing of the case; `None` if it does.
    pub exemption: Option<Exemption>,
    /// Results of its kind of study; absent if the case could not be set up, for the reason in
    /// `reason`.
    pub study: Option<Arc<dyn StudyResults>>,
}

/// Why `run --gate` requires nothing of a case; the explanation is in [`CaseOutcome::reason`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Exemption {
    /// The suite cannot test the requirement.
    NotGated,
    /// The author of the solver excepts the case, which has not run.
    Excepted,
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
    /// A case that has not run, without an expectation.
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

    /// Whether all expectations are met.
    pub fn passed(&self) -> bool {
        self.unmet.is_empty()
    }

    /// Whether the case has been tested, and is neither out of the solver's reach nor exempt from
    /// the gate.
    pub fn is_tested(&self) -> bool {
        self.lacks.is_empty() && self.exemption.is_none()
    }

    /// The setting of its method with this name.
    pub fn setting(&self, name: &str) -> Option<&str> {
        self.settings.iter().find(|(known, _)| known == name).map(|(_, value)| value.as_str())
    }

    /// Whether the method fails at the problem, be that expected of it or not.
    pub fn fails(&self) -> bool {
        self.study.as_deref().is_some_and(StudyResults::fails)
    }

    /// Every value of [`CaseOutcome::result`].
    pub const RESULTS: [&'static str; 6] =
        ["pass", "FAIL", "explored", "n/a", "not gated", "excepted"];

    /// The result in a word: `pass`, `FAIL`, `explored` if nothing is expected, `n/a` if the solver
    /// lacks a capability; under a gate also `not gated` and `excepted`.
    pub fn result(&self) -> &'static str {
        if !self.lacks.is_empty() {
            return "n/a";
        }
        match self.exemption {
            Some(Exemption::NotGated) => return "not gated",
            Some(Exemption::Excepted) => return "excepted",
            None => {}
        }
        match (self.passed(), &self.expected) {
            (false, _) => "FAIL",
            (true, Some(_)) => "pass",
            (true, None) => "explored",
        }
    }

    /// This outcome for a case that does not apply to its solver: the missing capabilities, with a
    /// verb.
    #[must_use]
    pub(crate) fn not_applicable(self, lacks: Vec<String>, verb: &str) -> Self {
        let verdict = "not applicable".to_owned();
        let reason = format!("the solver {verb} {}", lacks.join(", "));
        Self { verdict, reason, lacks, ..self }
    }

    /// This outcome for a case that the gate does not judge, for this reason.
    #[must_use]
    pub(crate) fn not_gated(self, reason: &str) -> Self {
        let reason = format!("{reason}; {}", self.reason);
        Self { reason, exemption: Some(Exemption::NotGated), ..self }
    }

    /// The outcome of a case whose levels have run.
    #[must_use]
    pub(crate) fn judged(self, judgement: CaseJudgement) -> Self {
        let CaseJudgement { verdict, reason, unmet, exemption, study } = judgement;
        let outcome = Self { verdict, reason, unmet, study: Some(Arc::new(study)), ..self };
        match exemption {
            Some(reason) => outcome.not_gated(&reason),
            None => outcome,
        }
    }

    /// The outcome of a case that its solver's author excepts from the gate.
    #[must_use]
    pub(crate) fn excepted(self, reason: String) -> Self {
        let (verdict, exemption) = ("not run".to_owned(), Some(Exemption::Excepted));
        Self { verdict, reason, exemption, expected: None, ..self }
    }

    /// The expectation and its reason, in one line.
    pub fn expectation(&self) -> String {
        match &self.expected {
            _ if self.exemption.is_some() => format!("nothing: {}", self.reason),
            Some(expected) => format!("{expected}; reason: {}", self.because),
            None => "nothing: neither the suite nor a gate has an expectation for it".to_owned(),
        }
    }

    /// The convergence study; `None` for other kinds of study.
    pub fn convergence(&self) -> Option<&Convergence> {
        self.results()
    }

    /// The results, if they are of this kind of study.
    pub fn results<R: StudyResults>(&self) -> Option<&R> {
        let results: &dyn Any = self.study.as_deref()?;
        results.downcast_ref()
    }
}
