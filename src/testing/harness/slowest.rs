//! Where the time of the gate goes: printed, and part of no verdict.

use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};
use std::time::Duration;

static CASES: Mutex<Vec<(Duration, String)>> = Mutex::new(Vec::new());

/// As many as are worth a look.
const SHOWN: usize = 10;

/// Remembers how long a case took.
pub(super) fn record(time: Duration, case: &str) {
    CASES.lock().unwrap_or_else(PoisonError::into_inner).push((time, case.to_string()));
}

/// The slowest cases and suites, if there are enough of them to ask.
pub(super) fn summary() -> String {
    let mut cases = CASES.lock().unwrap_or_else(PoisonError::into_inner).clone();
    if cases.len() <= SHOWN {
        return String::new();
    }
    cases.sort_by(|a, b| b.cmp(a));
    let mut text = format!(
        "the slowest of {} cases, with the time that they waited for each other \
         (`--test-threads 1`: without)\n",
        cases.len()
    );
    let line = |time: &Duration, name: &str| format!("{:>8.2} s  {name}\n", time.as_secs_f64());
    text.extend(cases.iter().take(SHOWN).map(|(time, case)| line(time, case)));
    let mut suites = BTreeMap::<&str, Duration>::new();
    for (time, case) in &cases {
        *suites.entry(case.split("::").next().unwrap_or(case)).or_default() += *time;
    }
    let mut suites: Vec<_> = suites.into_iter().collect();
    suites.sort_by_key(|(_, time)| Reverse(*time));
    text += "of suites:\n";
    text.extend(suites.iter().take(SHOWN).map(|(suite, time)| line(time, suite)));
    text + "\n"
}
