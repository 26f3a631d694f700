//! Load steps: keys that require a motion in time, and loads, walls and laws that load steps
//! exclude.

use super::{Edits, refused};
use rstest::rstest;

const STEPS: &str = include_str!("../../../verification/equilibrium/load-steps-hencky.yaml");

const RUN: &str = "run: {load_steps: [1, 20]}";
const METHOD: &str = "- mpm: {basis: [linear, ugimp, cpgimp], scheme: quasi_static}";
const LOAD: &str = "    - gravity: [\"-g\"]";

#[rstest]
#[case::with_an_end(&[(RUN, "run: {load_steps: 20, ▸until: 1}")], &["load steps have no time", "keep one of them"])]
#[case::without_either(&[(RUN, "run: ▸{dt: 1}"), (METHOD, "- external: {name: mine}")], &["a run needs an end", "load_steps"])]
#[case::with_a_time_step(&[(RUN, "run: {load_steps: 20, ▸dt: 0.1}")], &["`dt` is not supported with load steps: they have no duration"])]
#[case::with_refined_time_steps(
    &[("ppc: 2}", "ppc: 2, ▸dt: [4, 3, 2, 1]}")], &["`dt` is not supported with load steps: they have no duration"]
)]
#[case::with_instants(
    &[(RUN, "run: {load_steps: 20, ▸instants: 3}")], &["`instants` is not supported with load steps: errors are computed after the last step only"]
)]
#[case::of_a_velocity(
    &[("judge: {of: displacement, norm: rms}", "judge: {of: ▸velocity, norm: rms}")], &["`velocity` is not supported with load steps: they have no velocity"]
)]
#[case::of_a_kinetic_energy(
    &[("judge: {of: displacement, norm: rms}", "judge: {of: ▸kinetic_energy}")], &["`kinetic_energy` is not supported with load steps"]
)]
#[case::of_a_momentum(
    &[("judge: {of: displacement, norm: rms}", "judge: {of: ▸momentum}")], &["`momentum` is not supported with load steps"]
)]
#[case::of_no_step(&[("[1, 20]", "▸0")], &["the number of load steps"])]
#[case::of_half_a_step(&[("[1, 20]", "[1, ▸2.5]")], &["the number of load steps"])]
#[case::of_too_many(&[("[1, 20]", "▸1000000")], &["expected a whole number from 1 to 1e5"])]
#[case::twice(&[("[1, 20]", "[20, ▸20]")], &["20 load steps appear twice"])]
#[case::with_a_motion(
    &[("equilibrium:\n", "▸exact:\n")], &["`exact` is not supported with load steps: it is a motion in time", "`equilibrium`"]
)]
#[case::with_a_manufactured_force(
    &[("equilibrium:\n  equation: hencky\n", "▸manufactured:\n")], &["`manufactured` is not supported with load steps"]
)]
#[case::with_a_reference(
    &[("run: {", "reference: {equation: hencky, ▸fem: {element: linear, mass: lumped, cells: 320, dt: 1e-3}}\nrun: {")],
    &["`reference.fem` is not supported with load steps"]
)]
#[case::with_a_motion_in_the_equilibrium(&[("K(lambert_w(q(X)))) - X", "K(lambert_w(q(X)))) - X + 0*▸t")], &["t"])]
#[case::of_an_explicit_method(
    &[(METHOD, "- ▸mpm: {basis: linear, transfer: flip, scheme: musl}")], &["this method needs time steps, and the suite has load steps"]
)]
#[case::of_finite_elements(
    &[(METHOD, "- ▸fem: {element: linear, mass: lumped}")], &["this method needs time steps, and the suite has load steps"]
)]
fn a_run_has_load_steps_or_time(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(STEPS, edits, words);
}

