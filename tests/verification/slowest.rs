//! Where the time of the gate goes: printed, and part of no verdict.

use std::{
    sync::{Mutex, PoisonError},
    time::Duration,
};

static CASES: Mutex<Vec<(Duration, String)>> = Mutex::new(Vec::new());

/// As many as are worth a look.
const SHOWN: usize = 10;

/// Remembers how long a case took.
pub(crate) fn record(time: Duration, case: &str) {
    CASES.lock().unwrap_or_else(PoisonError::into_inner).push((time, case.to_string()));
}

/// The slowest cases and the time of all, if there are enough of them to ask.
pub(crate) fn summary() -> String {
    let mut cases = CASES.lock().unwrap_or_else(PoisonError::into_inner).clone();
    if cases.len() <= SHOWN {
        return String::new();
    }
    let all: Duration = cases.iter().map(|(time, _)| *time).sum();
    cases.sort_by(|a, b| b.cmp(a));
    let mut text = format!(
        "{} cases took {:.1} s of threads' time; the slowest:\n",
        cases.len(),
        all.as_secs_f64()
    );
    for (time, case) in cases.iter().take(SHOWN) {
        text += &format!("{:>8.2} s  {case}\n", time.as_secs_f64());
    }
    text + "\n"
}
