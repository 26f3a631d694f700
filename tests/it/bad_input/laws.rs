//! Materials whose stress depends on more than the deformation, and the exact solutions that they
//! allow.

use super::{Edits, refused};
use rstest::rstest;

const YIELDING: &str = include_str!("../../../verification/plasticity-and-fluids/plastic-bar.yaml");
const WAVE: &str = include_str!("../../../verification/plasticity-and-fluids/plastic-wave.yaml");
const FLUID: &str = include_str!("../../../verification/plasticity-and-fluids/fluid-column.yaml");

#[rstest]
#[case::that_never_yields(
    &[("min(2*mu*eps, Y)", "2*mu*eps"), ("[\"rate*t*X\"]", "[▸\"rate*t*X\"]")],
    &["boundary condition: right is loaded, traction in X"]
)]
#[case::of_which_all_flows(
    &[("2/3*min(2*mu*eps, Y)", "2/3*Y"), ("[\"rate*t*X\"]", "[▸\"rate*t*X\"]")],
    &["boundary condition: right is loaded, traction in X"]
)]
#[case::that_is_let_go(
    &[("rate*t))/(1 + rate*t)", "rate*t*(1 - t/2)))/(1 + rate*t*(1 - t/2))"), ("until: 1,", "until: 2,"), ("[\"rate*t*X\"]", "[▸\"rate*t*(1 - t/2)*X\"]")],
    &["loading reverses where the body flows plastically", "expected 0.0"]
)]
fn a_bar(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(YIELDING, edits, words);
}

/// Fronts of any speed satisfy the equation of motion at every point.
#[rstest]
#[case(&[("cp: \"sqrt(K/rho)\"", "cp: \"0.9*sqrt(K/rho)\""), ("[\"front(e1", "[▸\"front(e1")])]
#[case(&[("cl: \"sqrt((K + 4/3*mu)/rho)\"", "cl: \"0.9*sqrt((K + 4/3*mu)/rho)\""), ("[\"front(e1", "[▸\"front(e1")])]
fn a_front_of_another_speed(#[case] edits: Edits<'_>) {
    refused(WAVE, edits, &["momentum balance across wave fronts"]);
}

#[rstest]
#[case::of_finite_elements(
    &[("methods:\n", "methods:\n  - ▸fem: {element: linear, mass: lumped, law: j2}\n"), ("of: stress, ", "")],
    &["the built-in FEM does not support the law `j2`"]
)]
#[case::as_a_reference(
    &[("\nrun:", "\nreference: {equation: ▸j2, fem: {element: linear, mass: lumped, cells: 100, dt: \"h/100\"}}\nrun:"), ("of: stress, ", "")],
    &["the built-in FEM does not support the law `j2`"]
)]
fn plasticity(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(WAVE, edits, words);
}

#[rstest]
#[case::of_another_weight(
    &[("a: \"7*rho*g/K\"", "a: \"7.1*rho*g/K\""), ("[\"0*X\"", "[▸\"0*X\"")],
    &["equation of motion in Y"]
)]
#[case::that_moves(
    &[("equilibrium:", "exact:"), ("equation: tait", "equation: ▸tait"), ("    rest_below: 1e-9\n", ""), ("    rest_below: 1e-6\n", "")],
    &["the stress of a viscous fluid in motion depends on its velocity"]
)]
fn a_fluid(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(FLUID, edits, words);
}

/// A check with a tolerance of 1 % still distinguishes plane strain from plane stress.
#[rstest]
#[case(&[("np: \"nu/(1 - nu)\"", "np: nu"), ("- \"(1 + s(X, Y))*(cos", "- ▸\"(1 + s(X, Y))*(cos")])]
#[case(&[("Ep: \"E/(1 - nu^2)\"", "Ep: E"), ("- \"(1 + s(X, Y))*(cos", "- ▸\"(1 + s(X, Y))*(cos")])]
fn a_disk_that_spins_in_plane_stress(#[case] edits: Edits<'_>) {
    let disk = include_str!("../../../verification/conservation/spinning-disk.yaml");
    refused(disk, edits, &["is violated at X", "this is not a solution"]);
}

/// Clay yields in extension, or softens in compression from far inside its yield surface. Its
/// stress is then unknown.
#[rstest]
#[case("rate: 0.2", "0.25", "`cam_clay` has no stress for the extension du_X/dX = ")]
#[case("rate: -0.3", "0", "`cam_clay` has no stress for the compression du_X/dX = -")]
fn a_strain_without_stress(#[case] rate: &str, #[case] poisson: &str, #[case] words: &str) {
    let clay = include_str!("../../../verification/soils/path-cam-clay-elastic.yaml");
    let edits = [
        ("rate: -0.03", rate),
        ("poisson: 0.25", &format!("poisson: {poisson}")),
        ("[\"rate*t*X\"]", "[▸\"rate*t*X\"]"),
    ];
    refused(clay, &edits, &[words]);
}
