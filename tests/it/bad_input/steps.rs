//! Invalid automatic time steps.

use super::{BAR, Edits, SWEPT, refused};
use rstest::rstest;

const MPM_ONLY: (&str, &str) = ("  - fem: {element: linear, mass: lumped}\n", "");
const NO_FEM: (&str, &str) = (
    "  - case: \"fem-*\"\n    verdict: too_few_levels\n    because: two levels support no claim\n",
    "",
);

#[rstest]
#[case::for_a_method_that_has_none(
    &[("dt: 1e-3", "dt: auto"), ("  - fem: {", "  - ▸fem: {")], &["an automatic time step is available for MPM only"]
)]
#[case::of_no_length(
    &[MPM_ONLY, NO_FEM, ("dt: 1e-3", "dt: {courant: ▸0}")], &["must be above zero"]
)]
#[case::of_another_name(
    &[MPM_ONLY, NO_FEM, ("dt: 1e-3", "dt: {▸currant: 0.5}")], &["currant", "courant"]
)]
#[case::in_a_list(
    &[MPM_ONLY, NO_FEM, ("dt: 1e-3, ", ""), ("cells: [6, 12]", "cells: 6, dt: [▸auto, 1e-3]")],
    &["auto"]
)]
fn a_rule(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(BAR, edits, words);
}

#[rstest]
#[case::that_takes_turns(
    &[("dt: \"C*h/c\"", "dt: {courant: C}, ▸alternate: 0.1")], &["`alternate` is not supported with an automatic time step"]
)]
fn a_rule_of_a_stability_study(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(SWEPT, edits, words);
}
