//! Polygons: invalid corners, names of faces that a polygon does not have, and keys that need
//! another body.

use super::{Edits, refused};
use crate::common::valid_suite;
use rstest::rstest;

const TRIANGLE: &str =
    include_str!("../../../verification/bodies-at-large-strain/mms-polygon.yaml");
const CORNERS: &str = "[[0.1, 0.15], [0.95, 0.25], [0.4, 0.9]]";

#[rstest]
#[case::of_two_corners(
    &[(CORNERS, "▸[[0.1, 0.1], [0.95, 0.25]]")], &["a polygon of 2 corners", "expected 3 to 100"]
)]
#[case::with_a_corner_in_space(
    &[("[0.95, 0.25]", "▸[0.95, 0.25, 0]")], &["3 components in a scene of dimension 2", "expected 2"]
)]
#[case::with_a_corner_that_is_no_list(&[("[0.95, 0.25]", "▸0.9")], &["0.9", "list"])]
#[case::with_a_corner_that_is_no_number(
    &[("[0.95, 0.25]", "[0.9, ▸\"1/0\"]")], &["finite"]
)]
#[case::with_a_corner_twice(
    &[("[0.4, 0.9]", "[0.4, 0.9], ▸[0.95, 0.25]")],
    &["corners 2 and 4 are 0 m apart", "expected a distance from"]
)]
#[case::with_sides_that_cross(
    &[(CORNERS, "[[0.1, 0.1], [0.9, 0.8], ▸[0.9, 0.1], [0.1, 0.8]]")],
    &["the sides from corner 1 to 2 and from 3 to 4 cross or touch", "in their order around"]
)]
#[case::with_a_side_that_turns_back(
    &[(CORNERS, "[[0.1, 0.1], ▸[0.9, 0.1], [0.5, 0.1], [0.5, 0.8]]")],
    &["the sides from corner 1 to 2 and from 2 to 3 cross or touch"]
)]
#[case::on_a_line(
    &[(CORNERS, "[[0.1, 0.1], [0.5, 0.5], ▸[0.9, 0.9]]")],
    &["the sides from corner 1 to 2 and from 3 to 1 cross or touch"]
)]
#[case::outside_the_grid(
    &[("to: [1, 1]", "to: [1, ▸0.8]")],
    &["the polygon extends to 0.9, but the grid ends at 0.8", "at least 0.9"]
)]
#[case::that_is_tiny(
    &[
        (CORNERS, "[[0.1, 0.1], [0.9, 0.1], [0.1, 0.1001]]"),
        ("A*bump(X, Y)*sin(pi*c*t)", "A*t + 0*bump(X, Y)"),
        ("-A/2*bump(X, Y)*sin(pi*c*t)", "A*t"),
        ("cells: [", "cells: [▸"),
    ],
    &["the body is smaller than a particle", "expected cells small enough"]
)]
#[case::in_space(
    &[("dimension: 2", "dimension: 3"), ("{polygon:", "{▸polygon:")],
    &["the scene is 3-D, but `polygon` is a body in 2-D", "`box` or `ball`"]
)]
#[case::with_keys(&[(CORNERS, "▸{corners: [[0, 0], [1, 0], [1, 1]]}")], &["list"])]
#[case::that_is_held(
    &[("  material:", "  boundary: {▸left: fixed}\n  material:")],
    &["`left` cannot be held: a body of kind `polygon` has free rims only"]
)]
#[case::that_is_loaded(
    &[("  material:", "  loads:\n    - pressure: {on: ▸left, value: 1}\n  material:")],
    &["`left` cannot be loaded: a body of kind `polygon` has free rims only"]
)]
#[case::under_traction(
    &[("[0.4, 0.9]]}", "[0.4, 0.89]]}"), ("displacement: [\"", "displacement: [▸\"")],
    &["boundary condition: the side from (0.95, 0.25) to (0.4, 0.89) is free, traction in X", "Pa (off by "]
)]
#[case::observed_beside_it(
    &[("\nexpect:", "\nobserve: {at: ▸[0.2, 0.7]}\n\nexpect:")],
    &["this point is outside the body", "expected a point in the polygon"]
)]
#[case::with_particles_that_are_moved(
    &[("\nexpect:", "\n▸particles: {shift: [0.25, 0]}\n\nexpect:")],
    &["`particles` is supported for boxes only"]
)]
fn a_polygon(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(TRIANGLE, edits, words);
}

#[test]
fn corners_may_be_listed_in_either_orientation() {
    let turned = TRIANGLE.replace(CORNERS, "[[0.4, 0.9], [0.95, 0.25], [0.1, 0.15]]");
    valid_suite(&turned);
}

const DISKS: &str = include_str!("../../../verification/contact-and-friction/two-disks.yaml");
const SECOND: &str = "- body: {disk: {centre: [0.8, 0.8], radius: R}}";

#[test]
fn a_corner_within_a_disk_is_refused() {
    let polygon = "- ▸body: {polygon: [[0.3, 0.3], [0.9, 0.3], [0.9, 0.9]]}";
    refused(DISKS, &[(SECOND, polygon)], &["body 1 and body 2 overlap"]);
}

/// The bounding boxes of the two bodies overlap, but the bodies do not.
#[test]
fn a_polygon_may_lie_around_a_disk() {
    let polygon = "- body: {polygon: [[0.1, 0.9], [0.9, 0.1], [0.9, 0.9]]}";
    assert!(DISKS.contains(SECOND));
    valid_suite(&DISKS.replace(SECOND, polygon));
}
