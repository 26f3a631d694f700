//! Heat, bodies at rest, and thermal expansion.

use super::{Edits, refused};
use crate::common::valid_suite;
use rstest::rstest;

/// A bar at rest that cools through one end.
const COOLED: &str = include_str!("../../../verification/heat/heat-convection.yaml");

/// A fin at rest, with a source that depends on the temperature.
const FIN: &str = include_str!("../../../verification/heat/thermal-fin.yaml");

/// A plate at rest with a manufactured temperature.
const PLATE: &str = include_str!("../../../verification/heat/heat-2d.yaml");

/// A bar that moves and is heated.
const MOVING: &str = include_str!("../../../verification/heat/thermal-expansion-mms.yaml");

/// A heated plate whose edges are fixed.
const HELD: &str = include_str!("../../../verification/heat/thermal-expansion-clamped.yaml");

const MODE: &str = "  temperature: \"Ta + 5*cos";
const RIGHT: &str = "boundary: {right: {convection: {coefficient: b, ambient: Ta}}}";
const SOURCE: &str = "source: \"-b*(T - Ta)/rho\"";
const METHOD: &str = "  - heat: {basis: [linear, cpgimp, quadratic_bspline, cubic_bspline]}";
const EXPANSION: &str = "    - thermal_expansion: {coefficient: alpha, reference: T0}";

#[rstest]
#[case::a_root_with_a_slip(
    &[("mu: 0.860333589019380", "mu: 0.860334"), ("temperature: \"Ta", "temperature: ▸\"Ta")],
    &["right is cooled by convection", "this is not a solution"]
)]
#[case::that_an_end_does_not_have(
    &[(RIGHT, "boundary: {right: {temperature: Ta}}"), ("temperature: \"Ta", "temperature: ▸\"Ta")],
    &["right has a given temperature", "K (off by "]
)]
#[case::that_lets_heat_out_of_an_insulated_end(
    &[(RIGHT, "boundary: {right: insulated}"), ("temperature: \"Ta", "temperature: ▸\"Ta")],
    &["right is insulated, but the heat inflow is another one", "W/m2 (off by "]
)]
#[case::of_a_ring_that_jumps(
    &[(RIGHT, "boundary: {}"), ("  material", "  boundary: {left: periodic, right: periodic}\n  material"), ("temperature: \"Ta", "temperature: ▸\"Ta")],
    &["left is periodic, but the temperature differs", "K (off by "]
)]
#[case::another_diffusivity(
    &[("c: 4 ", "c: 5 "), ("kappa: \"k/(rho*c)\"", "kappa: \"k/(rho*4)\""), ("temperature: \"Ta", "temperature: ▸\"Ta")],
    &["heat equation, rho0 c T_t = Div(k Grad T) + rho0 s", "W/kg"]
)]
#[case::another_start(
    &[("initial: \"Ta + 5*", "initial: \"Ta + 6*"), ("temperature: \"Ta", "temperature: ▸\"Ta")],
    &["initial condition T(X, 0) = T0(X)"]
)]
#[case::of_which_nothing_is_said(
    &[("exact:\n", "▸exact:\n"), ("  temperature: \"Ta + 5*cos(mu*X/L)*exp(-kappa*(mu/L)^2*t)\"\n", "  tolerance: 1e-8\n")],
    &["the scene has `heat`, but no temperature is stated"]
)]
fn a_temperature(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    // If no heat load is listed, the error points at `loads`.
    if words[0].starts_with("the scene has `heat`") {
        let edits = [("  loads:\n", "  ▸loads:\n"), edits[1]];
        return refused(COOLED, &edits, words);
    }
    refused(COOLED, edits, words);
}

#[rstest]
#[case::conductivity(&[("conductivity: k", "conductivity: ▸-1")], &["the conductivity is -1"])]
#[case::capacity(&[("capacity: c", "capacity: ▸0")], &["the heat capacity is 0"])]
#[case::coefficient(
    &[("coefficient: b,", "coefficient: ▸-2,")],
    &["the coefficient of convection is -2"]
)]
#[case::face(
    &[(RIGHT, "boundary: {▸top: insulated}")],
    &["a body of dimension 1 has no face `top`"]
)]
#[case::kind(
    &[(RIGHT, "boundary: {right: {▸heated: 3}}")],
    &["heated", "insulated", "temperature", "flux", "convection"]
)]
#[case::twice(
    &[("    - heat:\n", "    - heat: {conductivity: 1, capacity: 1}\n    - ▸heat:\n")],
    &["heat appears twice"]
)]
fn invalid_heat_keys_are_refused(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(COOLED, edits, words);
}

