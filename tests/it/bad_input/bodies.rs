//! Several bodies: scenes that are not possible with several bodies, methods that support only one,
//! motions that violate contact, and invalid viscosities.

use super::{Edits, refused};
use rstest::rstest;

const IMPACT: &str = include_str!("../../../verification/contact-and-friction/two-bar-impact.yaml");
const DISKS: &str = include_str!("../../../verification/contact-and-friction/two-disks.yaml");
const HALVES: &str =
    include_str!("../../../verification/contact-and-friction/vibrating-bar-of-two.yaml");

const JOINED: &str = include_str!("../../../verification/waves/bar-of-two-materials.yaml");
const VISCOUS: &str =
    include_str!("../../../verification/damping/artificial-viscosity-linear.yaml");

const METHOD: &str = "- mpm: {basis: linear, transfer: flip, scheme: [usl, musl]}";

#[rstest]
#[case::neither_a_body_nor_a_list("body: {box: {from: [0], to: [L]}}\n", "the scene has no `body`")]
#[case::no_material(
    "material: {linear_elastic: {young: E, poisson: 0, density: rho}}\n",
    "the scene has no `material`"
)]
fn a_scene_without(#[case] missing: &str, #[case] words: &str) {
    let edits: Edits<'_> = &[("scene:", "▸scene:"), (missing, "\n")];
    refused(super::samples::BAR, edits, &[words, "or a list of `bodies` with one of each"]);
}

