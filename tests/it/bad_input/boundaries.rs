//! Boundary conditions and loads on sets: unknown keys, and motions that violate them.

use super::samples::{BAR, PLATE};
use super::{Edits, refused};
use crate::common::{edited, valid_suite};
use rstest::rstest;

/// A periodic bar.
const RING: &str = r#"suite: ring
title: Periodic bar
source: a textbook

parameters:
  A: 0.01

scene:
  dimension: 1
  body: {box: {from: [0], to: [1]}}
  material: {neo_hookean: {young: 100, poisson: 0, density: 1}}
  boundary: {left: periodic, right: periodic}

manufactured:
  displacement: ["A*sin(2*pi*X)*sin(pi*t)"]

run: {until: 0.5, dt: 1e-3}
refine: {cells: [5, 10], ppc: 2}

methods:
  - mpm: {basis: linear, transfer: flip, scheme: musl}

expect:
  - verdict: too_few_levels
    because: two levels support no claim
"#;

/// A block that slides down a slope.
const SLOPE: &str = include_str!("../../../verification/contact-and-friction/sliding-block.yaml");

/// A square between rollers, with a set of particles whose velocity is prescribed.
const SQUARE: &str = r#"suite: square
title: Square between rollers
source: a textbook

parameters:
  A: 0.01

scene:
  dimension: 2
  body: {box: {from: [0, 0], to: [1, 1]}}
  material: {neo_hookean: {young: 100, poisson: 0.3, density: 1}}
  boundary: {left: roller, right: roller, bottom: roller, top: roller}
  sets: {middle: {box: {from: [0.4, 0.4], to: [0.6, 0.6]}}}
  loads:
    - velocity: {on: middle, value: ["A*pi*sin(pi*X)*cos(pi*t)", "A*pi*sin(pi*Y)*cos(pi*t)"]}

manufactured:
  displacement: ["A*sin(pi*X)*sin(pi*t)", "A*sin(pi*Y)*sin(pi*t)"]

run: {until: 0.5, dt: 1e-3}
refine: {cells: [4, 8], ppc: 4}

methods:
  - mpm: {basis: linear, transfer: flip, scheme: musl}

expect:
  - verdict: too_few_levels
    because: two levels support no claim
"#;

/// Changes the ring: it is stretched to the length of a longer grid.
const STRETCHED: Edits<'_> = &[
    ("A: 0.01", "V: 2"),
    ("  material", "  grid: {from: [0], to: [1.2]}\n  material"),
    ("manufactured:", "exact:\n  equation: neo_hookean"),
    ("A*sin(2*pi*X)*sin(pi*t)", "0.2*X + V*t"),
];

/// Changes the vibrating bar: the motion of its far end is prescribed.
const DRIVEN: Edits<'_> = &[
    ("grid: {from: [0], to: [L + 5]}", "grid: {from: [0], to: [L]}"),
    ("{left: fixed}", "{left: roller, right: {velocity: [\"v0*mode(X)*cos(omega*t)\"]}}"),
    ("  - fem: {element: linear, mass: lumped}\n", ""),
    (
        "  - case: \"fem-*\"\n    verdict: too_few_levels\n    because: two levels support no claim\n",
        "",
    ),
];

/// Changes a column under gravity: its weight becomes a force on a set of all particles.
const PUSHED: Edits<'_> = &[
    ("gravity: [\"-g\"]", "force: {on: all, value: [\"-rho*g*H\"]}"),
    ("  loads:", "  sets: {all: {box: {from: [-1], to: [2]}}}\n  loads:"),
];

#[rstest]
#[case::a_ring(RING, &[])]
#[case::a_stretched_ring(RING, STRETCHED)]
#[case::a_square_between_rollers(SQUARE, &[])]
#[case::a_driven_bar(BAR, DRIVEN)]
#[case::a_roller_in_one_dimension(BAR, &[("left: fixed", "left: roller")])]
#[case::a_plate_on_rollers(PLATE, &[("{left: fixed}", "{left: roller, bottom: roller, top: roller}")])]
#[case::a_plate_without_ends_across(PLATE, &[("{left: fixed}", "{left: fixed, bottom: periodic, top: periodic}")])]
fn sound(#[case] text: &str, #[case] edits: Edits<'_>) {
    valid_suite(&edited(text, edits));
}

