//! Polygons: invalid corners, names of faces that a polygon does not have, and keys that need
//! another body.

use super::refuse_all;
use crate::common::valid_suite;

const TRIANGLE: &str =
    include_str!("../../../verification/bodies-at-large-strain/mms-polygon.yaml");
const CORNERS: &str = "[[0.1, 0.15], [0.95, 0.25], [0.4, 0.9]]";

#[test]
fn mistakes_are_refused() {
    refuse_all(MISTAKES);
}

const MISTAKES: &str = r#"
@mms-polygon
[[0.1, 0.15], [0.95, 0.25], [0.4, 0.9]] → ▸[[0.1, 0.1], [0.95, 0.25]]
⇒ a polygon of 2 corners … expected 3 to 100
[0.95, 0.25] → ▸[0.95, 0.25, 0] ⇒ 3 components in a scene of dimension 2 … expected 2
[0.95, 0.25] → ▸0.9 ⇒ 0.9 … list
[0.95, 0.25] → [0.9, ▸"1/0"] ⇒ finite
[0.4, 0.9] → [0.4, 0.9], ▸[0.95, 0.25] ⇒ corners 2 and 4 are 0 m apart … expected a distance from
[[0.1, 0.15], [0.95, 0.25], [0.4, 0.9]] → [[0.1, 0.1], [0.9, 0.8], ▸[0.9, 0.1], [0.1, 0.8]]
⇒ the sides from corner 1 to 2 and from 3 to 4 cross or touch … in their order around
[[0.1, 0.15], [0.95, 0.25], [0.4, 0.9]] → [[0.1, 0.1], ▸[0.9, 0.1], [0.5, 0.1], [0.5, 0.8]]
⇒ the sides from corner 1 to 2 and from 2 to 3 cross or touch
[[0.1, 0.15], [0.95, 0.25], [0.4, 0.9]] → [[0.1, 0.1], [0.5, 0.5], ▸[0.9, 0.9]]
⇒ the sides from corner 1 to 2 and from 3 to 1 cross or touch
to: [1, 1] → to: [1, ▸0.8] ⇒ the polygon extends to 0.9, but the grid ends at 0.8 … at least 0.9
[[0.1, 0.15], [0.95, 0.25], [0.4, 0.9]] → [[0.1, 0.1], [0.9, 0.1], [0.1, 0.1001]]
A*bump(X, Y)*sin(pi*c*t) → A*t + 0*bump(X, Y)
-A/2*bump(X, Y)*sin(pi*c*t) → A*t
cells: [ → cells: [▸
⇒ the body is smaller than a particle … expected cells small enough
dimension: 2 → dimension: 3
{polygon: → {▸polygon:
⇒ the scene is 3-D, but `polygon` is a body in 2-D … `box` or `ball`
[[0.1, 0.15], [0.95, 0.25], [0.4, 0.9]] → ▸{corners: [[0, 0], [1, 0], [1, 1]]} ⇒ list
material: → boundary: {▸left: fixed}\n  material:
⇒ `left` cannot be held: a body of kind `polygon` has free rims only
material: → loads:\n    - pressure: {on: ▸left, value: 1}\n  material:
⇒ `left` cannot be loaded: a body of kind `polygon` has free rims only
[0.4, 0.9]]} → [0.4, 0.89]]}
displacement: [" → displacement: [▸"
⇒ boundary condition: the side from (0.95, 0.25) to (0.4, 0.89) is free, traction in X … Pa (off by
expect: → observe: {at: ▸[0.2, 0.7]}\n\nexpect:
⇒ this point is outside the body … expected a point in the polygon
expect: → ▸particles: {shift: [0.25, 0]}\n\nexpect: ⇒ `particles` is supported for boxes only
@two-disks
body: {disk: {centre: [0.8, 0.8], radius: R} → ▸body: {polygon: [[0.3, 0.3], [0.9, 0.3], [0.9, 0.9]]
⇒ body 1 and body 2 overlap
# Bodies with four straight sides: invalid corners, faces that are not sides, and keys that require
# another body.
@cooks-membrane
corners: [[0, 0], [ → corners: ▸[[ ⇒ a quadrilateral of 3 corners … expected four
[[0, 0], [48, 44], [48, 60], [0, 44]] → [▸[0, 0], [0, 44], [48, 60], [48, 44]]
⇒ at corner 1 the sides do not turn to the left … counter-clockwise
[48, 44], [48, 60] → ▸[24, 30], [48, 60] ⇒ at corner 2 the sides do not turn
[48, 60], [0, 44] → [48, 60], ▸[48, 60] ⇒ corners 3 and 4 are 0 m apart
[48, 60] → ▸[48, 1e40] ⇒ corners 1 and 3 are … expected a distance
[48, 60] → ▸[48, 60, 0] ⇒ 2
dimension: 2 → dimension: 3
{quadrilateral: → {▸quadrilateral:
⇒ the scene is 3-D, but `quadrilateral` is a body in 2-D … `box` or `ball`
{left: fixed} → {left: fixed, ▸top: fixed} ⇒ no side of the quadrilateral lies on its `top` face
{on: right, → {on: ▸bottom, ⇒ no side of the quadrilateral lies on its `bottom` face
[48, 44], → [40, 40],
{on: right, → {on: ▸right,
⇒ no side of the quadrilateral lies on its `right` face
{on: right, → {on: ▸rigth, ⇒ `rigth` … did you mean `right`?
{left: fixed} → {▸left: periodic, right: periodic} ⇒ a quadrilateral cannot have periodic faces
corners: → ▸corner: ⇒ corner
@plate
box: {from: [0, 0], to: [1, 0.5 → quadrilateral: {corners: [[0, 0], [1, 0], [1, 0.5], [0, 0.6]
exact: → ▸exact:
⇒ a solution can be checked in a box or a body with a free rim
"#;

#[test]
fn corners_may_be_listed_in_either_orientation() {
    let turned = TRIANGLE.replace(CORNERS, "[[0.4, 0.9], [0.95, 0.25], [0.1, 0.15]]");
    valid_suite(&turned);
}

const DISKS: &str = include_str!("../../../verification/contact-and-friction/two-disks.yaml");
const SECOND: &str = "- body: {disk: {centre: [0.8, 0.8], radius: R}}";

/// The bounding boxes of the two bodies overlap, but the bodies do not.
#[test]
fn a_polygon_may_lie_around_a_disk() {
    let polygon = "- body: {polygon: [[0.1, 0.9], [0.9, 0.1], [0.9, 0.9]]}";
    assert!(DISKS.contains(SECOND));
    valid_suite(&DISKS.replace(SECOND, polygon));
}
