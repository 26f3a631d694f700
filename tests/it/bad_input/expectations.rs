//! Cases and their expectations: each case has exactly one expectation.

use super::samples::BAR;
use super::{Edits, refused};
use rstest::rstest;

#[rstest]
#[case::one_that_fits_no_case(
    &[("case: \"fem-*\"", "case: ▸\"fme-*\"")],
    &["`fme-*` matches no case", "cases: mpm-linear-flip-musl, mpm-linear-flip-usl, fem-linear-lumped"]
)]
#[case::one_of_several_patterns_that_fits_no_case(
    &[("case: \"mpm-*\"", "case: [\"mpm-*\", ▸\"mmp-*\"]")],
    &["`mmp-*` matches no case"]
)]
#[case::a_second_one_for_a_case(
    &[("- case: \"fem-*\"", "- ▸case: \"*\"")],
    &["a second expectation for the case `mpm-linear-flip-musl`"]
)]
#[case::none_for_a_case(
    &[("expect:", "▸expect:"), ("case: \"mpm-*\"", "case: \"mpm-*-musl\"")],
    &["the case `mpm-linear-flip-usl` has no expectation"]
)]
#[case::an_interval_the_wrong_way_round(
    &[("[1.5, 2.5]", "▸[2.5, 1.5]")],
    &["the interval ends at 1.5 and starts at 2.5", "expected [low, high]"]
)]
#[case::an_interval_with_one_end(&[("[1.5, 2.5]", "▸[2.5]")], &["an interval has two ends", "expected [low, high]"])]
#[case::no_reason(
    &[("because: two levels", "because: ▸\"\" # two levels")],
    &["`because` is empty: state the reason for this expectation", "expected a text"]
)]
#[case::a_blank_reason(
    &[("because: two levels", "because: ▸\"  \" # two levels")],
    &["`because` is empty: state the reason for this expectation"]
)]
#[case::neither_order_nor_verdict(
    &[("- case: \"mpm-*\"\n    verdict: too_few_levels\n", "- ▸case: \"mpm-*\"\n")],
    &[
        "this expectation has no order, no verdict and no bound",
        "add `order: [1.9, 2.1]`, `verdict: divergent` or `error_below: 1e-12`",
    ]
)]
fn expectations_with(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(BAR, edits, words);
}

#[rstest]
#[case::none(
    &[
        ("methods:\n", "methods: ▸[]\n"),
        ("  - mpm: {basis: linear, transfer: flip, scheme: [musl, usl]}\n", ""),
        ("  - fem: {element: linear, mass: lumped}\n", ""),
    ],
    &["the suite has no cases: `methods` is empty"]
)]
fn methods_with(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(BAR, edits, words);
}