#[rstest]
#[case::of_another_fin(
    &[(SOURCE, "source: \"-2*b*(T - Ta)/rho\""), ("  temperature: \"Ta", "  temperature: ▸\"Ta")],
    &["heat equation, rho0 c T_t = Div(k Grad T) + rho0 s", "this is not a solution"]
)]
#[case::of_something_else(
    &[(SOURCE, "source: \"-b*(▸warmth - Ta)/rho\"")],
    &["unknown name `warmth`", "the variables are `X`, `t`, `T`"]
)]
#[case::of_a_temperature_of_its_own(
    &[("  Ta: 20", "  ▸T: 20\n  Ta: T")],
    &["`T` is a variable of formulas and cannot be declared", "the variables are X, t, T"]
)]
#[case::manufactured(
    &[("exact:\n", "manufactured:\n"), ("  temperature: \"Ta", "  ▸temperature: \"Ta")],
    &["the manufactured temperature defines the source: remove `source`"]
)]
fn a_source_of_the_temperature(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(FIN, edits, words);
}

/// Only heat sources may use the temperature `T`.
#[rstest]
#[case::start(&[(SOURCE, "initial: ▸T")])]
#[case::conductivity(&[("conductivity: k", "conductivity: k*▸T")])]
#[case::flux(&[("{left: {temperature: \"Ta + base\"}}", "{left: {flux: ▸T}}")])]
#[case::truth(&[("cosh(m*L) +", "cosh(m*L) + 0*▸T +")])]
fn no_temperature_exists(#[case] edits: Edits<'_>) {
    refused(FIN, edits, &["unknown name `T`"]);
}

/// If the source does not use `T`, a suite may declare its own `T`.
#[test]
fn source_without_temperature_may_use_the_name() {
    let own = COOLED.replace("  Ta: 20", "  T: 20\n  Ta: T");
    let sourced = own.replace("capacity: c\n", "capacity: c\n        source: 0*X\n");
    assert!(own != COOLED && sourced != own);
    valid_suite(&sourced);
}

#[rstest]
#[case::held(
    &[("  loads:\n", "  boundary: {▸left: fixed}\n  loads:\n")],
    &["the left face is fixed, but a `rigid` body does not move", "choose another material"]
)]
#[case::moving(
    &[("  loads:\n", "  ▸initial_velocity: [1]\n  loads:\n")],
    &["`initial_velocity` is not supported for a `rigid` body"]
)]
#[case::loaded(
    &[("  loads:\n", "  loads:\n    - ▸gravity: [1]\n")],
    &["this load is not supported for a `rigid` body"]
)]
#[case::with_a_method_of_motion(
    &[(METHOD, "  - ▸mpm: {basis: linear, transfer: flip, scheme: musl}")],
    &["a `rigid` body does not move", "`heat: {basis: linear}`"]
)]
#[case::judged_by_its_motion(
    &[("judge: {of: temperature}", "judge: {of: velocity}"), ("material: {rigid", "material: ▸{rigid")],
    &["the judged quantity needs a motion, but the body is `rigid`", "judge: {of: temperature}"]
)]
#[case::judged_by_default(
    &[("judge: {of: temperature}\n", ""), ("material: {rigid", "material: ▸{rigid")],
    &["the judged quantity needs a motion, but the body is `rigid`", "judge: {of: temperature}"]
)]
#[case::observed(
    &[("methods:\n", "▸observe: {at: [0]}\nmethods:\n")],
    &["this key needs a motion, but the body is `rigid`"]
)]
#[case::with_a_displacement(
    &[(MODE, "  ▸displacement: [X*t]\n  temperature: \"Ta + 5*cos")],
    &["this key needs a motion, but the body is `rigid`"]
)]
#[case::whose_sums_drift(
    &[("    order: [1.95, 2.05]\n", "    order: [1.95, 2.05]\n    ▸drift: {mass: 1e-9}\n")],
    &["a body at rest has no motion whose sums could drift"]
)]
fn a_body_at_rest(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(COOLED, edits, words);
}

