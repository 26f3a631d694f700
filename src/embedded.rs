//! The suites of the repository, embedded in the library.

use crate::suite::yaml::{Diagnostic, Source};
use std::path::Path;

/// Name, path in the repository and text of the suites in `verification/`, sorted by name.
const FILES: &[(&str, &str, &str)] = include!(concat!(env!("OUT_DIR"), "/suites.rs"));

/// Returns the names of the embedded suites, sorted.
pub fn names() -> impl Iterator<Item = &'static str> {
    FILES.iter().map(|(name, ..)| *name)
}

/// Returns names and paths (from the repository root) of the embedded suites, sorted by name.
pub fn paths() -> impl Iterator<Item = (&'static str, &'static Path)> {
    FILES.iter().map(|(name, path, _)| (*name, Path::new(*path)))
}

/// Returns the embedded suite `name`, if it exists.
pub fn source(name: &str) -> Option<Result<Source, Diagnostic>> {
    let (_, path, text) = FILES.iter().find(|(found, ..)| *found == name)?;
    Some(Source::from_text(*path, *text))
}
