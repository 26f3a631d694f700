//! Forces on a set of a body that is not a box: solutions for a wrong volume of the set, and sets
//! outside the body.

use super::{refuse_in, refused};
use crate::common::valid_suite;
use rstest::rstest;

/// Creates a body in translation with a constant acceleration.
fn pulled(dimension: usize, body: &str, volume: &str) -> String {
    let vector = |first: &str| format!("[\"{first}\"{}]", ", 0".repeat(dimension - 1));
    let corner = |x: &str| format!("[{}]", vec![x; dimension].join(", "));
    let (from, to) = (corner("-2"), corner("2"));
    let (force, moved) = (vector("f"), vector("f/(rho*V)*t^2/2"));
    let ppc = 1 << dimension;
    format!(
        r#"suite: pulled
title: Body that is pulled
source: "Newton's second law"

parameters:
  rho: 3
  f: 0.5
  V: "{volume}"

scene:
  dimension: {dimension}
  body: {body}
  grid: {{from: {from}, to: {to}}}
  sets: {{all: {{box: {{from: {from}, to: {to}}}}}}}
  loads: [{{force: {{on: all, value: {force}}}}}]
  material: {{neo_hookean: {{young: 100, poisson: 0.3, density: rho}}}}

exact:
  equation: neo_hookean
  displacement: {moved}

run: {{until: 0.5, dt: 1e-3}}
refine: {{cells: [4, 8], ppc: {ppc}}}

methods:
  - mpm: {{basis: linear, transfer: flip, scheme: musl}}
"#
    )
}

const DISK: &str = "{disk: {centre: [0.1, 0], radius: 1}}";

#[rstest]
#[case::a_disk(2, DISK, "pi")]
#[case::a_ring(2, "{annulus: {centre: [0, 0], inner: 0.5, outer: 1}}", "3/4*pi")]
#[case::a_ball(3, "{ball: {centre: [0, 0, 0.5], radius: 1}}", "4/3*pi")]
#[case::a_triangle(2, "{polygon: [[0, 0], [1, 0], [0, 1]]}", "1/2")]
#[case::a_box(2, "{box: {from: [0, 0], to: [1, 0.5]}}", "1/2")]
fn a_force_is_that_on_the_volume_of(
    #[case] dimension: usize,
    #[case] body: &str,
    #[case] volume: &str,
) {
    valid_suite(&pulled(dimension, body, volume));
    let other = [("displacement: [", "displacement: [▸")];
    let another = pulled(dimension, body, &format!("1.001*{volume}"));
    refused(&another, &other, &["equation of motion in X"]);
}

/// Only the part of the set inside the body counts, even if it is a small part of the set.
#[test]
fn a_set_may_be_far_larger_than_the_body() {
    let text = pulled(2, DISK, "pi");
    let all = "{all: {box: {from: [-2, -2], to: [2, 2]}}}";
    let text = text.replace(all, "{all: {box: {from: [-1e8, -1e8], to: [1e8, 1e8]}}}");
    valid_suite(&text);
}

#[test]
fn a_set_beside_the_body_is_refused() {
    let edit = "all: {box: {from: [-2, -2], to: [2, 2] → all: {box: {from: ▸[0.9, 0.9], to: [1, 1]";
    for (body, words) in [
        (DISK, "contains no part of the disk … the body is a disk about (0.1, 0)"),
        (
            "{polygon: [[-1, -1], [1.05, -1], [-1, 1.05]]}",
            "contains no part of the polygon … the body is a polygon",
        ),
    ] {
        refuse_in(&pulled(2, body, "1"), &format!("{edit}\n⇒ the set `all` {words}"));
    }
}