#[rstest]
#[case::with_a_source_besides(
    &[("        capacity: c\n", "        capacity: c\n        source: 1\n"), ("  temperature: \"T0", "  ▸temperature: \"T0")],
    &["the manufactured temperature defines the source: remove `source`"]
)]
#[case::of_an_edge(
    &[("bottom: {flux: \"-k*", "bottom: {flux: \"k*"), ("  temperature: \"T0", "  temperature: ▸\"T0")],
    &["bottom has a given flux"]
)]
#[case::in_a_disk(
    &[("body: {box: {from: [0, 0], to: [1, 1]}}", "body: {disk: {centre: [0, 0], radius: 1}}"), ("    - heat:", "    - ▸heat:")],
    &["heat is supported in a `box` only, but the body is of kind `disk`"]
)]
#[case::with_cells_that_do_not_fit(
    &[("to: [1, 1]}}", "to: [1, 0.9]}}"), ("cells: [4,", "cells: [▸4,"), ("+ w(X, t)*sin(Y + 1/2)", "+ 0*w(X, t)*Y")],
    &["the top face, which is at rest", "expected a cell size that divides the length"]
)]
fn a_manufactured_plate(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    if words[0].starts_with("the top face") {
        let still = [
            ("bottom: {flux: \"-k*w(X, t)*cos(1/2)\"}", "bottom: insulated"),
            (
                "top: {convection: {coefficient: b, ambient: \"T0 + w(X, t)*(sin(3/2) + k/b*cos(3/2))\"}}",
                "top: {convection: {coefficient: b, ambient: T0}}",
            ),
        ];
        return refused(PLATE, &[edits, &still].concat(), words);
    }
    refused(PLATE, edits, words);
}

#[rstest]
#[case::free(
    &[("right: fixed}", "top: fixed}"), ("boundary: {left: fixed, top: fixed}", "boundary: {left: fixed}"), ("          right: {conv", "          ▸right: {conv")],
    &["the right face is free, but heat can enter only at a face of the grid", "leave it insulated"]
)]
#[case::in_the_total_lagrangian_frame(
    &[("quadratic_bspline], transfer: flip, scheme: musl}", "quadratic_bspline], transfer: flip, scheme: musl, frame: ▸total_lagrangian}")],
    &["`total_lagrangian` does not support heat"]
)]
#[case::with_sums_over_cells(
    &[("quadratic_bspline], transfer: flip", "quadratic_bspline], transfer: ▸tls")],
    &["a transfer that integrates over cells does not support heat"]
)]
#[case::by_finite_elements(
    &[("  - mpm: {basis: [linear, cpgimp, quadratic_bspline], transfer: flip, scheme: musl}", "  - ▸fem: {element: linear, mass: lumped}")],
    &["the built-in FEM does not support heat"]
)]
#[case::by_the_method_of_bodies_at_rest(
    &[("  - mpm: {basis: [linear, cpgimp, quadratic_bspline], transfer: flip, scheme: musl}", "  - ▸heat: {basis: linear}")],
    &["a `neo_hookean` body moves", "use `mpm`"]
)]
#[case::without_a_displacement(
    &[("  displacement: [\"A*sin(pi*X)*sin(w*t)\"]\n", ""), ("\nmanufactured:", "\n▸manufactured:")],
    &["a body that moves needs a `displacement`"]
)]
fn a_body_that_moves(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(MOVING, edits, words);
}

/// The error points at the entry of the effect.
#[test]
fn thermal_expansion_needs_heat() {
    let (start, end) = (MOVING.find("    - heat:").unwrap(), MOVING.find(EXPANSION).unwrap());
    let heat = &MOVING[start..end];
    let marked = "    - ▸thermal_expansion: {coefficient: alpha, reference: T0}";
    let edits = [(heat, ""), (EXPANSION, marked)];
    refused(MOVING, &edits, &["`thermal_expansion` needs `heat`, which is not listed"]);
}

#[rstest]
#[case::twice(
    &[(EXPANSION, "    - thermal_expansion: {coefficient: alpha, reference: T0}\n    - ▸thermal_expansion: {coefficient: 1, reference: 0}")],
    &["thermal expansion appears twice"]
)]
#[case::in_a_plane_that_is_held_across(
    &[("poisson: 0, density", "poisson: 0.3, density"), (EXPANSION, "    - ▸thermal_expansion: {coefficient: alpha, reference: T0}")],
    &["in 1-D `thermal_expansion` of a `neo_hookean` body needs a Poisson's ratio of 0"]
)]
#[case::of_a_fluid(
    &[("neo_hookean: {young: E, poisson: 0, density: rho}", "newtonian: {bulk: E, viscosity: 1, density: rho}"), (EXPANSION, "    - ▸thermal_expansion: {coefficient: alpha, reference: T0}")],
    &["`thermal_expansion` does not support the law `newtonian`"]
)]
fn thermal_expansion(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(MOVING, edits, words);
}

/// A free edge has no traction. A heated plate that does not move would have one.
#[test]
fn the_expansion_is_part_of_the_equation_of_motion() {
    let edits = [
        ("bottom: fixed, top: fixed}", "bottom: fixed}"),
        ("displacement: [0, 0]", "displacement: [▸0, 0]"),
    ];
    refused(HELD, &edits, &["top is free, traction in Y"]);
}
