//! Shows the progress of a run on standard error if it is a terminal: the number of finished
//! levels, and the remaining time that the cost model predicts.

use crate::cli::output;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use mpm_verify::study::{Runner, unit_seconds};
use mpm_verify::suite::{Extent, Suite};
use std::borrow::Cow;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Instant;

const INTERRUPTED: i32 = 130;

/// Fraction of the total predicted time that must have finished before the remaining time is shown.
const ENOUGH: f64 = 0.02;

pub(super) struct RunProgress {
    bar: ProgressBar,
    state: Mutex<ProgressState>,
}

struct ProgressState {
    suite: String,
    /// Predicted time (s) of the finished levels.
    done: f64,
    all: f64,
    start: Instant,
}

pub(super) struct SuiteProgress<'a> {
    of_run: &'a RunProgress,
    /// Predicted times (s) of the remaining levels, in decreasing order.
    units: Mutex<Vec<f64>>,
}

impl RunProgress {
    /// Creates a progress bar for all levels of `suites`. It is hidden in quiet mode.
    pub(super) fn over<'a>(
        suites: impl Iterator<Item = &'a Suite> + Clone,
        extent: Extent,
        quiet: bool,
    ) -> Self {
        let levels = suites.clone().map(|suite| Runner::over(suite, extent).units()).sum();
        let target =
            if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr() };
        let bar = ProgressBar::with_draw_target(Some(levels), target);
        if let Ok(style) = ProgressStyle::with_template("{bar:30} {pos}/{len} levels  {msg}") {
            bar.set_style(style);
        }
        let all = suites.flat_map(|suite| unit_seconds(suite, extent)).sum();
        let state = ProgressState { suite: String::new(), done: 0.0, all, start: Instant::now() };
        Self { bar, state: Mutex::new(state) }
    }

    pub(super) fn start(&self, suite: &Suite, extent: Extent) -> SuiteProgress<'_> {
        // Cases run in parallel from coarse to fine, so the cheapest levels finish first.
        let mut units = unit_seconds(suite, extent);
        units.sort_by(|a, b| b.total_cmp(a));
        let mut state = self.state();
        suite.name.clone_into(&mut state.suite);
        self.bar.set_message(state.message());
        SuiteProgress { of_run: self, units: Mutex::new(units) }
    }

    pub(super) fn suspend(&self, print: impl FnOnce()) {
        self.bar.suspend(print);
    }

    pub(super) fn clear(&self) {
        self.bar.finish_and_clear();
    }

    /// Makes Ctrl-C print `note` before the program ends, if a handler can be set.
    pub(super) fn note_at_interrupt(&self, note: String) {
        let bar = self.bar.clone();
        let _ = ctrlc::set_handler(move || {
            bar.suspend(|| output::complain(&note));
            std::process::exit(INTERRUPTED);
        });
    }

    fn state(&self) -> MutexGuard<'_, ProgressState> {
        locked(&self.state)
    }
}

impl SuiteProgress<'_> {
    pub(super) fn inc(&self) {
        let seconds = locked(&self.units).pop().unwrap_or_default();
        let mut state = self.of_run.state();
        state.done += seconds;
        self.of_run.bar.set_message(state.message());
        self.of_run.bar.inc(1);
    }
}

/// Levels that were not counted, for instance after a failure, count as finished.
impl Drop for SuiteProgress<'_> {
    fn drop(&mut self) {
        let rest: f64 = locked(&self.units).iter().sum();
        self.of_run.state().done += rest;
    }
}

fn locked<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl ProgressState {
    fn message(&self) -> String {
        let left = time_left(self.start.elapsed().as_secs_f64(), self.done, self.all);
        left.map_or_else(|| self.suite.clone(), |left| format!("{}, {left} left", self.suite))
    }
}

/// Estimates the remaining time after `seconds`, from the predicted times (s) of the finished
/// levels (`done`) and of all levels (`all`). `None` while the estimate is unreliable.
fn time_left(seconds: f64, done: f64, all: f64) -> Option<String> {
    if !(done > ENOUGH * all && seconds > 1.0) {
        return None;
    }
    let left = seconds * (all - done).max(0.0) / done;
    Some(match left {
        0.0..100.0 => format!("about {left:.0} s"),
        100.0..6000.0 => format!("about {:.0} min", left / 60.0),
        _ => format!("about {:.0} h", left / 3600.0),
    })
}

/// Describes how to resume the interrupted run. `kept` is true if finished levels are stored.
pub(super) fn interrupt_note(kept: bool) -> String {
    let words = std::env::args_os().skip(1).map(|word| word.to_string_lossy().into_owned());
    let words: Vec<String> = words.collect();
    note_of(&words, kept)
}

fn note_of(words: &[String], kept: bool) -> String {
    let quoted = |word| shlex::try_quote(word).unwrap_or(Cow::Borrowed(word));
    let mut words: Vec<Cow<'_, str>> = words.iter().map(|word| quoted(word)).collect();
    if words.first().is_none_or(|word| word != "run") {
        words.insert(0, "run".into());
    }
    let line = words.join(" ");
    if kept {
        format!("interrupted: `mpm-verify {line}` resumes the run")
    } else {
        format!(
            "interrupted, and no results are stored: with a folder for results, `mpm-verify {line} \
             --resume kept`, an interrupted run can be resumed"
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[rstest]
    #[case::too_early_to_tell((10.0, 1.0, 100.0), None)]
    #[case::too_short_to_tell((0.5, 50.0, 100.0), None)]
    #[case::nothing_predicted((10.0, 0.0, 0.0), None)]
    #[case((10.0, 50.0, 100.0), Some("about 10 s"))]
    #[case::machine_twice_as_slow((40.0, 20.0, 100.0), Some("about 3 min"))]
    #[case((3600.0, 10.0, 100.0), Some("about 9 h"))]
    #[case::longer_than_predicted((10.0, 100.0, 99.0), Some("about 0 s"))]
    fn remaining_time_is_predicted_time_at_the_measured_speed(
        #[case] (seconds, done, all): (f64, f64, f64),
        #[case] wanted: Option<&str>,
    ) {
        assert_eq!(time_left(seconds, done, all).as_deref(), wanted);
    }

    #[rstest]
    #[case(
        &["run", "heat", "--resume", "a b"],
        true,
        "`mpm-verify run heat --resume 'a b'` resumes the run"
    )]
    #[case(&["run", "--full", "mms-*"], false, "`mpm-verify run --full 'mms-*' --resume kept`")]
    #[case(&[], false, "`mpm-verify run --resume kept`")]
    fn note_contains_the_command_to_resume(
        #[case] words: &[&str],
        #[case] kept: bool,
        #[case] wanted: &str,
    ) {
        let words: Vec<String> = words.iter().map(ToString::to_string).collect();
        let note = note_of(&words, kept);
        assert!(note.contains(wanted), "{note}");
    }
}
