//! The suites of the repository, built into the library.

use super::yaml::{Diagnostic, Source};

/// File name and text of every file under `verification/`, sorted by name.
const FILES: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/suites.rs"));

/// Names of the embedded suites, sorted.
pub fn names() -> impl Iterator<Item = &'static str> {
    FILES.iter().filter_map(|(file, _)| file.strip_suffix(".yaml"))
}

/// The embedded suite called `name`, if there is one.
pub fn source(name: &str) -> Option<Result<Source, Diagnostic>> {
    let file = format!("{name}.yaml");
    let (file, text) = FILES.iter().find(|(found, _)| *found == file)?;
    Some(Source::from_text(format!("verification/{file}"), *text))
}
