//! Stores the results of finished levels on disk, so that an interrupted run can continue with the
//! remaining levels.
//!
//! The result of a level is written as soon as the level ends. The file name contains a hash of all
//! inputs: the program, the suite text, the case and the level. A resumed run prints the same bytes
//! as an uninterrupted one. Files are written atomically, by renaming.

use crate::subject::SubjectError;
use crate::suite::model::fingerprint::fingerprint;
use crate::suite::yaml::{read_again, written};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// Last line of a complete file. Without this line, a truncated file could appear valid, because
/// the last keys are optional.
const END: &str = "# end\n";

/// A folder that stores the results of finished levels.
#[derive(Debug)]
pub struct ResultCache {
    folder: PathBuf,
    /// Additional folders, which are only read. If there are any, no level runs.
    others: Vec<PathBuf>,
    program: u64,
    /// First error that occurred when a result was written.
    first_error: OnceLock<io::Error>,
}

impl ResultCache {
    /// Opens a folder, and creates it if it does not exist.
    ///
    /// # Errors
    /// If the folder cannot be created, or the program file cannot be read.
    pub fn open(folder: &Path) -> io::Result<Self> {
        fs::create_dir_all(folder)?;
        let program = fingerprint(&fs::read(std::env::current_exe()?)?);
        let (folder, others) = (folder.to_owned(), Vec::new());
        Ok(Self { folder, others, program, first_error: OnceLock::new() })
    }

    /// Reads finished levels from `folders` without running any level.
    ///
    /// # Errors
    /// If an entry is not a folder, or the program file cannot be read.
    pub fn of_parts(folders: &[PathBuf]) -> Result<Self, (PathBuf, io::Error)> {
        let readable = |folder: &PathBuf| fs::read_dir(folder).map(drop);
        for folder in folders {
            readable(folder).map_err(|error| (folder.clone(), error))?;
        }
        let first = folders.first().cloned().unwrap_or_default();
        let cache = Self::open(&first).map_err(|error| (first, error))?;
        Ok(Self { others: folders.to_vec(), ..cache })
    }

    /// Returns the result of a level: the stored one, or else the one from `run`. `key` contains
    /// all inputs of the result except the program. `name` is the name of the level in messages.
    pub(crate) fn level<T: Serialize + DeserializeOwned>(
        &self,
        key: &str,
        name: &str,
        run: impl FnOnce() -> Result<T, SubjectError>,
    ) -> Result<T, SubjectError> {
        let key = format!("{:016x} {key}", self.program);
        let file = format!("{:016x}.level", fingerprint(key.as_bytes()));
        if !self.others.is_empty() {
            let texts = self.others.iter().map(|folder| fs::read_to_string(folder.join(&file)));
            let found = texts.flatten().find_map(|text| read(&text, &key));
            return found.ok_or_else(|| format!("no folder has the result of {name}").into());
        }
        let path = self.folder.join(file);
        if let Some(known) = fs::read_to_string(&path).ok().and_then(|text| read(&text, &key)) {
            return Ok(known);
        }
        let result = run()?;
        if let Err(error) = save(&path, &key, &result) {
            self.first_error.get_or_init(|| error);
        }
        Ok(result)
    }

    /// Returns the first error that occurred when a result was written, as text.
    pub fn diagnostic(&self) -> Option<String> {
        Some(format!("{}: {}", self.folder.display(), self.first_error.get()?))
    }
}

fn save(path: &Path, key: &str, level: &impl Serialize) -> io::Result<()> {
    let unfinished = path.with_extension(format!("{}", std::process::id()));
    write_whole(path, &unfinished, text(key, level)?.as_bytes())
}

fn text(key: &str, level: &impl Serialize) -> io::Result<String> {
    Ok(format!("# {key}\n{}{END}", written(level).map_err(io::Error::other)?))
}

/// Writes a file that is complete or absent, even if the machine stops, by renaming `unfinished`.
fn write_whole(path: &Path, unfinished: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = File::create(unfinished)?;
    file.write_all(bytes)?;
    file.sync_data()?;
    fs::rename(unfinished, path)
}

/// Parses a result; `None` if the text belongs to another level, or is incomplete or invalid.
fn read<T: DeserializeOwned>(text: &str, key: &str) -> Option<T> {
    let rest = text.strip_prefix("# ")?.strip_prefix(key)?.strip_prefix('\n')?;
    read_again(rest.strip_suffix(END)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::subject::RunCounters;
    use crate::verify::{ConservationError, History, Interval, Norms, RunErrors, RunResult};
    use proptest::prelude::*;

    fn some(x: f64, failure: Option<String>) -> RunResult {
        let norms = Norms { rms: x, l1: -x, l2: 0.1 * x, linf: f64::NAN, mass_l2: Some(x) };
        let errors = RunErrors { at_end: Norms::NONE, largest: norms };
        RunResult {
            errors,
            displacement_errors: Some(RunErrors { at_end: norms, ..errors }),
            drift: Some(ConservationError::NONE),
            energy_rate: Some(Interval { value: x, low: -x, high: f64::INFINITY }),
            counters: RunCounters {
                particles: Some(7),
                transfers: u64::MAX,
                crossings: None,
                left_domain: None,
                min_j: x,
            },
            steps: 3,
            failure,
            history: Some(History { label: vec![x], velocity: vec![[x, -0.0, 1e-320]] }),
            displacement: Some(vec![x, 0.1 + 0.2]),
            observed_error: None,
            observed_exact: Some(vec![-x, 0.3]),
            residual_speed: Some(x),
        }
    }

    /// Formats a result such that NaN equals NaN, and -0 differs from 0.
    fn shown(run: &RunResult) -> String {
        format!("{run:?}")
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(200) })]

        #[test]
        fn stored_result_is_read_back_bit_for_bit(x in prop::num::f64::ANY, why in "\\PC{0,20}") {
            let run = some(x, Some(why));
            let text = text("key", &run).unwrap();
            prop_assert_eq!(shown(&read::<RunResult>(&text, "key").unwrap()), shown(&run));
        }
    }

    /// A stored result is read only by the program that wrote it.
    #[test]
    fn result_of_another_program_is_not_read() {
        let folder = std::env::temp_dir().join(format!("mpm-verify-cache-{}", std::process::id()));
        let mut cache = ResultCache::open(&folder).expect("a folder");
        let mut read = |program: u64, value: f64| {
            cache.program = program;
            cache.level("key", "level 1", || Ok(value)).expect("a result")
        };
        assert_eq!(
            [read(1, 0.25), read(2, 0.5), read(1, 4.0), read(2, 8.0)],
            [0.25, 0.5, 0.25, 0.5]
        );
        fs::remove_dir_all(folder).expect("a folder");
    }

    #[test]
    fn truncated_results_and_other_keys_are_ignored() {
        let text = text("key", &some(1.5, None)).unwrap();
        assert!(read::<RunResult>(&text, "key").is_some());
        assert!(read::<RunResult>(&text, "another").is_none());
        for length in 0..text.len() {
            assert!(read::<RunResult>(&text[..length], "key").is_none(), "{length} bytes");
        }
    }
}
