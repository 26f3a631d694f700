//! Ids of places on the page, and links to them.

use super::html::Html;
use crate::verify::{CaseOutcome, SuiteOutcome};

/// The id of a suite's section.
pub(super) fn id(outcome: &SuiteOutcome) -> String {
    format!("suite-{}", outcome.suite)
}

/// The id of a case's row in the section of its suite. Names of suites have no dot.
pub(super) fn case_id(outcome: &SuiteOutcome, case: &CaseOutcome) -> String {
    let plain = |c: char| if c.is_whitespace() { '_' } else { c };
    let name: String = case.case.chars().map(plain).collect();
    format!("case-{}.{name}", outcome.suite)
}

/// A link to the row of a case, with the suite's name or without.
pub(super) fn case_link(outcome: &SuiteOutcome, case: &CaseOutcome, full: bool) -> Html {
    let name = if full { format!("{}::{}", outcome.suite, case.case) } else { case.case.clone() };
    Html::tag("a", &[("href", &format!("#{}", case_id(outcome, case)))], name)
}