#[rstest]
#[case::without_load_steps(
    &[(RUN, "run: {until: 1, dt: 0.1}"), ("scheme: quasi_static", "scheme: ▸quasi_static")],
    &["`quasi_static` needs a number of load steps", "run: {load_steps: 20}"]
)]
#[case::with_a_transfer(
    &[("scheme: quasi_static", "▸transfer: flip, scheme: quasi_static")],
    &["`quasi_static` does not support `transfer`", "no velocities"]
)]
#[case::with_a_mass_matrix(&[("scheme: quasi_static", "scheme: quasi_static, ▸mass: lumped")], &["no inertia"])]
#[case::with_a_start(&[("scheme: quasi_static", "scheme: quasi_static, ▸start: at_zero")], &["no initial velocity"])]
#[case::with_a_frame(
    &[("scheme: quasi_static", "scheme: quasi_static, ▸frame: total_lagrangian")], &["updated-Lagrangian"]
)]
#[case::with_averaged_volumes(
    &[("scheme: quasi_static", "scheme: quasi_static, ▸volume: averaged")], &["not implemented"]
)]
#[case::with_single_precision(
    &[("scheme: quasi_static", "scheme: quasi_static, ▸precision: single")], &["double precision"]
)]
#[case::next_to_other_schemes(
    &[("scheme: quasi_static", "▸scheme: [quasi_static, musl]")], &["a separate entry of `methods`"]
)]
#[case::misspelt(&[("scheme: quasi_static", "scheme: ▸quasistatic")], &["`quasi_static`"])]
#[case::an_explicit_one_without_transfer(
    &[(RUN, "run: {until: 1, dt: 0.1}"), (METHOD, "- ▸mpm: {basis: linear, scheme: musl}")],
    &["a scheme with time steps needs a `transfer`", "add `transfer: flip`"]
)]
fn a_method_has_the_keys_of_its_scheme(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(STEPS, edits, words);
}

#[rstest]
#[case::a_load_in_time(&[(LOAD, "    - gravity: ▸[\"-g*t\"]")], &["`gravity` is not supported in load steps: it depends on t"])]
#[case::a_force_of_the_displacement(
    &[(LOAD, "    - gravity: [\"-g\"]\n    - body_force: ▸[\"-ux\"]")], &["it depends on the displacement"]
)]
#[case::damping(&[(LOAD, "    - gravity: [\"-g\"]\n    - damping: ▸0.1")], &["there is no velocity to damp"])]
#[case::local_damping(
    &[(LOAD, "    - gravity: [\"-g\"]\n    - local_damping: ▸0.1")], &["there is no velocity to damp"]
)]
#[case::a_pressure(
    &[(LOAD, "    - gravity: [\"-g\"]\n    - pressure: ▸{on: right, value: 1}")], &["it is a follower load"]
)]
#[case::a_prescribed_motion(
    &[("  loads:", "  sets: {tip: {box: {from: [40], to: [50]}}}\n  loads:\n    - velocity: ▸{on: tip, value: [1]}")],
    &["a velocity belongs to a motion in time"]
)]
#[case::a_moving_wall(&[("left: fixed", "▸left: {velocity: [1]}")], &["the left face", "which load steps do not support"])]
#[case::a_free_body(
    &[("boundary: {left: fixed}", "boundary: {}"), ("  body:", "  ▸body:")], &["nothing holds the body along X"]
)]
#[case::no_load(&[("  loads:\n    - gravity: [\"-g\"]\n", ""), ("  material:", "  ▸material:")], &["the scene has none"])]
#[case::a_start_in_motion(
    &[("  loads:", "  ▸initial_velocity: [1]\n  loads:")], &["`initial_velocity` is not supported with load steps: they have no velocity"]
)]
#[case::a_start_elsewhere(
    &[("  loads:", "  ▸initial_displacement: [1]\n  loads:")], &["they start from the reference configuration"]
)]
#[case::a_law_without_tangent(
    &[
        ("hencky: {young: E, poisson: 0, density: rho0}", "linear_elastic: {young: E, poisson: 0, density: rho0}"),
        ("equation: hencky", "equation: small_strain"),
        ("displacement: [\"E/(rho0*g)*(K(lambert_w(q(0))) - K(lambert_w(q(X)))) - X\"]", "displacement: [\"-rho0*g/E*(l0*X - X^2/2)\"]"),
        ("  q(Y): \"rho0*g*(l0 - Y)/E\"\n  K(w): \"w + w^2/2\"\n", ""),
        ("functions:\n", ""),
        ("material: {", "material: ▸{")
    ],
    &["`quasi_static` does not support `linear_elastic`", "hencky"]
)]
fn a_scene_has_neither_time_nor_motion(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(STEPS, edits, words);
}
