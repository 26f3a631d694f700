//! Finished levels of a long run, kept on disk: an interrupted run goes on where it was.
//!
//! What a level has shown is written as soon as it has ended, under a name made of all that it depends
//! on: the program itself, bit by bit, the text of the suite, the case and the level. So nothing that
//! was computed otherwise is ever taken for it, and a run that goes on prints what it would have printed
//! uninterrupted, byte by byte. A file is written whole or not at all: to another name first.

use super::yaml::{read_again, written};
use crate::verify::Run;
use std::{
    fmt::Display,
    fs, io,
    path::{Path, PathBuf},
    sync::{Mutex, PoisonError},
};

/// A folder of finished levels.
#[derive(Debug)]
pub struct Kept {
    folder: PathBuf,
    program: u64,
    complaint: Mutex<Option<String>>,
}

impl Kept {
    /// Uses a folder, and makes it if it is not there.
    ///
    /// # Errors
    /// If there can be no such folder, or the program cannot be read.
    pub fn open(folder: &Path) -> io::Result<Self> {
        fs::create_dir_all(folder)?;
        let program = fingerprint(&fs::read(std::env::current_exe()?)?);
        Ok(Self { folder: folder.to_owned(), program, complaint: Mutex::new(None) })
    }

    /// What a level has shown: from the folder, or else by running it. `key` says all that it depends
    /// on, besides the program.
    pub(super) fn level(
        &self,
        key: &str,
        run: impl FnOnce() -> Result<Run, String>,
    ) -> Result<Run, String> {
        let key = format!("{:016x} {key}", self.program);
        let path = self.folder.join(format!("{:016x}.level", fingerprint(key.as_bytes())));
        if let Some(found) = fs::read_to_string(&path).ok().and_then(|text| read(&text, &key)) {
            return Ok(found);
        }
        let found = run()?;
        if let Err(error) = self.save(&path, &key, &found) {
            let mut first = self.complaint.lock().unwrap_or_else(PoisonError::into_inner);
            first.get_or_insert(error);
        }
        Ok(found)
    }

    /// Why something could not be kept, if so.
    pub fn complaint(&self) -> Option<String> {
        self.complaint.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    fn save(&self, path: &Path, key: &str, run: &Run) -> Result<(), String> {
        let says = |error: &dyn Display| format!("{}: {error}", self.folder.display());
        let text = written(run).map_err(|error| says(&error))?;
        let unfinished = path.with_extension(format!("{}", std::process::id()));
        fs::write(&unfinished, format!("# {key}\n{text}"))
            .and_then(|()| fs::rename(&unfinished, path))
            .map_err(|error| says(&error))
    }
}

/// None if the text is of another level, or no level at all.
fn read(text: &str, key: &str) -> Option<Run> {
    let rest = text.strip_prefix("# ")?.strip_prefix(key)?.strip_prefix('\n')?;
    read_again(rest)
}

/// FNV-1a (Fowler, Noll & Vo), 64 bits.
pub(super) fn fingerprint(bytes: &[u8]) -> u64 {
    let next = |hash: u64, byte: &u8| (hash ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, next)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        subject::{Census, Totals},
        verify::{Drift, History, Interval, Norms},
    };
    use proptest::prelude::*;

    fn some(x: f64, failure: Option<String>) -> Run {
        let norms = Norms { rms: x, l1: -x, l2: 0.1 * x, linf: f64::NAN };
        let totals = Totals { kinetic_energy: x, strain_energy: Some(x), ..Totals::default() };
        Run {
            errors: norms,
            max_rms: x,
            at_end: Norms::NONE,
            largest: norms,
            drift: Some(Drift::NONE),
            account: vec![(0.0, totals), (x, Totals { strain_energy: None, ..totals })],
            energy_rate: Some(Interval { value: x, low: -x, high: f64::INFINITY }),
            census: Census {
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
            unrest: Some(x),
        }
    }

    /// As text, NaN is itself and -0 is not 0.
    fn shown(run: &Run) -> String {
        format!("{run:?}")
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(200) })]

        #[test]
        fn what_is_kept_is_what_was_there(x in prop::num::f64::ANY, why in "\\PC{0,20}") {
            let run = some(x, Some(why));
            let text = format!("# key\n{}", written(&run).unwrap());
            prop_assert_eq!(shown(&read(&text, "key").unwrap()), shown(&run));
        }
    }

    #[test]
    fn what_is_torn_or_of_another_level_is_not_taken() {
        let text = format!("# key\n{}", written(&some(1.5, None)).unwrap());
        assert!(read(&text, "key").is_some());
        assert!(read(&text, "another").is_none());
        assert!(read(&text[..text.len() / 2], "key").is_none());
        assert!(read("", "key").is_none());
    }
}
