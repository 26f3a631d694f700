//! Thread-safe log of the result cache, drained once at the end.

use std::fmt::Display;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The first error, and lines that say what was done.
#[derive(Debug, Default)]
pub(crate) struct CacheLog {
    first_error: Mutex<Option<String>>,
    lines: Mutex<Vec<String>>,
}

impl CacheLog {
    pub(crate) fn add(&self, line: String) {
        lock(&self.lines).push(line);
    }

    pub(crate) fn record_error(&self, error: &dyn Display) {
        lock(&self.first_error).get_or_insert_with(|| error.to_string());
    }

    pub(crate) fn first_error(&self) -> Option<String> {
        lock(&self.first_error).clone()
    }

    /// Each line once, in an order that does not depend on threads.
    pub(crate) fn take_lines(&self) -> Vec<String> {
        let mut lines = std::mem::take(&mut *lock(&self.lines));
        lines.sort();
        lines
    }
}

fn lock<T>(of: &Mutex<T>) -> MutexGuard<'_, T> {
    of.lock().unwrap_or_else(PoisonError::into_inner)
}