#[rstest]
#[case::negative_friction(
    SLOPE,
    &[("bottom: {friction: mu}", "bottom: {friction: ▸-mu}")],
    &["the coefficient of friction is -0.267949", "expected zero or a positive number"]
)]
#[case::a_kind_of_friction_that_nobody_knows(
    SLOPE,
    &[("bottom: {friction: mu}", "bottom: {▸rub: mu}")],
    &["unknown", "`friction`"]
)]
#[case::friction_without_rows_for_held_nodes(
    SLOPE,
    &[("start: at_zero}", "start: at_zero, mass: ▸consistent}")],
    &["`friction` needs a lumped mass matrix"]
)]
#[case::a_bar_for_the_fem(
    BAR,
    &[("{left: fixed}", "{left: ▸{friction: 0.1}}")],
    &["the left face has friction, but the built-in FEM supports only fixed and free ends"]
)]
#[case::less_friction_than_the_motion_needs(
    SLOPE,
    &[("{friction: mu}", "{friction: 0.99*mu}"), ("- \"slide*t", "- ▸\"slide*t")],
    &["the traction in X on the friction wall `bottom` does not have the value that opposes the velocity"]
)]
#[case::one_periodic_face(
    RING,
    &[("left: periodic, right: periodic", "left: ▸periodic")],
    &["the left face is periodic, but the right face is free", "expected `right: periodic` as well"]
)]
#[case::a_periodic_face_opposite_a_wall(
    RING,
    &[("left: periodic, right: periodic", "left: fixed, right: ▸periodic")],
    &["the right face is periodic, but the left face is fixed"]
)]
#[case::a_grid_that_goes_on_behind_a_periodic_face(
    PLATE,
    &[("{left: fixed}", "{left: fixed, bottom: periodic, top: periodic}"), ("  material", "  grid: {from: [0, 0], to: [1, ▸1]}\n  material")],
    &["the top face at 0.5 is periodic, but the grid ends at 1", "expected exactly 0.5"]
)]
#[case::cells_that_do_not_fit_between_periodic_faces(
    PLATE,
    &[("to: [1, 0.5]", "to: [1, 0.45]"), ("{left: fixed}", "{left: fixed, bottom: periodic, top: periodic}"), ("[4, 8]", "[▸4, 8]")],
    &["the top face, which is periodic, is at 0.45, but the nearest nodes are at 0.5"]
)]
#[case::a_condition_that_nobody_knows(RING, &[("left: periodic", "left: ▸periodical")], &["unknown name `periodical`", "did you mean `periodic`?"])]
#[case::a_velocity_with_two_components(
    RING,
    &[("left: periodic", "left: {velocity: ▸[0, 0]}")],
    &["2 components in a scene of dimension 1"]
)]
#[case::a_velocity_without_components(RING, &[("left: periodic", "left: ▸velocity")], &["velocity"])]
#[case::a_traction_on_a_roller(
    SQUARE,
    &[("loads:\n", "loads:\n    - traction: {on: ▸top, value: [1, 0]}\n")],
    &["the face `top` is a roller"]
)]
#[case::a_pressure_on_a_set(
    SQUARE,
    &[("loads:\n", "loads:\n    - pressure: {on: ▸middle, value: 1}\n")],
    &["`middle` is a set, but a pressure acts on a face"]
)]
#[case::a_traction_on_a_set(
    SQUARE,
    &[("loads:\n", "loads:\n    - traction: {on: ▸middle, value: [1, 0]}\n")],
    &["`middle` is a set, but a traction acts on a face", "give the total force: `force: {on: middle, value: [...]}`"]
)]
#[case::a_force_on_a_set_that_is_not_there(
    SQUARE,
    &[("loads:\n", "loads:\n    - force: {on: ▸midle, value: [1, 0]}\n")],
    &["there is no set `midle`", "did you mean `middle`?"]
)]
#[case::a_force_where_no_set_is(
    RING,
    &[("boundary", "loads: [{force: {on: ▸tip, value: [1]}}]\n  boundary")],
    &["there is no set `tip`", "declare it: `sets: {tip: {box: {from: [...], to: [...]}}}`"]
)]
#[case::two_loads_on_one_set(
    SQUARE,
    &[("loads:\n", "loads:\n    - force: {on: middle, value: [1, 0]}\n"), ("{on: middle, value: [\"", "{on: ▸middle, value: [\"")],
    &["the set `middle` already has a force"]
)]
#[case::a_set_that_nothing_acts_on(
    SQUARE,
    &[("{middle:", "{▸other: {box: {from: [0, 0], to: [1, 1]}}, middle:")],
    &["the set `other` is never used"]
)]
#[case::a_set_with_the_name_of_a_face(SQUARE, &[("{middle:", "{▸top:")], &["`top` is the name of a face"])]
#[case::a_set_beside_the_body(
    SQUARE,
    &[("from: [0.4, 0.4], to: [0.6, 0.6]", "from: [0.4, ▸1.4], to: [0.6, 1.6]")],
    &["the set `middle` from 1.4 to 1.6 is outside the body", "the body is from 0 to 1"]
)]
#[case::a_set_between_particles(
    SQUARE,
    &[("from: [0.4, 0.4], to: [0.6, 0.6]", "from: [0.45, 0.45], to: [0.55, 0.55]"), ("[4, 8]", "[▸4, 8]")],
    &["with 4 cells along the first axis the set `middle` contains no particle", "expected more cells"]
)]
#[case::a_ring_for_the_fem(
    RING,
    &[("left: periodic", "left: ▸periodic"), ("  - mpm:", "  - fem: {element: linear, mass: lumped}\n  - mpm:")],
    &["the left face is periodic, but the built-in FEM supports only fixed and free ends"]
)]
#[case::a_driven_end_for_the_fem(
    BAR,
    &[("{left: fixed}", "{left: ▸{velocity: [\"v0*t\"]}}")],
    &["the left face has a given velocity, but the built-in FEM supports only fixed and free ends"]
)]
#[case::a_driven_set_for_the_fem(
    BAR,
    &[("  boundary", "  sets: {▸tip: {box: {from: [0], to: [L]}}}\n  loads: [{velocity: {on: tip, value: [v0]}}]\n  boundary")],
    &["the set `tip` has a given velocity, which the built-in FEM does not support"]
)]
fn a_scene_with(#[case] sound: &str, #[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(sound, edits, words);
}

