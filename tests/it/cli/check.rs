//! `mpm-verify check`: notes, and warnings that suites acknowledge.

use super::{BAD_INPUT, BAR, FAILED, Folder, SOUND, assert_contains};
use crate::common::folder::flat;
use rstest::rstest;

/// Creates the bar with a time step longer than the stable one, followed by `more`.
fn long_step(more: &str) -> String {
    let text = BAR.replace("dt: 1e-3", "dt: \"1.3*h/10\"");
    assert_ne!(text, BAR);
    format!("{text}\n{more}\n")
}

/// Creates the bar with the same short step on all levels, which causes a note.
fn with_note(name: &str) -> String {
    let text = BAR.replace("suite: short-bar", &format!("suite: {name}"));
    assert_ne!(text, BAR);
    text
}

const NOTE: &str = "note: the time step is the same on every level";

#[test]
fn notes_are_printed_for_named_suites() {
    let folder = Folder::with("bars/a.yaml", with_note("bar-a"));
    folder.write("bars/b.yaml", with_note("bar-b"));
    let of_folder = folder.call(&["check", "bars"]);
    assert!(!of_folder.errors.contains(NOTE), "{}", of_folder.errors);
    let hint = " notes (printed with `--notes`, or for suites that are named)";
    assert_contains(&of_folder.errors, &[hint]);
    let printed = |arguments: &[&str]| folder.call(arguments).errors.matches(NOTE).count();
    assert_eq!(printed(&["check", "bars", "--notes"]), 2);
    assert_eq!(printed(&["check", "bars/a.yaml"]), 1);
    assert_eq!(printed(&["check", "bars/a.yaml", "bars/b.yaml"]), 2);
    assert_eq!(printed(&["check", "bars/a.yaml", "--quiet"]), 0);
}

const ACKNOWLEDGED: &str =
    "acknowledge: [{warning: time_step, because: it is what the suite shows}]";

#[test]
fn an_acknowledged_warning_is_not_printed() {
    let folder = Folder::with("bar.yaml", long_step(""));
    let warned = folder.call(&["check", "bar.yaml", "--strict"]).ended(FAILED);
    insta::assert_snapshot!(warned.errors, @r#"
    warning: with 4 cells the time step is 1.30 times the time in which a wave crosses a cell
      --> bar.yaml:19:24
       |
    19 | run: {until: 0.05, dt: "1.3*h/10"}
       |                        ^^^^^^^^^^ expected a stable step
       |
       = help: `dt: {courant: 0.5}` uses half of the stable time step on every level;
               if the suite intends this, `acknowledge` `time_step`
    note: the exact solution assumes small strains, but MPM computes finite strains: at a strain of
          7.1e-5 an error of about 9.8e-10 m remains, which would become visible from about 70 cells on
      --> bar.yaml:17:17
       |
    17 |   displacement: ["1e-3*sin(pi*X/2)*sin(omega*t)/omega"]
       |                 ^
    1 warning, 1 note
    "#);
    folder.write("bar.yaml", long_step(ACKNOWLEDGED));
    let found = folder.call(&["check", "bar.yaml", "--strict"]).ended(SOUND);
    assert!(!found.errors.contains("warning"), "{}", found.errors);
}

#[test]
fn an_acknowledgement_without_its_warning_is_a_warning() {
    let folder =
        Folder::with("bar.yaml", long_step(&ACKNOWLEDGED.replace("time_step", "end_on_node")));
    let found = folder.call(&["check", "bar.yaml", "--strict"]).ended(FAILED);
    let (of_the_step, own) = found.errors.rsplit_once("\nwarning: ").expect("two warnings");
    assert_contains(&flat(of_the_step), &["times the time in which a wave crosses a cell"]);
    insta::assert_snapshot!(own, @"
    there is no warning `end_on_node` to acknowledge
      --> bar.yaml:32:25
       |
    32 | acknowledge: [{warning: end_on_node, because: it is what the suite shows}]
       |                         ^^^^^^^^^^^
       |
       = help: remove this entry
    2 warnings, 1 note
    ");
}

#[rstest]
#[case::an_unknown_name("[{warning: time_stp, because: x}]", "did you mean `time_step`?")]
#[case::no_reason("[{warning: time_step}]", "missing key `because`")]
#[case::an_empty_reason(
    "[{warning: time_step, because: \" \"}]",
    "`because` is empty: state the reason for this acknowledged warning"
)]
#[case::the_same_twice(
    "[{warning: time_step, because: x}, {warning: time_step, because: y}]",
    "`time_step` is acknowledged twice"
)]
#[case::a_bare_name("[time_step]", "expected a map")]
fn an_acknowledgement_is_refused_with(#[case] entries: &str, #[case] words: &str) {
    let folder = Folder::with("bar.yaml", long_step(&format!("acknowledge: {entries}")));
    let found = folder.call(&["check", "bar.yaml"]).ended(BAD_INPUT);
    assert_contains(&found.errors, &[words]);
}
