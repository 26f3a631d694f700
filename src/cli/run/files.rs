//! Writes the files of a run: `--out`, `--html` and `--vtu`.

use super::args::ReportArgs;
use super::printing::labelled;
use crate::cli::output::{CommandError, complain};
use chrono::{DateTime, Utc};
use mpm_verify::report::{self, RunTimes, page};
use mpm_verify::study::{Runner, SeriesError, SeriesFile};
use mpm_verify::suite::yaml::Source;
use mpm_verify::verify::{CaseOutcome, SuiteOutcome};
use std::collections::BTreeSet;
use std::env::consts::{ARCH, OS};
use std::fmt::Display;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::SystemTime;
use std::{fs, io};

/// Creates the folder of `--out` before the run, so an invalid path fails early.
pub(super) fn prepare_out(folder: &Path) -> Result<(), CommandError> {
    fs::create_dir_all(folder).map_err(|error| unwritable("--out", folder, &error))
}

/// Writes the files of each suite, and `report.json` and `report.csv` for all suites.
pub(super) fn write_out(
    folder: &Path,
    args: &ReportArgs,
    outcomes: &[SuiteOutcome],
) -> Result<(), CommandError> {
    let save = |file: &str, text: &str| -> io::Result<()> { fs::write(folder.join(file), text) };
    let every_file = || -> io::Result<()> {
        save("report.json", &report::json(outcomes))?;
        save("report.csv", &report::csv(outcomes))?;
        for outcome in outcomes {
            save(&format!("{}.txt", outcome.suite), &report::text(outcome))?;
        }
        for outcome in &labelled(args, outcomes) {
            let tables = report::latex(std::slice::from_ref(outcome));
            save(&format!("{}-table.tex", outcome.suite), &tables)?;
            for figure in report::svg(outcome) {
                save(&figure.file, &figure.svg)?;
                save(&figure.pgfplots_file(), &figure.pgfplots)?;
            }
        }
        Ok(())
    };
    every_file().map_err(|error| unwritable("--out", folder, &error))
}

/// Creates the folder for the file of `option` before the run, so an invalid path fails early.
pub(super) fn prepare_file(option: &str, file: &Path) -> Result<(), CommandError> {
    if file.is_dir() {
        return Err(unwritable(option, file, &"this is a folder"));
    }
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty());
    let made = folder.map_or(Ok(()), fs::create_dir_all);
    made.map_err(|error| unwritable(option, file, &error))
}

/// Writes the results as JUnit XML. An untested case of a suite in `required` counts as failed.
pub(super) fn write_junit(
    file: &Path,
    outcomes: &[SuiteOutcome],
    required: &BTreeSet<String>,
    times: &RunTimes,
) -> Result<(), CommandError> {
    let text = report::junit(outcomes, required, times);
    fs::write(file, text).map_err(|error| unwritable("--junit", file, &error))
}

/// Writes the HTML page. `outcomes` has the order of `sources`, without refused and skipped suites.
pub(super) fn write_page(
    file: &Path,
    sources: &[Source],
    outcomes: &[SuiteOutcome],
    refused: usize,
    start: SystemTime,
) -> Result<(), CommandError> {
    let named = |source: &Source| {
        let name = Path::new(source.name()).file_name();
        name.map_or_else(String::new, |name| name.to_string_lossy().into_owned())
    };
    let names: Vec<String> = sources.iter().map(named).collect();
    let parts = sources.iter().zip(&names).zip(outcomes);
    let parts: Vec<page::SuiteSource<'_>> = parts
        .map(|((source, file), outcome)| page::SuiteSource { outcome, file, yaml: source.text() })
        .collect();
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let run = page::RunFacts {
        refused,
        date: date(start),
        machine: format!("{OS}, {ARCH}, {}", report::counted(cores, "core")),
    };
    fs::write(file, page::page(&parts, &run)).map_err(|error| unwritable("--html", file, &error))
}

fn date(start: SystemTime) -> String {
    DateTime::<Utc>::from(start).format("%Y-%m-%d %H:%M UTC").to_string()
}

pub(super) struct Series {
    folder: PathBuf,
    /// Whether all cases are written, or only those that fail.
    all: bool,
    is_used: AtomicBool,
    /// First file that could not be written. No further cases are written then.
    failure: OnceLock<CommandError>,
}

impl Series {
    /// Creates the folder before the run, so an invalid path fails early.
    pub(super) fn prepare(folder: &Path, all: bool) -> Result<Self, CommandError> {
        let folder = folder.to_owned();
        fs::create_dir_all(&folder).map_err(|error| unwritable("--vtu", &folder, &error))?;
        Ok(Self { folder, all, is_used: AtomicBool::new(false), failure: OnceLock::new() })
    }

    pub(super) fn write(&self, runner: &Runner<'_>, outcome: &SuiteOutcome, say: &dyn Fn(String)) {
        let is_shown = |case: &&CaseOutcome| self.all || !case.passed();
        for case in outcome.cases.iter().filter(is_shown) {
            self.is_used.store(true, Ordering::Relaxed);
            if self.failure.get().is_some() {
                return;
            }
            let mut last = self.folder.clone();
            let result = runner.time_series(case, &mut |file| {
                last = self.folder.join(&file.path);
                save(&last, file)
            });
            let name = format!("{}::{}", outcome.suite, case.case);
            match result {
                Ok(()) => say(format!("wrote {}", last.display())),
                Err(SeriesError::Write { path, error }) => {
                    let error = unwritable("--vtu", &self.folder.join(path), &error);
                    self.failure.get_or_init(|| error);
                }
                Err(reason) => say(format!("note: {name}: no output: {reason}")),
            }
        }
    }

    /// Returns the first failure, if any. A note explains why nothing was written.
    pub(super) fn failure(self) -> Option<CommandError> {
        if !self.is_used.load(Ordering::Relaxed) {
            complain("note: --vtu: no case fails, so nothing was written; `--case` selects cases");
        }
        self.failure.into_inner()
    }
}

fn save(path: &Path, file: &SeriesFile) -> io::Result<()> {
    path.parent().map_or(Ok(()), fs::create_dir_all)?;
    fs::write(path, &file.bytes)
}

fn unwritable(option: &str, path: &Path, error: &impl Display) -> CommandError {
    CommandError::option(option, path.display(), error)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::{Duration, UNIX_EPOCH};

    #[test]
    fn date_has_the_minute_of_the_start() {
        let start = UNIX_EPOCH + Duration::from_secs(86_400 * 31 + 14 * 3600 + 11 * 60);
        assert_eq!(date(start), "1970-02-01 14:11 UTC");
    }
}