#[rstest]
#[case::a_body_besides(
    IMPACT,
    &[("  contact: {friction: 0}", "  contact: {friction: 0}\n  ▸body: {box: {from: [0], to: [1]}}")],
    &["`body` is for a single body, but the scene lists `bodies`"]
)]
#[case::a_velocity_besides(
    IMPACT,
    &[("  contact: {friction: 0}", "  contact: {friction: 0}\n  ▸initial_velocity: [v0]")],
    &["`initial_velocity` is for a single body"]
)]
#[case::a_displacement_besides(
    JOINED,
    &[("  boundary: {left: fixed}", "  boundary: {left: fixed}\n  ▸initial_displacement: [0]")],
    &["`initial_displacement` is for a single body"]
)]
#[case::a_displacement_of_a_law_with_a_history(
    JOINED,
    &[
        ("linear_elastic: {young: E2, poisson: 0", "j2: {young: E2, poisson: 0, yield: 1"),
        ("initial_displacement: [\"A*right", "▸initial_displacement: [\"A*right"),
    ],
    &["a `j2` body cannot start deformed", "plastic flow depends on the whole history"]
)]
#[case::a_displacement_of_one_that_is_not_in_the_formula(
    JOINED,
    &[("[\"A*right(X)\"]", "[\"1.001*A*right(X)\"]"), ("[\"A*(left", "[▸\"A*(left")],
    &["initial condition u_X(X, 0) = u0(X) is violated at X = (1.", "m (off by -"]
)]
#[case::a_frequency_that_is_no_root(
    JOINED,
    &[("omega: 6.276875706767236", "omega: 6.276876"), ("[\"A*(left", "[▸\"A*(left")],
    &["where two bodies meet along X, their tractions in X differ at X = (", "Pa (off by "]
)]
#[case::one_at_rest(
    DISKS,
    &[("material: {linear_elastic: {young: 1000, poisson: 0.3, density: 1000}}", "▸material: {rigid: {density: 1000}}")],
    &["a `rigid` body cannot be in a list of bodies", "a `rigid` body does not move: remove this, or choose another material"]
)]
#[case::a_traction(
    IMPACT,
    &[("  contact: {friction: 0}", "  contact: {friction: 0}\n  loads:\n    - ▸traction: {on: right, value: [1]}")],
    &["`traction` acts on a face of a single body, but the scene lists `bodies`"]
)]
#[case::heat(
    IMPACT,
    &[("  contact: {friction: 0}", "  contact: {friction: 0}\n  loads:\n    - ▸heat: {conductivity: 1, capacity: 1}")],
    &["`heat` is supported for a single body only, but the scene lists `bodies`"]
)]
#[case::negative_friction(
    IMPACT,
    &[("  contact: {friction: 0}", "  contact: {friction: ▸-0.5}")],
    &["the coefficient of friction is -0.5", "expected zero or a positive number"]
)]
#[case::negative_viscosity(
    VISCOUS,
    &[("linear: 1,", "linear: ▸-1,")],
    &["a coefficient of viscosity is -1", "expected zero or a positive number"]
)]
#[case::half_a_viscosity(VISCOUS, &[("{linear: 1, quadratic: 0}", "▸{linear: 1}")], &["quadratic"])]
#[case::viscosity_twice(
    VISCOUS,
    &[("    - artificial", "    - artificial_viscosity: {linear: 0, quadratic: 0}\n    - artificial"),
      ("viscosity: {linear: 1,", "viscosity: ▸{linear: 1,")],
    &["artificial viscosity appears twice"]
)]
#[case::viscosity_of_finite_elements(
    VISCOUS,
    &[("- mpm: {basis: linear, transfer: flip, scheme: [musl, usl], start: half_step_back}", "- ▸fem: {element: linear, mass: lumped}")],
    &["the built-in FEM does not support artificial viscosity"]
)]
#[case::bars_in_one_place(
    IMPACT,
    &[("- body: {box: {from: [L]", "- ▸body: {box: {from: [\"0.9*L\"]")],
    &["body 1 and body 2 overlap"]
)]
#[case::disks_in_one_place(
    DISKS,
    &[("- body: {disk: {centre: [0.8, 0.8]", "- ▸body: {disk: {centre: [0.45, 0.45]")],
    &["body 1 and body 2 overlap"]
)]
#[case::a_transfer_that_improves_one_field(
    IMPACT,
    &[(METHOD, "- ▸mpm: {basis: linear, transfer: xpic_2, scheme: usl}")],
    &["the transfer `xpic_2` is not supported for several bodies"]
)]
#[case::a_mass_matrix_of_one_body(
    IMPACT,
    &[(METHOD, "- ▸mpm: {basis: linear, transfer: flip, scheme: usl, mass: consistent}")],
    &["the mass matrix `consistent` is not supported for several bodies"]
)]
#[case::bodies_that_do_not_meet(
    IMPACT,
    &[(METHOD, "- ▸mpm: {basis: linear, transfer: flip, scheme: usl, frame: total_lagrangian}")],
    &["the frame `total_lagrangian` is not supported for several bodies"]
)]
#[case::contact_taken_back(
    IMPACT,
    &[(METHOD, "- ▸mpm: {basis: linear, transfer: flip, scheme: usl, start: half_step_back}")],
    &["`start: half_step_back` is not supported with contact"]
)]
#[case::an_fem(
    HALVES,
    &[("- mpm: {basis: linear, transfer: flip, scheme: [musl, usl]}", "- ▸fem: {element: linear, mass: lumped}")],
    &["the built-in FEM supports a single body only, but the scene lists `bodies`"]
)]
#[case::bars_that_go_through_each_other(
    IMPACT,
    &[("[\"sign(L - X)*bar(abs(X - L), t)\"]", "[▸\"sign(L - X)*v0*t + 0*bar(X, t)\"]")],
    &["where two bodies meet along X, they overlap at X = ("]
)]
#[case::bars_that_stick(
    IMPACT,
    &[("  contact: {friction: 0}\n", ""), ("[\"sign", "[▸\"sign")],
    &["where two bodies meet along X, their displacements u_X differ", "add `contact: {friction: 0}` to `scene`"]
)]
#[case::bars_with_a_gap_and_one_velocity_field(
    JOINED,
    &[("- body: {box: {from: [a]", "- ▸body: {box: {from: [\"1.1*a\"]")],
    &["the exact solution of bodies with a gap and one velocity field depends on the cell size", "add `contact: {friction: 0}` to `scene`"]
)]
#[case::a_wall_with_friction(
    DISKS,
    &[("  contact:", "  boundary: {▸bottom: {friction: 0.1}}\n  contact:")],
    &["friction on a wall is supported for a single body only"]
)]
#[case::a_manufactured_force(
    DISKS,
    &[("run:", "▸manufactured: {displacement: [X, Y]}\nrun:")],
    &["`manufactured` is for a single body, but the scene lists `bodies`"]
)]
#[case::a_truth_for_rims(
    DISKS,
    &[
        ("- body: {disk: {centre: [0.2", "- ▸body: {disk: {centre: [0.2"),
        ("run:", "exact:\n  equation: small_strain\n  displacement: [\"v*t\", \"v*t\"]\nrun:")
    ],
    &["an exact solution of several bodies can be checked only for boxes"]
)]
#[case::a_figure_that_takes_a_truth(
    DISKS,
    &[("suite: two", "▸suite: two"), ("    crossings: some", "    crossings: some\n    error_below: 1")],
    &["a convergence study needs `exact`", "without one of them, expectations can only bound a `drift` or an `energy_rate`"]
)]
#[case::a_place_without_a_truth(
    DISKS,
    &[("methods:", "▸observe: {at: [0.2, 0.2]}\nmethods:")],
    &["`observe` needs an exact solution or a reference, and the suite has neither"]
)]
fn bodies_with(#[case] sound: &str, #[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(sound, edits, words);
}
