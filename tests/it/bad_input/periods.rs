//! Periodic bodies that are stretched at the start, on a grid with another length than the body.

use super::{load, refused};
use rstest::rstest;

/// A periodic bar that is stretched to the length of the grid.
const STRETCHED: &str = r#"suite: stretched
title: Stretched periodic bar
source: a textbook

parameters:
  V: 2

scene:
  dimension: 1
  body: {box: {from: [0], to: [1]}}
  grid: {from: [0], to: [1.2]}
  material: {neo_hookean: {young: 100, poisson: 0, density: 1}}
  boundary: {left: periodic, right: periodic}

exact:
  equation: neo_hookean
  displacement: ["0.2*X + V*t"]

run: {until: 0.5, dt: 1e-3}
refine: {cells: [5, 10], ppc: 2}

methods:
  - mpm: {basis: linear, transfer: flip, scheme: musl}

expect:
  - verdict: too_few_levels
    because: two levels support no claim
"#;

#[test]
fn stretched_ring_is_valid() {
    if let Err(diagnostic) = load(STRETCHED) {
        panic!("{diagnostic}");
    }
}

#[rstest]
#[case::a_reference_place(
    "scheme: musl",
    "scheme: musl, frame: ▸total_lagrangian",
    "`total_lagrangian` needs a periodic grid as long as the body"
)]
#[case::a_motion_of_another_period(
    "[\"0.2*X",
    "[▸\"0.19*X",
    "left is periodic, but x_X does not differ by one period"
)]
#[case::a_motion_that_does_not_stretch("[\"0.2*X + V*t", "[▸\"V*t", "expected 1.2")]
fn a_stretched_ring_with(#[case] right: &str, #[case] wrong: &str, #[case] words: &str) {
    refused(STRETCHED, &[(right, wrong)], &[words]);
}
