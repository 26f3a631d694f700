//! Outcomes of cases that have not run, or not yet.

use super::statement;
use crate::study::describe::profiles;
use crate::suite::model::{Case, ConvergencePlan};
use crate::verify;
use crate::verify::{CaseOutcome, Expectation, Gating};

/// The part of an outcome that is known before the case runs.
pub(crate) fn described(
    plan: &ConvergencePlan,
    case: &Case,
    expectation: Option<&Expectation>,
) -> CaseOutcome {
    let expected = expectation
        .map(|expectation| (expectation.summary(), expectation.because.clone()))
        .or_else(|| match &case.gating {
            Some(Gating::Required(required)) => {
                Some((required.summary(), required.because.clone()))
            }
            _ => None,
        });
    let (expected, because) = expected.unzip();
    CaseOutcome {
        case: case.name.clone(),
        subject: case.method.subject(),
        settings: statement::settings(plan, case),
        profile: profiles::of(plan, case),
        expected,
        because: because.unwrap_or_default(),
        verdict: String::new(),
        reason: String::new(),
        unmet: Vec::new(),
        lacks: Vec::new(),
        exemption: None,
        study: None,
    }
}

/// The outcome of a case that its solver cannot be put to.
pub(crate) fn not_applicable(
    plan: &ConvergencePlan,
    case: &Case,
    lacks: Vec<String>,
    verb: &str,
) -> CaseOutcome {
    described(plan, case, None).not_applicable(lacks, verb)
}

/// The outcome of a case that could not be set up.
pub(crate) fn refused(
    plan: &ConvergencePlan,
    case: &Case,
    expectation: Option<&Expectation>,
    reason: String,
) -> CaseOutcome {
    CaseOutcome {
        verdict: verify::Verdict::Failed.to_string(),
        unmet: vec![format!("the case could not be run: {reason}")],
        reason,
        ..described(plan, case, expectation)
    }
}
