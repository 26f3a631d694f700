//! Values of options that are not finite, outside of their range, or of another type.

use super::{BAD_INPUT, BAR, Folder};
use rstest::rstest;

#[rstest]
#[case::a_time_that_is_no_number(&["problem", "bar.yaml", "--at", "nan"], "expected a finite number")]
#[case::an_infinite_time(&["problem", "bar.yaml", "--at", "inf"], "expected a finite number")]
#[case::a_time_after_the_run(
    &["problem", "bar.yaml", "--at", "99"],
    "`--at 99` is not a time of the run: expected 0 to 0.05 s"
)]
#[case::a_time_before_the_run(
    &["problem", "bar.yaml", "--at", "-1"],
    "`--at -1` is not a time of the run: expected 0 to 0.05 s"
)]
#[case::a_negative_level(&["problem", "bar.yaml", "--level", "-1"], "expected a whole number")]
#[case::a_fraction_of_a_level(&["problem", "bar.yaml", "--level", "1.5"], "expected a whole number")]
#[case::a_level_in_words(&["problem", "bar.yaml", "--level", "two"], "expected a whole number")]
#[case::no_thread(&["run", "bar.yaml", "--jobs", "0"], "expected a whole number, 1 or more")]
#[case::a_negative_number_of_threads(&["run", "bar.yaml", "--jobs", "-2"], "expected a whole number, 1 or more")]
#[case::negative_memory(
    &["run", "bar.yaml", "--solver", "x", "--solver-memory", "-1"],
    "expected a whole number, 1 or more"
)]
#[case::a_negative_timeout(
    &["run", "bar.yaml", "--solver", "x", "--solver-timeout", "-5s"],
    "expected a time with its unit"
)]
#[case::an_infinite_timeout(
    &["run", "bar.yaml", "--solver", "x", "--solver-timeout", "infs"],
    "expected a time with its unit"
)]
#[case::a_negative_budget(&["cost", "bar.yaml", "--budget", "-1s"], "expected a time with its unit")]
#[case::a_negative_shard(&["run", "bar.yaml", "--shard", "-1/2"], "expected a number and a count")]
#[case::a_tolerance_that_is_no_number(
    &["compare", "a.json", "b.json", "--tolerance", "nan"],
    "expected a finite number, zero or more"
)]
#[case::a_negative_tolerance(
    &["compare", "a.json", "b.json", "--tolerance", "-0.1"],
    "expected a finite number, zero or more"
)]
#[case::an_open_quote(
    &["check", "bar.yaml", "--solver", "python3 \"solver.py"],
    "the solver command has a quote that is not closed"
)]
#[case::no_program(&["check", "bar.yaml", "--solver", ""], "the solver is empty: expected a command with its arguments")]
fn an_option_with(#[case] arguments: &[&str], #[case] words: &str) {
    let folder = Folder::new();
    folder.write("bar.yaml", BAR);
    let answer = folder.call(arguments);
    assert_eq!((answer.code, answer.out.as_str()), (BAD_INPUT, ""), "{}", answer.errors);
    assert!(answer.errors.contains(words), "no `{words}` in\n{}", answer.errors);
    for name in ["u64", "usize", "f64", "invalid digit", "'-- -"] {
        assert!(!answer.errors.contains(name), "`{name}` in\n{}", answer.errors);
    }
}

/// The advice of the library, `-- -1`, would pass the number as a suite.
#[test]
fn a_stray_negative_number_gets_no_advice_that_fails() {
    let folder = Folder::new();
    folder.write("bar.yaml", BAR);
    let answer = folder.call(&["run", "bar.yaml", "-1"]);
    assert_eq!(answer.code, BAD_INPUT);
    assert!(answer.errors.contains("unexpected argument '-1'"), "{}", answer.errors);
    assert!(!answer.errors.contains("-- -1"), "{}", answer.errors);
}
