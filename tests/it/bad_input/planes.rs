//! Laws, conditions and studies that a state across the plane excludes in two dimensions.

use super::samples::{BAR, CUBE};
use super::{Edits, refused};
use rstest::rstest;

const WAVE: &str =
    include_str!("../../../verification/axisymmetry-and-plane-stress/plane-stress-wave.yaml");
const PULL: &str =
    include_str!("../../../verification/axisymmetry-and-plane-stress/plane-stress-pull.yaml");

const LAW: &str = "linear_elastic: {young: E, poisson: nu,";
const FACES: &str = "  boundary: {left: roller, right: roller, bottom: roller, top: roller}\n";

#[rstest]
#[case::no_name_of_a_state(
    &[("plane: stress", "plane: ▸stretch")],
    &["unknown name `stretch`", "`strain`", "`stress`"]
)]
#[case::a_law_that_is_not_known_in_it(
    &[(LAW, "▸j2: {young: E, poisson: nu, yield: 1,")],
    &["the law `j2` is not supported in plane stress, where sigma_33 = 0", "use `linear_elastic`"]
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
    &["the transfer `tls` is not supported in `plane: stress`", "integrates over cells in the plane"]
)]
#[case::a_pressure_on_all_axes(
    &[(FACES, "  boundary: {left: roller}\n  loads: [▸artificial_viscosity: {linear: 1, quadratic: 1}]\n")],
    &["`plane: stress` is not supported with `artificial_viscosity`: it is a pressure on all axes"]
)]
#[case::heat(
    &[(FACES, "  boundary: {left: roller}\n  loads: [▸heat: {conductivity: 1, capacity: 1}]\n")],
    &["`plane: stress` is not supported with `heat`: it is implemented in plane strain only"]
)]
fn a_plate_with(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(WAVE, edits, words);
}

const TUBE: &str =
    include_str!("../../../verification/axisymmetry-and-plane-stress/pressurised-cylinder.yaml");
const ROD: &str =
    include_str!("../../../verification/axisymmetry-and-plane-stress/axisymmetric-wave.yaml");

#[rstest]
#[case::a_negative_radius(
    &[("body: {box: {from: [0, 0]", "▸body: {box: {from: [-1, 0]")],
    &["the body starts at the negative radius -1", "the first coordinate of the meridian plane"]
)]
#[case::an_axis_that_is_free(
    &[("boundary: {left: roller, ", "▸boundary: {")],
    &["the left face lies on the axis, but is free", "state `left: roller`"]
)]
#[case::a_radius_without_end(
    &[("boundary: {left: roller, right: roller,", "boundary: {▸left: periodic, right: periodic,")],
    &["the face `left` cannot be periodic"]
)]
#[case::domains_in_the_plane(
    &[("- mpm: {basis: linear", "- ▸mpm: {basis: cpgimp")],
    &["the basis `cpgimp` is not supported in `plane: axisymmetric`", "Nairn & Guilkey 2015"]
)]
#[case::integrals_over_the_plane(
    &[("transfer: [flip, apic]", "transfer: tls"), ("- mpm", "- ▸mpm")],
    &["the transfer `tls` is not supported in `plane: axisymmetric`"]
)]
#[case::several_bodies(
    &[
        ("  body: {box: {from: [0, 0], to: [b, b/4]}}\n", "  ▸bodies:\n    - body: {box: {from: [0, 0], to: [b, b/4]}}\n"),
        ("  material:", "      material:"),
        ("  initial_velocity: [\"v0*bessel_j1(k*X)\", 0]\n", ""),
    ],
    &["`plane: axisymmetric` is not supported for several bodies"]
)]
#[case::a_panel(
    &[("body: {box: {from: [0, 0], to: [b, b/4]}}", "▸body: {quadrilateral: {corners: [[0, 0], [b, 0], [b, b/4], [0, b/4]]}}")],
    &["`plane: axisymmetric` is not supported for a quadrilateral"]
)]
#[case::a_free_rim_on_the_axis(
    &[("body: {box: {from: [0, 0], to: [b, b/4]}}", "▸body: {polygon: [[0, 0], [b, 0], [0, b]]}"), (FACES, "")],
    &["the free rim of the body touches the axis", "move it to larger radii"]
)]
#[case::an_initial_stress(
    &[("  initial_velocity", "  ▸initial_stress: {xx: \"1\"}\n  initial_velocity")],
    &["`plane: axisymmetric` is not supported with an initial stress, which has no key for the hoop stress"]
)]
#[case::a_judged_energy(
    &[("judge: {norm: max_l2}", "judge: {of: ▸kinetic_energy, norm: linf}")],
    &["the exact solution does not provide the kinetic energy of a body of revolution"]
)]
#[case::a_total_force(
    &[("  initial_velocity", "  sets: {tip: {box: {from: [b/2, 0], to: [b, b/4]}}}\n  loads: [▸force: {on: tip, value: [1, 0]}]\n  initial_velocity")],
    &["`plane: axisymmetric` is not supported with `force`: it is not defined"]
)]
#[case::the_wave_of_a_bar(
    &[("3.8317059702075123/b", "pi/b"), ("bessel_j1(k*X)*sin", "sin(k*X)*sin"), ("[\"v0/omega", "[▸\"v0/omega"), ("v0*bessel_j1", "v0*sin")],
    &["equation of motion in X", "this is not a solution"]
)]
#[case::plane_strain_with_the_wave_of_a_rod(
    &[("plane: axisymmetric", "plane: strain"), ("[\"v0/omega", "[▸\"v0/omega")],
    &["equation of motion in X", "this is not a solution"]
)]
#[case::a_radial_momentum(
    &[("  - order: [1.9, 2.1]\n", "  - drift: {▸momentum: 1e-9}\n")],
    &["this sum over the meridian plane is not conserved in a body of revolution"]
)]
fn a_rod_with(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(ROD, edits, words);
}

