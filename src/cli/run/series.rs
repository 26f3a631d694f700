//! Files of `run --vtu`.

use crate::cli::output;
use crate::cli::terminal::progress::RunProgress;
use mpm_verify::study::{Runner, SeriesFile};
use mpm_verify::verify::{CaseOutcome, SuiteOutcome};
use std::path::{Path, PathBuf};
use std::{fs, io};

/// Cases that are shown, and where.
pub(super) struct Series {
    folder: PathBuf,
    /// Whether all cases of the run are shown, and not only those that are not as expected.
    all: bool,
}

impl Series {
    /// Makes the folder, before hours are spent on what cannot be written.
    pub(super) fn prepare(folder: &Path, all: bool) -> Result<Self, String> {
        let folder = folder.to_owned();
        fs::create_dir_all(&folder).map_err(|error| unwritable(&folder, &error))?;
        Ok(Self { folder, all })
    }

    /// Writes the time series of the cases of a suite that are shown, and says where they are.
    pub(super) fn write(
        &self,
        runner: &Runner<'_>,
        outcome: &SuiteOutcome,
        bar: &RunProgress,
    ) -> Result<(), String> {
        let is_shown = |case: &&CaseOutcome| self.all || !case.passed();
        for case in outcome.cases.iter().filter(is_shown) {
            let mut failure = None;
            let mut last = String::new();
            let found = runner.time_series(case, &mut |file| {
                let path = self.folder.join(&file.path);
                last.clone_from(&file.path);
                save(&path, &file).map_err(|error| {
                    failure = Some(unwritable(&path, &error));
                    String::new()
                })
            });
            if let Some(message) = failure {
                return Err(message);
            }
            let name = format!("{}::{}", outcome.suite, case.case);
            let note = match found {
                Ok(()) => format!("note: {name}: {}", self.folder.join(&last).display()),
                Err(why) => format!("note: {name}: nothing to show: {why}"),
            };
            bar.suspend(|| output::complain(&note));
        }
        Ok(())
    }
}

fn save(path: &Path, file: &SeriesFile) -> io::Result<()> {
    path.parent().map_or(Ok(()), fs::create_dir_all)?;
    fs::write(path, &file.bytes)
}

fn unwritable(path: &Path, error: &io::Error) -> String {
    format!("error: --vtu {}: {error}", path.display())
}
