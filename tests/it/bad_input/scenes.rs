//! Bodies, grids, loads, references and the observed point.

use super::samples::{BAR, COLUMN, PLATE, PULLED};
use super::{Edits, refused};
use rstest::rstest;

#[rstest]
#[case::a_body_without_length(&[("to: [L]", "to: [▸0]")], &["the box ends at 0 and starts at 0", "above that of `from`"])]
#[case::a_body_longer_than_numbers(
    &[("from: [0], to: [L]", "from: [-1e308], to: [▸1e308]")],
    &["the box is inf m long", "expected a length from 1e-30 to 1e30"]
)]
#[case::a_corner_with_two_components(
    &[("from: [0], to: [L]", "from: ▸[0, 0], to: [L]")],
    &["2 components in a scene of dimension 1", "expected 1"]
)]
#[case::a_velocity_with_two_components(
    &[("[\"v0*mode(X)\"]", "▸[\"v0*mode(X)\", 0]")],
    &["2 components in a scene of dimension 1", "expected 1"]
)]
#[case::a_deformed_start_of_a_law_with_a_history(
    &[
        ("linear_elastic: {young: E, poisson: 0", "j2: {young: E, poisson: 0, yield: 1"),
        ("  initial_velocity:", "  ▸initial_displacement: [0]\n  initial_velocity:"),
    ],
    &["a `j2` body cannot start deformed", "plastic flow depends on the whole history"]
)]
#[case::a_displacement_with_two_components(
    &[("  initial_velocity:", "  initial_displacement: ▸[0, 0]\n  initial_velocity:")],
    &["2 components in a scene of dimension 1", "expected 1"]
)]
#[case::a_grid_the_wrong_way_round(&[("to: [L + 5]", "to: [▸-5]")], &["the box ends at -5 and starts at 0"])]
#[case::a_body_that_sticks_out_of_the_grid(
    &[("to: [L + 5]", "to: [▸L - 5]")],
    &["the body's right face at 25 is outside the grid, which ends at 20", "expected at least 25"]
)]
#[case::a_fixed_face_inside_the_grid(
    &[("grid: {from: [0]", "grid: {from: [▸-1]")],
    &["the left face at 0 is fixed, but the grid ends at -1", "expected exactly 0"]
)]
#[case::a_traction_on_a_fixed_face(
    &[("  boundary: {left: fixed}", "  boundary: {left: fixed}\n  loads: [{traction: {on: ▸left, value: [1]}}]")],
    &["the face `left` is fixed"]
)]
#[case::an_observer_with_two_coordinates(
    &[("at: [12.5]", "at: ▸[12.5, 1]")],
    &["2 components in a scene of dimension 1", "expected 1"]
)]
#[case::an_observer_without_coordinates(&[("at: [12.5]", "at: ▸[]")], &["0 components", "expected 1"])]
#[case::an_observer_outside_the_body(
    &[("at: [12.5]", "at: [▸30]")],
    &["30 is outside the body", "expected a number from 0 to 25"]
)]
#[case::particles_without_a_number_of_them(
    &[(", ppc: 4", ""), ("- mpm:", "- ▸mpm:")],
    &["MPM needs particles, but `refine` has no `ppc`", "add `ppc: 4` to `refine`"]
)]
#[case::no_truth(
    &[
        ("suite: bar", "▸suite: bar"),
        ("exact:\n  equation: small_strain\n  displacement: [\"v0/omega*mode(X)*sin(omega*t)\"]\n", ""),
    ],
    &["a convergence study needs `exact`, `manufactured`, `equilibrium` or `reference`"]
)]
#[case::a_formula_for_another_equation(
    &[("small_strain", "▸log_strain")],
    &["a formula is checked against `small_strain`, `neo_hookean`, `hencky` or `corotated` only", "give other equations a `reference`"]
)]
fn a_bar_with(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(BAR, edits, words);
}

#[rstest]
#[case::a_method_for_one_dimension(
    &[("  - mpm:", "  - ▸fem: {element: linear, mass: lumped}\n  - mpm:")],
    &["the built-in FEM is 1-D, but the scene is 2-D"]
)]
#[case::a_reference_for_one_dimension(
    &[("run:", "▸reference:\n  equation: small_strain\n  fem: {element: linear, mass: lumped, cells: 100, dt: 1e-3}\nrun:")],
    &["the built-in FEM is 1-D, but the scene is 2-D", "give this scene an `exact` solution"]
)]
#[case::a_fixed_face_between_nodes(
    &[
        ("omega: \"5*pi\"", "omega: \"10*pi/1.1\""),
        ("to: [1, 0.5]", "to: [0.5, 1.1]"),
        ("{left: fixed}", "{bottom: fixed, top: fixed}"),
        ("[\"sin(pi*X/2)\", 0]", "[0, \"sin(pi*Y/1.1)\"]"),
        ("[\"sin(pi*X/2)*sin(omega*t)/omega\", 0]", "[0, \"sin(pi*Y/1.1)*sin(omega*t)/omega\"]"),
        ("[4, 8]", "[5, ▸8]"),
    ],
    &[
        "with 8 cells along the first axis the top face, which is fixed, is at 1.1",
        "but the nearest nodes are at 1.125",
        "expected a cell size that divides the length, not 0.0625 m",
    ]
)]
fn a_plate_with(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(PLATE, edits, words);
}

#[test]
fn gravity_twice() {
    let edit = ("    - gravity: [\"-g\"]\n", "    - gravity: [\"-g\"]\n    - gravity: ▸[\"-g\"]\n");
    refused(COLUMN, &[edit], &["gravity appears twice"]);
}

#[test]
fn two_tractions_on_one_face() {
    let load = "    - traction: {on: right, value: [p0]}\n";
    let twice = format!("{load}{}", load.replace("right", "▸right"));
    refused(PULLED, &[(load, &twice)], &["the face `right` already has a traction"]);
}

const BENT: &str = include_str!("../../../verification/loads/bending-bar.yaml");

#[rstest]
#[case::at_nowhere(
    &[("at: surface}\n    - pressure", "at: ▸rim}\n    - pressure")],
    &["unknown name `rim`", "`particles`", "`surface`"]
)]
#[case::beside_another_load(
    &[("on: left", "on: ▸right")],
    &["the face `right` already has a pressure"]
)]
#[case::on_the_base(&[("on: left", "on: ▸bottom")], &["the face `bottom` is fixed"])]
#[case::with_a_direction(
    &[("\"-across(stretch(-w, t))/stretch(-w, t)\"", "▸[0, 0]")],
    &["expected a finite number or a formula, found a list"]
)]
#[case::of_something_else(&[("stretch(-w, t)\", at", "stretch(-w, ▸s)\", at")], &["`s`"])]
#[case::of_another_size(
    &[("stretch(-w, t)\", at", "stretch(w, t)\", at"), ("- \"X*(cos", "- ▸\"X*(cos")],
    &["boundary condition: left is under pressure, traction in X", "this is not a solution"]
)]
#[case::of_another_place(
    &[("along(stretch(X, t))*cos", "along(stretch(w, t))*cos"), ("- \"X*(cos", "- ▸\"X*(cos")],
    &["boundary condition: top is loaded, traction in Y", "this is not a solution"]
)]
fn a_load_on_a_surface(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(BENT, edits, words);
}