#[rstest]
#[case::a_motion_that_is_not_periodic(
    RING,
    &[("[\"A*sin(2*pi*X)", "[▸\"A*sin(1.5*pi*X)")],
    &["boundary condition: left is periodic, but x_X does not differ by one period from that on the opposite face at X = ("]
)]
#[case::a_motion_with_a_kink_at_the_seam(
    RING,
    &[("[\"A*sin(2*pi*X)", "[▸\"A*sin(pi*X)")],
    &["boundary condition: left is periodic, but du_X/dX differs from that on the opposite face at X = ("]
)]
#[case::a_motion_through_a_roller(
    SQUARE,
    &[("[\"A*sin(pi*X)*sin(pi*t)", "[▸\"A*sin(2*X)*sin(pi*t)"), ("[\"A*pi*sin(pi*X)*cos", "[\"A*pi*sin(2*X)*cos")],
    &["boundary condition: right is a roller, u_X = 0"]
)]
#[case::a_roller_that_is_dragged(
    SQUARE,
    &[("[\"A*sin(pi*X)*sin(pi*t)", "[▸\"A*sin(pi*X)*(1 + Y)*sin(pi*t)"), ("[\"A*pi*sin(pi*X)*cos", "[\"A*pi*sin(pi*X)*(1 + Y)*cos")],
    &["boundary condition: bottom is a roller, traction in X"]
)]
#[case::a_set_with_another_velocity(
    SQUARE,
    &[("value: [\"A*pi*", "value: [\"2*A*pi*"), ("[\"A*sin(pi*X)*sin(pi*t)", "[▸\"A*sin(pi*X)*sin(pi*t)")],
    &["given velocity of the set middle in X"]
)]
fn a_motion(#[case] sound: &str, #[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(sound, edits, words);
}

#[test]
fn prescribed_velocity_must_agree_with_the_motion() {
    let wrong = edited(BAR, DRIVEN)
        .replace("{velocity: [\"v0*", "{velocity: [\"1.01*v0*")
        .replace("[\"v0/omega*", "[▸\"v0/omega*");
    refused(&wrong, &[], &["boundary condition: velocity of right in X", "m/s (off by "]);
}

/// A force on the whole body is equivalent to gravity, for the solution and for both solvers. A
/// force on half of the body is another problem.
#[test]
fn a_force_on_a_set_enters_the_equation_of_motion() {
    let column = include_str!("../../../verification/the-talk/fem-oedometer.yaml");
    let right = edited(column, PUSHED);
    valid_suite(&right);
    let half = right
        .replace("to: [2]}}}", "to: [0.5]}}}")
        .replace("    - \"fall(t) -", "    - ▸\"fall(t) -");
    refused(&half, &[], &["equation of motion in X, rho0 u_tt = Div P + rho0 b"]);
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
    refused(&edited(RING, STRETCHED), &[(right, wrong)], &[words]);
}
