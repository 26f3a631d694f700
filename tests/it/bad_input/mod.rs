//! Suites with one mistake each. Tests check the message, its position and its suggestion.
//!
//! A mistake is written as edits of a valid suite. The sign `▸` in an edit is not part of the
//! suite: it marks the line and column at which the error must point.

mod boundaries;
mod case_names;
mod equilibria;
mod grammar;
mod heat;
mod judged_boxes;
mod materials;
mod methods;
mod polygons;
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
mod tables;
mod truths;
mod vortex;

use crate::common::folder::{assert_contains, flat};
use crate::common::{built_in_source, edited, valid_suite};
use crate::schema;
use mpm_verify::suite::Suite;
use mpm_verify::suite::yaml::{Diagnostic, Source};
use samples::{BAR, CUBE, PLATE, SWEPT};

/// Marks the position at which an error must point.
const HERE: char = '▸';

/// Pairs of a text in a valid suite and its replacement.
type Edits<'a> = &'a [(&'a str, &'a str)];

/// Removes the finite elements of the bar.
const NO_FEM: Edits<'_> = &[
    ("  - fem: {element: linear, mass: lumped}\n", ""),
    (
        "  - case: \"fem-*\"\n    verdict: too_few_levels\n    because: two levels support no",
        "    #",
    ),
];

/// Calls `check` with a valid suite, edits and the parts of the error, for each row of a table.
///
/// A row has lines `text → replacement`, and then the parts: `⇒ part … part`. The sign `\n` is the
/// end of a line of the suite. Lines that begin with two spaces continue the previous line, and
/// lines that begin with `#` are comments. After a line `@name text` the rows are mistakes in the
/// suite with this name, at first in `sound`. The text contains the mark of all rows that have
/// none.
fn for_each_row(sound: &str, table: &str, check: impl Fn(&str, Edits<'_>, &[&str])) {
    let lines = table.replace("\n  ", "").replace(" ⇒ ", "\n⇒ ").replace("\\n", "\0");
    let (mut sound, mut mark) = (sound.to_owned(), String::new());
    let mut edits: Vec<[String; 2]> = Vec::new();
    for line in lines.lines().filter(|line| !line.is_empty() && !line.starts_with('#')) {
        if let Some(section) = line.strip_prefix('@') {
            let (name, marked) = section.split_once(' ').unwrap_or((section, ""));
            marked.clone_into(&mut mark);
            match name {
                "" => {}
                "bar" => BAR.clone_into(&mut sound),
                "mpm-bar" => sound = edited(BAR, NO_FEM),
                "plate" => PLATE.clone_into(&mut sound),
                "cube" => sound = edited(PLATE, CUBE),
                _ => built_in_source(name).text().clone_into(&mut sound),
            }
        } else if let Some(words) = line.strip_prefix("⇒ ") {
            println!("{edits:?}");
            if !edits.iter().any(|[_, to]| to.contains(HERE)) {
                edits.push([mark.replace(HERE, ""), mark.clone()]);
            }
            let pairs: Vec<_> = edits.iter().map(|[from, to]| (&**from, &**to)).collect();
            check(&sound, &pairs, &words.split(" … ").collect::<Vec<_>>());
            edits.clear();
        } else {
            let (from, to) = line.split_once(" →").expect(line);
            let to = to.strip_prefix(' ').unwrap_or(to);
            edits.push([from, to].map(|text| text.replace('\0', "\n")));
        }
    }
    assert!(edits.is_empty(), "no error is stated for {edits:?}");
}

/// Asserts that each mistake of a table is refused. The rows before the first name are mistakes in
/// `sound`.
fn refuse_in(sound: &str, table: &str) {
    for_each_row(sound, table, refused);
}

/// Asserts that each mistake of a table is refused.
fn refuse_all(table: &str) {
    refuse_in("", table);
}

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
    // A long line is shortened.
    assert!(excerpt.starts_with(quoted.trim_end_matches('.')), "another line in\n{shown}");
    let carets = &lines[at + 1][start.len()..];
    assert_eq!(carets.find('^'), Some(column - 1), "no caret under column {column} in\n{shown}");
}

#[test]
fn unchanged_samples_are_valid() {
    for text in [BAR, PLATE, &edited(BAR, NO_FEM), &edited(PLATE, CUBE)] {
        valid_suite(text);
    }
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
