//! Bodies with four straight sides: invalid corners, faces that are not sides, and keys that
//! require another body.

use super::samples::PLATE;
use super::{Edits, refused};
use rstest::rstest;

const COOK: &str = include_str!("../../../verification/equilibrium/cooks-membrane.yaml");

#[rstest]
#[case::of_three_corners(
    &[("corners: [[0, 0], ", "corners: ▸[")], &["a quadrilateral of 3 corners", "expected four"]
)]
#[case::of_corners_clockwise(
    &[("[[0, 0], [48, 44], [48, 60], [0, 44]]", "[▸[0, 0], [0, 44], [48, 60], [48, 44]]")],
    &["at corner 1 the sides do not turn to the left", "counter-clockwise"]
)]
#[case::with_a_corner_on_a_side(
    &[("[48, 44], [48, 60]", "▸[24, 30], [48, 60]")], &["at corner 2 the sides do not turn"]
)]
#[case::with_one_corner_twice(
    &[("[48, 60], [0, 44]", "[48, 60], ▸[48, 60]")], &["corners 3 and 4 are 0 m apart"]
)]
#[case::that_reaches_nowhere(
    &[("[48, 60]", "▸[48, 1e40]")], &["corners 1 and 3 are", "expected a distance"]
)]
#[case::with_a_corner_in_space(&[("[48, 60]", "▸[48, 60, 0]")], &["2"])]
#[case::in_space(
    &[("dimension: 2", "dimension: 3"), ("{quadrilateral:", "{▸quadrilateral:")],
    &["the scene is 3-D, but `quadrilateral` is a body in 2-D", "`box` or `ball`"]
)]
#[case::held_where_it_has_a_corner(
    &[("{left: fixed}", "{left: fixed, ▸top: fixed}")],
    &["no side of the quadrilateral lies on its `top` face"]
)]
#[case::loaded_where_it_has_a_corner(
    &[("{on: right,", "{on: ▸bottom,")],
    &["no side of the quadrilateral lies on its `bottom` face"]
)]
#[case::loaded_where_its_side_leans(
    &[("[48, 44], ", "[40, 40], "), ("{on: right,", "{on: ▸right,")],
    &["no side of the quadrilateral lies on its `right` face"]
)]
#[case::loaded_on_no_face(&[("{on: right,", "{on: ▸rigth,")], &["`rigth`", "did you mean `right`?"])]
#[case::without_an_end(
    &[("{left: fixed}", "{▸left: periodic, right: periodic}")], &["a quadrilateral cannot have periodic faces"]
)]
#[case::with_a_word_unknown(&[("corners:", "▸corner:")], &["corner"])]
fn a_panel(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(COOK, edits, words);
}

const PANEL: (&str, &str) = (
    "body: {box: {from: [0, 0], to: [1, 0.5]}}",
    "body: {quadrilateral: {corners: [[0, 0], [1, 0], [1, 0.5], [0, 0.6]]}}",
);

#[test]
fn a_panel_has_no_checked_solution() {
    let edits = [PANEL, ("exact:", "▸exact:")];
    refused(PLATE, &edits, &["a solution can be checked in a box or a body with a free rim"]);
}
