//! What there is to say of what is kept: by many threads, to who asks in the end.

use std::{
    fmt::Display,
    sync::{Mutex, MutexGuard, PoisonError},
};

/// The first complaint, and lines that tell what was done.
#[derive(Debug, Default)]
pub(crate) struct Notes {
    complaint: Mutex<Option<String>>,
    told: Mutex<Vec<String>>,
}

impl Notes {
    pub(crate) fn tell(&self, line: String) {
        lock(&self.told).push(line);
    }

    pub(crate) fn complain(&self, error: &dyn Display) {
        lock(&self.complaint).get_or_insert_with(|| error.to_string());
    }

    pub(crate) fn complaint(&self) -> Option<String> {
        lock(&self.complaint).clone()
    }

    /// Each line once, in an order that does not depend on threads.
    pub(crate) fn take_told(&self) -> Vec<String> {
        let mut told = std::mem::take(&mut *lock(&self.told));
        told.sort();
        told
    }
}

fn lock<T>(of: &Mutex<T>) -> MutexGuard<'_, T> {
    of.lock().unwrap_or_else(PoisonError::into_inner)
}
