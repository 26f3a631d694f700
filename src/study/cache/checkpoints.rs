//! State of a level in the middle of its run, in a file from which an interrupted level goes on.
//!
//! The file begins with the key of the level, which names all that its bits depend on, and ends
//! with a fingerprint of all before. A file of another level, or a torn one, is rejected, and the
//! level starts anew. The file is written under another name first, and removed when the level has
//! ended.

use super::log::CacheLog;
use super::write_whole;
use crate::suite::model::fingerprint::fingerprint;
use crate::verify::CheckpointStore;
use std::fs;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Keeps the state of one level.
pub(crate) struct LevelKeeper<'a> {
    log: &'a CacheLog,
    every: Duration,
    last: Instant,
    path: PathBuf,
    key: &'a str,
    what: &'a str,
}

impl<'a> LevelKeeper<'a> {
    /// For the level that is stored as `path` under `key`; messages call it `what`.
    pub(crate) fn new(
        log: &'a CacheLog,
        every: Duration,
        path: &Path,
        key: &'a str,
        what: &'a str,
    ) -> Self {
        let path = path.with_extension("checkpoint");
        Self { log, every, last: Instant::now(), path, key, what }
    }

    /// The level has ended and is stored itself.
    pub(crate) fn forget(&self) {
        match fs::remove_file(&self.path) {
            Err(error) if error.kind() != ErrorKind::NotFound => self.log.record_error(&error),
            _ => {}
        }
        // What was being written when an earlier run was killed.
        let _ = fs::remove_file(self.unfinished());
    }

    fn unfinished(&self) -> PathBuf {
        self.path.with_extension("unfinished")
    }

    fn refuse(&self, why: &str) {
        self.log.add(format!("{}: its checkpoint {why}; the level starts anew", self.what));
    }
}

impl CheckpointStore for LevelKeeper<'_> {
    fn left(&mut self) -> Option<Vec<u8>> {
        let bytes = match fs::read(&self.path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == ErrorKind::NotFound => return None,
            Err(error) => {
                self.refuse(&format!("cannot be read ({error})"));
                return None;
            }
        };
        let state = state(bytes, self.key);
        state.map_err(|why| self.refuse(why)).ok()
    }

    fn taken(&mut self, steps: Option<u64>) {
        match steps {
            Some(steps) => self.log.add(format!("{}: goes on after step {steps}", self.what)),
            None => self.refuse("holds another state"),
        }
    }

    fn is_due(&mut self) -> bool {
        self.last.elapsed() >= self.every
    }

    fn keep(&mut self, state: &[u8]) {
        let unfinished = self.unfinished();
        let written = write_whole(&self.path, &unfinished, &sealed(state, self.key));
        if let Err(error) = written {
            self.log.record_error(&error);
        }
        self.last = Instant::now();
    }
}

/// Bytes of a fingerprint.
const SEAL: usize = 8;

fn head(key: &str) -> String {
    format!("# {key}\n")
}

fn sealed(state: &[u8], key: &str) -> Vec<u8> {
    let mut bytes = [head(key).as_bytes(), state].concat();
    bytes.extend(fingerprint(&bytes).to_le_bytes());
    bytes
}

/// The state in a [`sealed`] file, or the reason for rejecting it.
fn state(mut bytes: Vec<u8>, key: &str) -> Result<Vec<u8>, &'static str> {
    let Some((rest, seal)) = bytes.split_last_chunk::<SEAL>() else { return Err("is torn") };
    if fingerprint(rest).to_le_bytes() != *seal {
        return Err("is torn");
    }
    let head = head(key);
    if !rest.starts_with(head.as_bytes()) {
        return Err("is of another level, suite or program");
    }
    bytes.truncate(bytes.len() - SEAL);
    Ok(bytes.split_off(head.len()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_torn_changed_or_of_another_level_is_not_taken() {
        let whole = sealed(&[7, 0, 255], "key");
        assert_eq!(state(whole.clone(), "key"), Ok(vec![7, 0, 255]));
        assert_eq!(state(sealed(&[], "key"), "key"), Ok(vec![]));
        for end in 0..whole.len() {
            assert_eq!(state(whole[..end].to_vec(), "key"), Err("is torn"), "{end}");
        }
        for at in 0..whole.len() {
            let mut changed = whole.clone();
            changed[at] ^= 4;
            assert_eq!(state(changed, "key"), Err("is torn"), "{at}");
        }
        for other in ["another", "ke", "key\n"] {
            assert_eq!(state(whole.clone(), other), Err("is of another level, suite or program"));
        }
    }
}