/// The hoop stress is part of the balance at the inner face, where the pressure acts.
#[rstest]
#[case::without_hoops(("plane: axisymmetric", "plane: strain"))]
#[case::with_another_pressure(("p: 1e-5", "p: 1.1e-5"))]
fn a_tube_with(#[case] edit: (&str, &str)) {
    let q = ("Q: \"(1 + nu)/E*p*", "Q: \"(1 + nu)/E*1e-5*");
    let edits = [q, edit, ("strain\n  displacement: [\"u", "strain\n  displacement: [▸\"u")];
    refused(TUBE, &edits, &["left is under pressure, traction in X", "this is not a solution"]);
}

const STEPS: &str = include_str!(
    "../../../verification/axisymmetry-and-plane-stress/load-steps-cylinder-uniform.yaml"
);

#[rstest]
#[case::domains_in_the_plane(
    &[("- mpm: {basis: linear", "- ▸mpm: {basis: cpgimp")],
    &["the basis `cpgimp` is not supported in `plane: axisymmetric`", "Nairn & Guilkey 2015"]
)]
#[case::an_axis_that_is_free(
    &[("boundary: {left: roller, ", "▸boundary: {")],
    &["the left face lies on the axis, but is free", "state `left: roller`"]
)]
#[case::nothing_along_its_axis(
    &[("boundary: {left: roller, bottom: roller}", "boundary: {left: roller}"), ("  body:", "  ▸body:")],
    &["nothing holds the body along Y"]
)]
#[case::plane_stress(
    &[("plane: axisymmetric", "▸plane: stress")],
    &["load steps are not supported in plane stress"]
)]
#[case::a_follower_load(
    &[("traction: {on: right, value: [\"(mu*(a^2 - 1) + L)/a\", 0]", "pressure: ▸{on: right, value: 1")],
    &["`pressure` is not supported in load steps: it is a follower load"]
)]
fn a_cylinder_in_load_steps_with(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(STEPS, edits, words);
}

#[rstest]
#[case(BAR, 1)]
#[case(CUBE, 3)]
fn a_plane_in_other_dimensions(#[case] suite: &str, #[case] dimension: usize) {
    let (scene, plane) = ("scene:", "scene:\n  plane: ▸strain");
    let message = format!("`plane` needs a 2-D scene, but this scene is {dimension}-D");
    refused(suite, &[(scene, plane)], &[&message, "expected in a scene of `dimension: 2`"]);
}

/// The pressure acts on the current thickness of a face that is free across the plane.
#[rstest]
#[case::on_the_reference_thickness("p: \"-E*ln(a)/(a*b^2)\"", "p: \"-E*ln(a)/(a*b)\"")]
#[case::in_plane_strain("  plane: stress\n", "")]
fn a_pull_with_another_pressure(#[case] right: &str, #[case] wrong: &str) {
    let edits = [(right, wrong), ("displacement: [\"(a", "displacement: [▸\"(a")];
    refused(PULL, &edits, &["boundary condition: right is", "traction in X"]);
}
