//! `run --html`: the page of a run.

use mpm_verify::report::page;
use mpm_verify::study::describe::sketch::sketch_svg;
use mpm_verify::suite::Suite;
use mpm_verify::suite::yaml::Source;
use mpm_verify::verify::SuiteOutcome;
use std::fmt::Display;
use std::fs;
use std::path::Path;

/// Makes the folder of the page, before hours are spent on what cannot be written.
pub(super) fn prepare(file: &Path) -> Result<(), String> {
    if file.is_dir() {
        return Err(unwritable(file, &"this is a folder"));
    }
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty());
    let made = folder.map_or(Ok(()), fs::create_dir_all);
    made.map_err(|error| unwritable(file, &error))
}

/// Writes the page; suites and outcomes are in the order of their sources, without those that were
/// refused or left out.
pub(super) fn write(
    file: &Path,
    sources: &[Source],
    suites: &[Suite],
    outcomes: &[SuiteOutcome],
    refused: usize,
) -> Result<(), String> {
    let named = |source: &Source| {
        let name = Path::new(source.name()).file_name();
        name.map_or_else(String::new, |name| name.to_string_lossy().into_owned())
    };
    let names: Vec<String> = sources.iter().map(named).collect();
    let sketches: Vec<Option<String>> = suites.iter().map(sketch_svg).collect();
    let parts = sources.iter().zip(&names).zip(outcomes).zip(&sketches);
    let parts: Vec<page::SuiteSource<'_>> = parts
        .map(|(((source, file), outcome), sketch)| page::SuiteSource {
            outcome,
            file,
            yaml: source.text(),
            sketch: sketch.as_deref(),
        })
        .collect();
    fs::write(file, page::page(&parts, refused)).map_err(|error| unwritable(file, &error))
}

fn unwritable(file: &Path, error: &impl Display) -> String {
    format!("error: --html {}: {error}", file.display())
}
