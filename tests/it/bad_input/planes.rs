//! What the state across the plane of two dimensions does not go with.

use super::samples::{BAR, CUBE};
use super::{Edits, refused};
use rstest::rstest;

const WAVE: &str = include_str!("../../../verification/plane-stress-wave.yaml");
const PULL: &str = include_str!("../../../verification/plane-stress-pull.yaml");

const LAW: &str = "linear_elastic: {young: E, poisson: nu,";
const FACES: &str = "  boundary: {left: roller, right: roller, bottom: roller, top: roller}\n";

#[rstest]
#[case::no_name_of_a_state(
    &[("plane: stress", "plane: ▸stretch")],
    &["unknown name `stretch`", "`strain`", "`stress`"]
)]
#[case::a_law_that_is_not_known_in_it(
    &[(LAW, "▸j2: {young: E, poisson: nu, yield: 1,")],
    &["the law `j2` is not known in plane stress, where sigma_33 = 0", "take `linear_elastic`"]
)]
#[case::the_wave_of_plane_strain(
    &[
        ("sqrt(E/((1 - nu^2)*rho))", "sqrt(E*(1 - nu)/((1 + nu)*(1 - 2*nu)*rho))"),
        ("- \"v0/omega*sin(pi*X/L)", "- ▸\"v0/omega*sin(pi*X/L)"),
    ],
    &["equation of motion in X", "this is not a solution"]
)]
#[case::plane_strain_with_the_wave_of_a_plate(
    &[("plane: stress", "plane: strain"), ("- \"v0/omega*sin(pi*X/L)", "- ▸\"v0/omega*sin(pi*X/L)")],
    &["equation of motion in X", "this is not a solution"]
)]
#[case::integrals_over_the_plane(
    &[("- mpm: {basis: linear, transfer: flip", "- ▸mpm: {basis: linear, transfer: tls")],
    &["the transfer `tls` integrates over cells in the plane", "`plane: stress`"]
)]
#[case::a_pressure_on_all_axes(
    &[(FACES, "  boundary: {left: roller}\n  loads: [▸artificial_viscosity: {linear: 1, quadratic: 1}]\n")],
    &["`plane: stress`, and an artificial viscosity is a pressure on all axes"]
)]
#[case::heat(
    &[(FACES, "  boundary: {left: roller}\n  loads: [▸heat: {conductivity: 1, capacity: 1}]\n")],
    &["`plane: stress`, and heat flows in bodies in plane strain only"]
)]
fn a_plate_with(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(WAVE, edits, words);
}

#[rstest]
#[case(BAR, 1)]
#[case(CUBE, 3)]
fn a_plane_in_other_dimensions(#[case] suite: &str, #[case] dimension: usize) {
    let (scene, plane) = ("scene:", "scene:\n  plane: ▸strain");
    let message = format!("a plane, and the scene is {dimension}-D");
    refused(suite, &[(scene, plane)], &[&message, "expected in a scene of `dimension: 2`"]);
}

/// The pressure acts on the present thickness, and the thickness is that of a face that is free.
#[rstest]
#[case::on_the_reference_thickness("p: \"-E*ln(a)/(a*b^2)\"", "p: \"-E*ln(a)/(a*b)\"")]
#[case::in_plane_strain("  plane: stress\n", "")]
fn a_pull_with_another_pressure(#[case] right: &str, #[case] wrong: &str) {
    let edits = [(right, wrong), ("displacement: [\"(a", "displacement: [▸\"(a")];
    refused(PULL, &edits, &["boundary condition: right is", "traction in X"]);
}
