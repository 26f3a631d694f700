//! Names of cases contain exactly the settings that distinguish two methods.

use super::samples::{BAR, SWEPT};
use super::{Edits, load, refused};
use rstest::rstest;

const METHODS: &str = "- mpm: {basis: linear, transfer: flip, scheme: [musl, usl]}
  - fem: {element: linear, mass: lumped}
";

/// Returns the names of the cases of a bar with these methods.
fn names(methods: &[&str]) -> Vec<String> {
    let entries = format!("- {}\n", methods.join("\n  - "));
    let (head, _) = BAR.split_once("\nexpect:").expect("expectations");
    let expected = "\nexpect:\n  - {verdict: too_few_levels, because: two levels are no claim}\n";
    let suite = head.replace(METHODS, &entries) + expected;
    let suite = load(&suite).unwrap_or_else(|diagnostic| panic!("{diagnostic}"));
    suite.case_names().into_iter().map(ToOwned::to_owned).collect()
}

#[rstest]
#[case::frames(
    &["mpm: {basis: linear, transfer: flip, scheme: usl}",
      "mpm: {basis: linear, transfer: flip, scheme: usl, frame: total_lagrangian}"],
    &["mpm-linear-flip-usl-updated-lagrangian", "mpm-linear-flip-usl-total-lagrangian"]
)]
#[case::mass_matrices(
    &["mpm: {basis: linear, transfer: flip, scheme: usl, mass: lumped}",
      "mpm: {basis: linear, transfer: flip, scheme: usl, mass: consistent}"],
    &["mpm-linear-flip-usl-lumped", "mpm-linear-flip-usl-consistent"]
)]
#[case::starts(
    &["mpm: {basis: linear, transfer: flip, scheme: usl, start: half_step_back}",
      "mpm: {basis: linear, transfer: flip, scheme: usl}"],
    &["mpm-linear-flip-usl-half-step-back", "mpm-linear-flip-usl-at-zero"]
)]
#[case::samplings(
    &["fem: {element: linear, mass: lumped, sampling: nodes}",
      "fem: {element: linear, mass: lumped}"],
    &["fem-linear-lumped-nodes", "fem-linear-lumped-inside"]
)]
#[case::a_law_and_that_of_the_scene(
    &["fem: {element: linear, mass: lumped, law: hencky}",
      "fem: {element: linear, mass: lumped}"],
    &["fem-linear-lumped-hencky", "fem-linear-lumped-small-strain"]
)]
#[case::parameters_of_a_transfer(
    &["mpm: {basis: linear, transfer: {fmpm: 2}, scheme: usl}",
      "mpm: {basis: linear, transfer: {fmpm: 4}, scheme: usl}"],
    &["mpm-linear-fmpm-2-usl", "mpm-linear-fmpm-4-usl"]
)]
#[case::what_all_share_stays_out(
    &["mpm: {basis: linear, transfer: flip, scheme: usl, mass: lumped, frame: total_lagrangian}",
      "mpm: {basis: linear, transfer: pic, scheme: usl, mass: lumped, frame: total_lagrangian}"],
    &["mpm-linear-flip-usl", "mpm-linear-pic-usl"]
)]
#[case::only_names_that_would_be_equal_become_longer(
    &["mpm: {basis: linear, transfer: [flip, pic], scheme: usl}",
      "mpm: {basis: linear, transfer: flip, scheme: usl, frame: total_lagrangian}"],
    &["mpm-linear-flip-usl-updated-lagrangian", "mpm-linear-pic-usl", "mpm-linear-flip-usl-total-lagrangian"]
)]
#[case::a_longer_name_that_is_taken_becomes_longer_again(
    &["mpm: {basis: linear, transfer: flip, scheme: usl, frame: [updated_lagrangian, total_lagrangian], start: half_step_back}",
      "mpm: {basis: linear, transfer: flip, scheme: usl, frame: updated_lagrangian}",
      "mpm: {basis: linear, transfer: flip, scheme: usl, frame: total_lagrangian}"],
    &["mpm-linear-flip-usl-half-step-back-updated-lagrangian", "mpm-linear-flip-usl-half-step-back-total-lagrangian",
      "mpm-linear-flip-usl-at-zero-updated-lagrangian", "mpm-linear-flip-usl-at-zero-total-lagrangian"]
)]
fn methods_that_differ_in(#[case] methods: &[&str], #[case] wanted: &[&str]) {
    assert_eq!(names(methods), wanted);
}

#[rstest]
#[case::one_entry_twice(
    &[("  - fem:", "  - ▸mpm: {basis: linear, transfer: flip, scheme: usl}\n  - fem:")],
    &["the case `mpm-linear-flip-usl` appears twice", "the second time"]
)]
#[case::a_default_and_its_name(
    &[("  - fem:", "  - ▸mpm: {basis: linear, transfer: flip, scheme: usl, frame: updated_lagrangian}\n  - fem:")],
    &["the case `mpm-linear-flip-usl` appears twice"]
)]
#[case::a_law_and_its_name(
    &[(
        "  - fem: {element: linear, mass: lumped}",
        "  - fem: {element: linear, mass: lumped}\n  - ▸fem: {element: linear, mass: lumped, law: small_strain}"
    )],
    &["the case `fem-linear-lumped` appears twice"]
)]
#[case::one_member_twice(
    &[("[musl, usl]", "[musl, usl], frame: [total_lagrangian, total_lagrangian]"), ("- mpm:", "- ▸mpm:")],
    &["the case `mpm-linear-flip-musl-total-lagrangian` appears twice"]
)]
fn equal_methods(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(BAR, edits, words);
}

#[test]
fn methods_of_a_stability_study_have_unique_names() {
    let (head, _) = SWEPT.split_once("\nmethods:").expect("methods");
    let suite = load(&format!(
        "{head}
methods:
  - mpm: {{basis: linear, transfer: flip, scheme: usl}}
  - mpm: {{basis: linear, transfer: flip, scheme: usl, frame: total_lagrangian}}
expect:
  - {{critical: {{above: 0.1}}, because: it is stable there}}
"
    ));
    let suite = suite.unwrap_or_else(|diagnostic| panic!("{diagnostic}"));
    let wanted = ["mpm-linear-flip-usl-updated-lagrangian", "mpm-linear-flip-usl-total-lagrangian"];
    assert_eq!(suite.case_names(), wanted);
}
