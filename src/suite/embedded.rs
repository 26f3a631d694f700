//! The suites of the repository, built into the library.

use super::yaml::{Diagnostic, Source};
use std::path::Path;

/// Name, path from the root of the repository and text of every suite under `verification/`, sorted
/// by name.
const FILES: &[(&str, &str, &str)] = include!(concat!(env!("OUT_DIR"), "/suites.rs"));

/// Names of the embedded suites, sorted.
pub fn names() -> impl Iterator<Item = &'static str> {
    FILES.iter().map(|(name, ..)| *name)
}

/// Names of the embedded suites with their paths from the root of the repository, sorted.
pub fn paths() -> impl Iterator<Item = (&'static str, &'static Path)> {
    FILES.iter().map(|(name, path, _)| (*name, Path::new(*path)))
}

/// The embedded suite named `name`, if there is one.
pub fn source(name: &str) -> Option<Result<Source, Diagnostic>> {
    let (_, path, text) = FILES.iter().find(|(found, ..)| *found == name)?;
    Some(Source::from_text(*path, *text))
}
