//! Cases that failed in the last run, for `run --last-failed`.

use crate::cli::output::CommandError;
use crate::cli::suite_runs::SuiteRuns;
use mpm_verify::verify::SuiteOutcome;
use std::path::Path;
use std::{fs, io};

/// Folder of the list, in the current folder.
const FOLDER: &str = ".mpm-verify";

/// Selects the cases that failed in the last run. Fails if there are none among `runs`.
pub(super) fn select(runs: Vec<SuiteRuns>) -> Result<Vec<SuiteRuns>, CommandError> {
    let list = fs::read_to_string(Path::new(FOLDER).join("last-failed"));
    let list = list.map_err(|_| {
        CommandError::about("--last-failed", "no case of the last run in this folder failed")
    })?;
    let only = |runs: SuiteRuns| {
        let suite = runs.suite().name.clone();
        runs.only(|case| is_listed(&list, &suite, case))
    };
    let chosen: Vec<SuiteRuns> = runs.into_iter().filter_map(only).collect();
    if chosen.is_empty() {
        let reason = "the cases that failed last are not among these suites";
        return Err(CommandError::about("--last-failed", reason));
    }
    Ok(chosen)
}

/// Records the failed cases. Without failed cases, the list is removed.
pub(super) fn record(outcomes: &[SuiteOutcome]) -> io::Result<()> {
    let failed = outcomes.iter().flat_map(|outcome| {
        let failed = outcome.cases.iter().filter(|case| !case.passed());
        failed.map(|case| key(&outcome.suite, &case.case) + "\n")
    });
    let (failed, folder): (String, _) = (failed.collect(), Path::new(FOLDER));
    if failed.is_empty() {
        return match fs::remove_file(folder.join("last-failed")) {
            Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
            _ => Ok(()),
        };
    }
    fs::create_dir_all(folder)?;
    fs::write(folder.join(".gitignore"), "*\n")?;
    fs::write(folder.join("last-failed"), failed)
}

fn is_listed(list: &str, suite: &str, case: &str) -> bool {
    list.lines().any(|line| line == key(suite, case))
}

fn key(suite: &str, case: &str) -> String {
    format!("{suite}::{case}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_whole_names_of_failed_cases_are_listed() {
        let list = "bar::flip-usl\nbar::flip-musl\n";
        assert!(is_listed(list, "bar", "flip-musl"));
        for (suite, case) in [("bar", "flip"), ("bar", "usl"), ("a-bar", "flip-usl"), ("ba", "")] {
            assert!(!is_listed(list, suite, case), "{suite}::{case}");
        }
    }
}
