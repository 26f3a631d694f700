//! Suites with one mistake each. Tests check the message, its position and its suggestion.
//!
//! A mistake is written as edits of a valid suite. The sign `▸` in an edit is not part of the
//! suite: it marks the line and column at which the error must point.

mod bodies;
mod boundaries;
mod case_names;
mod combinations;
mod densities;
mod equilibria;
mod expectations;
mod fine_grids;
mod formulas;
mod foundation;
mod grammar;
mod heat;
mod initial_stress;
mod judged_boxes;
mod laws;
mod linearised;
mod load_steps;
mod materials;
mod numbers;
mod panels;
mod planes;
mod polygons;
mod precisions;
mod pulled_bodies;
mod pulses;
mod quantities;
mod random;
mod refinement;
mod samples;
mod scenes;
mod sizes;
mod spectrum;
mod stability;
mod steps;
mod tables;
mod truths;
mod volume_ratios;
mod vortex;

use crate::common::folder::{assert_contains, flat};
use crate::common::{edited, valid_suite};
use crate::schema;
use mpm_verify::suite::Suite;
use mpm_verify::suite::yaml::{Diagnostic, Source};
use rstest::rstest;
use samples::{BAR, COLUMN, CUBE, PLATE, SWEPT};

/// Marks the position at which an error must point.
const HERE: char = '▸';

/// Pairs of a text in a valid suite and its replacement.
type Edits<'a> = &'a [(&'a str, &'a str)];

fn load(text: &str) -> Result<Suite, Diagnostic> {
    Source::from_text("wrong.yaml", text).and_then(|source| Suite::load(&source))
}

/// Makes the edits in `sound`. Asserts that the error points at the mark and contains all of
/// `words`.
fn refused(sound: &str, edits: Edits<'_>, words: &[&str]) {
    let marked = edited(sound, edits);
    let (before, after) = marked.split_once(HERE).expect("a mark");
    let text = format!("{before}{after}");
    let line = before.matches('\n').count() + 1;
    let column = before.rsplit('\n').next().map_or(0, |start| start.chars().count()) + 1;
    let Err(diagnostic) = load(&text) else { panic!("accepted:\n{text}") };
    let shown = diagnostic.to_string();
    let excerpt = text.lines().nth(line - 1).expect("a line");
    points(&shown, line, column, excerpt);
    assert_contains(&flat(&shown), words);
    schema::refuses_too(&text, &diagnostic);
}

/// Asserts that the error names the position, shows the line and has a caret below the column.
fn points(shown: &str, line: usize, column: usize, excerpt: &str) {
    let lines: Vec<&str> = shown.lines().collect();
    let place = format!("--> wrong.yaml:{line}:{column}");
    assert!(lines.iter().any(|line| line.trim() == place), "no `{place}` in\n{shown}");
    let start = format!("{line} | ");
    let at = lines.iter().position(|line| line.starts_with(&start)).expect(shown);
    let quoted = &lines[at][start.len()..];
    // A long line is shortened, and a tab is shown as spaces.
    let cut = quoted.trim_end_matches('.');
    let whole = excerpt.replace('\t', "    ");
    assert!(whole.starts_with(cut), "another line in\n{shown}");
    let carets = &lines[at + 1][start.len()..];
    assert_eq!(carets.find('^'), Some(column - 1), "no caret under column {column} in\n{shown}");
}

#[rstest]
#[case::bar(BAR)]
#[case::plate(PLATE)]
#[case::cube(CUBE)]
fn unchanged_samples_are_valid(#[case] text: &str) {
    valid_suite(text);
}

#[test]
fn error_is_formatted_like_a_compiler_error() {
    let wrong = BAR.replace("until: 0.5", "until: -0.5");
    let want = "\
error: the end of the run is -0.5, but must be above zero
  --> wrong.yaml:27:14
   |
27 | run: {until: -0.5, dt: 1e-3, instants: 50}
   |              ^^^^ expected a positive number";
    assert_eq!(load(&wrong).expect_err("a mistake").to_string(), want);
}
