//! Reports as JUnit XML, for continuous integration services.

use crate::report::suite::text;
use crate::verify::{CaseOutcome, SuiteOutcome};
use chrono::{DateTime, Utc};
use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};
use std::collections::BTreeSet;
use std::time::{Duration, SystemTime};

/// Wall-clock times of a run.
#[derive(Debug, Clone)]
pub struct RunTimes {
    /// Start of the run.
    pub start: SystemTime,
    /// Duration of the run.
    pub whole: Duration,
    /// Duration of each suite. Suites run at the same time, so the sum can exceed `whole`.
    pub suites: Vec<Duration>,
}

/// Converts reports to JUnit XML, with a test suite for each suite and a test case for each case.
///
/// A case that is not applicable or that `run --gate` exempts is skipped with its reason, or fails
/// if its suite is in `required`, as with `run --gate`. The text of a failure is the report of the
/// case. Equal results give equal documents except for `times`, the durations of `outcomes`.
///
/// # Panics
/// Never, because writing to memory does not fail.
pub fn junit(outcomes: &[SuiteOutcome], required: &BTreeSet<String>, times: &RunTimes) -> String {
    let start = DateTime::<Utc>::from(times.start);
    let mut report = Report::new("mpm-verify");
    report.set_timestamp(start).set_time(times.whole);
    for (k, outcome) in outcomes.iter().enumerate() {
        let mut suite = TestSuite::new(outcome.suite.as_str());
        suite.set_timestamp(start).set_time(times.suites.get(k).copied().unwrap_or_default());
        let is_required = required.contains(&outcome.suite);
        for case in &outcome.cases {
            let mut test = TestCase::new(case.case.as_str(), status(case, is_required));
            test.set_classname(outcome.suite.as_str());
            suite.add_test_case(test);
        }
        report.add_test_suite(suite);
    }
    let text = report.to_string().expect("memory is written to");
    // XML 1.0 forbids these two characters. Control characters are already removed.
    text.replace(['\u{fffe}', '\u{ffff}'], "\u{fffd}")
}

fn status(case: &CaseOutcome, is_required: bool) -> TestCaseStatus {
    let failure = |message: &str| {
        let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
        status
            .set_message(message)
            .set_type(case.verdict.as_str())
            .set_description(text::case(case));
        status
    };
    if !case.is_tested() {
        if is_required {
            return failure(&case.reason);
        }
        let mut status = TestCaseStatus::skipped();
        status.set_message(case.reason.as_str());
        return status;
    }
    if case.passed() { TestCaseStatus::success() } else { failure(&case.failure()) }
}
