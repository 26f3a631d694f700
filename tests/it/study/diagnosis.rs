//! Diagnoses of cases in the suites of this repository. Their authors state the causes in
//! `because`, which a diagnosis does not read.

use crate::common::{built_in_source, read_suite};
use mpm_verify::study::diagnose;
use mpm_verify::suite::Suite;
use mpm_verify::verify::Diagnosis;
use rstest::rstest;

/// Budget of predicted time (s) for the runs of a case.
const BUDGET: f64 = 60.0;

fn diagnosis(suite: &str, case: &str) -> Option<Diagnosis> {
    let source = built_in_source(suite);
    let suite = Suite::load(&source).expect("a sound suite");
    let names = suite.case_names();
    let index = names.iter().position(|name| *name == case).unwrap_or_else(|| {
        panic!("no case `{case}` among {names:?}");
    });
    diagnose(&suite, &source, index, BUDGET, None).expect("a case that runs")
}

fn names(suite: &str, case: &str, cause: &str) {
    let found = diagnosis(suite, case).expect("an order to explain");
    assert!(!found.is_sound(), "{suite}::{case} has the theoretical order");
    let causes = found.causes();
    let first = causes.first().unwrap_or_else(|| panic!("no cause: {found:#?}"));
    assert!(first.cause().starts_with(cause), "{first:#?}");
    assert!(first.remedy().is_some(), "`check` refuses the remedy: {first:#?}");
}

#[rstest]
#[case("vibrating-bar", "mpm-linear-flip-usf", "the scheme")]
#[case("fem-oedometer-fixed-step", "fem-linear-lumped-at-zero", "the start")]
#[case("heat-temporal-order", "heat-cubic-bspline", "too few particles per cell")]
#[case("local-damping-bar", "mpm-quadratic-bspline-flip-musl-lumped", "lumping")]
#[case("mms-periodic-bar-sin", "mpm-linear-flip-usl", "grid crossing")]
#[case("mms-periodic-bar-sin", "mpm-quadratic-bspline-flip-usl", "the motion carries particles")]
fn a_cause_is_found(#[case] suite: &str, #[case] case: &str, #[case] cause: &str) {
    names(suite, case, cause);
}

/// The other known causes take too long for a gate.
#[rstest]
#[case("mms-periodic-bar-sin", "mpm-ugimp-flip-usl", "domains of fixed width")]
#[case("mms-periodic-bar-cos", "mpm-cpgimp-flip-musl-at-zero", "the start")]
#[case("mms-fixed-bar-cubic", "mpm-cubic-bspline-flip-musl-consistent", "too few particles")]
#[case("mms-fixed-bar-cubic-consistent", "mpm-cubic-bspline-flip-musl-lumped", "lumping")]
#[case("heat-mms", "heat-cubic-bspline", "too few particles per cell")]
#[case("oedometer", "mpm-cpgimp-flip-musl-vs-exact", "the exact formula solves a different model")]
#[case(
    "oedometer",
    "fem-linear-lumped-small-strain-vs-reference",
    "the reference solves a different"
)]
#[case("oedometer-small-strain", "mpm-linear-flip-musl-at-zero", "the start")]
#[case("thermal-expansion-mms", "mpm-linear-flip-musl", "grid crossing")]
#[case("simple-wave", "mpm-linear-flip-musl", "grid crossing")]
#[ignore = "40 s of CPU time"]
fn a_cause_is_found_in_time(#[case] suite: &str, #[case] case: &str, #[case] cause: &str) {
    names(suite, case, cause);
}

#[rstest]
#[case("damped-bar", "mpm-linear-flip-musl mpm-linear-apic-musl mpm-cpgimp-flip-musl")]
#[case("damped-bar", "mpm-quadratic-bspline-apic-musl mpm-linear-flip-usf")]
#[case("heat-temporal-order", "heat-linear heat-cpdi heat-quadratic-bspline")]
#[case("vibrating-bar", "mpm-linear-flip-musl mpm-linear-flip-usl")]
fn no_cause_is_named_without_a_defect(#[case] suite: &str, #[case] cases: &str) {
    for case in cases.split(' ') {
        let found = diagnosis(suite, case).expect("an order");
        assert!(found.is_sound() && found.runs.is_empty(), "{case}: {found:#?}");
    }
}

#[test]
fn changes_beyond_the_budget_are_listed() {
    let source = built_in_source("vibrating-bar");
    let suite = Suite::load(&source).expect("a sound suite");
    let usf = suite.case_names().iter().position(|name| name.ends_with("usf")).expect("USF");
    let found = diagnose(&suite, &source, usf, 1e-9, None).expect("a run").expect("an order");
    assert!(found.runs.is_empty() && found.skipped.len() > 5, "{found:#?}");
    let said = mpm_verify::report::diagnosis(&found);
    assert!(said.contains("beyond the budget"), "{said}");
}

/// The interface of two bars is in the middle of a cell, where linear functions have no kink.
#[test]
fn aligned_grid_reveals_an_interface_inside_a_cell() {
    let source = built_in_source("bar-of-two-materials");
    let text = source.text().replace("cells: [20, 40, 80, 160]", "cells: [7, 11, 17, 25]");
    let (source, suite) = read_suite(&text);
    let found = diagnose(&suite, &source, 0, BUDGET, None).expect("a run").expect("an order");
    let (run, _) = found.found().unwrap_or_else(|| panic!("no cause: {found:#?}"));
    assert!(run.cause.starts_with("an interface"), "{}: {found:#?}", run.cause);
}
