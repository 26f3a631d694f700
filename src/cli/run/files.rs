//! Files of `run --out`.

use mpm_verify::report;
use mpm_verify::verify::SuiteOutcome;
use std::path::Path;
use std::{fs, io};

/// Makes the folder of `--out`, before hours are spent on what cannot be written.
pub(super) fn prepare(folder: &Path) -> Result<(), String> {
    fs::create_dir_all(folder).map_err(|error| unwritable(folder, &error))
}

/// Writes `NAME.txt` and the figures of each suite, and `report.json` for all.
pub(super) fn write(folder: &Path, outcomes: &[SuiteOutcome]) -> Result<(), String> {
    let save = |file: &str, text: &str| -> io::Result<()> { fs::write(folder.join(file), text) };
    let every_file = || -> io::Result<()> {
        save("report.json", &report::json(outcomes))?;
        for outcome in outcomes {
            save(&format!("{}.txt", outcome.suite), &report::text(outcome))?;
            for figure in report::svg(outcome) {
                save(&figure.file, &figure.svg)?;
            }
        }
        Ok(())
    };
    every_file().map_err(|error| unwritable(folder, &error))
}

fn unwritable(folder: &Path, error: &io::Error) -> String {
    format!("error: --out {}: {error}", folder.display())
}
