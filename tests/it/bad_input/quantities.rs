//! Judged quantities, and bounds on measured values.

use super::samples::BAR;
use super::{Edits, refused};
use crate::common::valid_suite;
use rstest::rstest;

const EXPECTED: &str = "    verdict: too_few_levels\n    finest_pair: [1.5, 2.5]\n";
const FEM: &str = "  - fem: {element: linear, mass: lumped}\n";
const FEM_EXPECTED: &str = "  - case: \"fem-*\"\n    verdict: too_few_levels\n";

#[rstest]
#[case::an_unknown_quantity(
    &[("{norm: rms}", "{of: ▸strain}")],
    &["unknown name `strain`", "displacement", "deformation_gradient"]
)]
#[case::an_unknown_norm(&[("{norm: rms}", "{norm: ▸max_rsm}")], &["max_rsm", "max_rms"])]
#[case::a_scale_of_zero(
    &[("{norm: rms}", "{scale: ▸\"E - 100\"}")],
    &["the scale of the error is 0, but must be above zero", "expected a positive number"]
)]
#[case::a_scale_that_is_no_number(
    &[("{norm: rms}", "{scale: ▸\"1/(E - 100)\"}")],
    &["is inf because `E` is 100"]
)]
#[case::a_stress_that_finite_elements_lack(
    &[("{norm: rms}", "{of: stress}"), ("- fem:", "- ▸fem:")],
    &["the built-in FEM does not provide the stress that this suite judges"]
)]
#[case::a_gradient_that_finite_elements_lack(
    &[("{norm: rms}", "{of: deformation_gradient}"), ("- fem:", "- ▸fem:")],
    &["the built-in FEM does not provide the deformation gradient", "judge the displacement or the velocity"]
)]
#[case::a_stress_that_a_reference_lacks(
    &[
        ("{norm: rms}", "{of: stress}"),
        (FEM, ""),
        ("run:", "▸reference:\n  equation: small_strain\n  fem: {element: linear, mass: lumped, cells: 100, dt: 1e-3}\nrun:"),
    ],
    &["a reference does not provide the stress that this suite judges"]
)]
#[case::a_mean_stress_of_a_bar(
    &[("{norm: rms}", "{of: ▸mean_stress}"), (FEM, "")],
    &["there is no mean stress in 1-D", "use a scene with more dimensions"]
)]
#[case::a_component_across_a_bar(
    &[("{norm: rms}", "{of: ▸stress_xy}"), (FEM, "")],
    &["there is no stress xy in 1-D"]
)]
#[case::a_component_that_finite_elements_lack(
    &[("{norm: rms}", "{of: stress_xx}"), ("- fem:", "- ▸fem:")],
    &["the built-in FEM does not provide the stress xx that this suite judges"]
)]
fn a_comparison_with(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(BAR, edits, words);
}

#[rstest]
#[case::a_norm_over_instants_twice(
    &[("{norm: rms}", "{of: kinetic_energy, norm: ▸max_rms}"), (FEM, "")],
    &["the kinetic energy is one number for the whole body", "`linf` for the largest value over the instants"]
)]
#[case::finite_elements(
    &[("{norm: rms}", "{of: kinetic_energy}"), ("- fem:", "- ▸fem:")],
    &["the built-in FEM does not provide the kinetic energy that this suite judges"]
)]
#[case::a_face_of_the_body(
    &[("{norm: rms}", "{of: momentum, ▸face: left}"), (FEM, "")],
    &["the momentum is not a quantity of a face", "judge the `reaction`"]
)]
#[case::a_face_of_a_field(
    &[("{norm: rms}", "{of: velocity, ▸face: left}")],
    &["the velocity is not a quantity of a face"]
)]
#[case::a_spin_of_a_bar(
    &[("{norm: rms}", "{of: ▸angular_momentum}"), (FEM, "")],
    &["there is no angular momentum in 1-D"]
)]
#[case::an_unknown_face(
    &[("{norm: rms}", "{of: reaction, face: ▸lefft}"), (FEM, "")],
    &["a body of dimension 1 has no face `lefft`", "did you mean `left`?"]
)]
#[case::a_face_that_is_free(
    &[("{norm: rms}", "{of: reaction, face: ▸right}"), (FEM, "")],
    &["the right face is free: only a fixed face or a roller has a reaction"]
)]
#[case::nothing_held(
    &[
        ("{norm: rms}", "{of: ▸reaction}"),
        (FEM, ""),
        ("boundary: {left: fixed}", "boundary: {}"),
        ("v0*mode(X)", "v0*cos(pi*X/L)"),
        ("v0/omega*mode(X)*sin(omega*t)", "v0/(2*omega)*cos(pi*X/L)*sin(2*omega*t)"),
        ("functions:\n  mode(s): \"sin(pi*s/(2*L))\"\n", ""),
    ],
    &["there is no reaction, because no face is held", "`fixed` or `roller`"]
)]
#[case::a_consistent_mass(
    &[
        ("{norm: rms}", "{of: reaction}"),
        (FEM, ""),
        ("scheme: [musl, usl]}", "scheme: [musl, usl], mass: ▸consistent}"),
    ],
    &["a reaction contains the inertia of other nodes", "use `lumped`"]
)]
fn a_sum_with(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(BAR, edits, words);
}

const OEDOMETER: &str =
    include_str!("../../../verification/soils/oedometer-mohr-coulomb-mean-stress.yaml");

/// Stresses that a body in plane strain does not have, and motions whose stress is unknown.
#[rstest]
#[case::a_shear_out_of_the_plane(
    &[("{of: mean_stress", "{of: ▸stress_yz")],
    &["there is no stress yz in 2-D"]
)]
#[case::a_law_without_stress_out_of_the_plane(
    &[
        ("{of: mean_stress", "{of: ▸mean_stress"),
        ("{mohr_coulomb: {young: E, poisson: nu, friction_angle: 30, dilation_angle: 10, cohesion: c", "{linear_elastic: {young: E, poisson: nu"),
        ("equation: mohr_coulomb", "equation: small_strain"),
        ("  initial_stress: {xx: \"-k0*s0\", yy: \"-s0\", zz: \"-k0*s0\"}\n", ""),
        ("  s0: 40        # initial vertical stress, positive in compression (Pa)\n", ""),
        ("  k0: 0.5       # initial ratio of horizontal and vertical stress\n", ""),
        ("frame: total_lagrangian", "frame: updated_lagrangian"),
        ("rate: -0.02 ", "rate: -1e-9"),
        ("  c: 10         # cohesion (Pa)\n", ""),
    ],
    &["the out-of-plane stress of `linear_elastic` in plane strain is not computed"]
)]
#[case::averaged_volumes(
    &[("{of: mean_stress", "{of: ▸mean_stress"), ("frame: total_lagrangian", "volume: averaged")],
    &["the out-of-plane stress of averaged volume ratios is not computed"]
)]
#[case::strain_on_two_axes(
    &[("[0, \"rate*t*Y\"]", "[▸\"1e-9*t*X\", \"rate*t*Y\"]")],
    &["the stress of `mohr_coulomb` is known in uniaxial strain only, but du_Y/dY is not zero"]
)]
#[case::unequal_lateral_stresses(
    &[("zz: \"-k0*s0\"", "zz: \"-0.9*k0*s0\""), ("[0, \"rate*t*Y\"]", "[▸0, \"rate*t*Y\"]")],
    &["the lateral initial stresses xx and zz differ"]
)]
#[case::an_initial_shear_stress(
    &[("yy: \"-s0\"", "yy: \"-s0\", xy: 1"), ("[0, \"rate*t*Y\"]", "[▸0, \"rate*t*Y\"]")],
    &["a body in uniaxial strain has an initial shear stress"]
)]
fn a_stress_in_plane_strain_with(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(OEDOMETER, edits, words);
}

/// In a plane: the energy of a law in rate form, and a corner between two fixed walls.
#[rstest]
#[case::an_energy("▸of: strain_energy", &["`linear_elastic` is integrated in rate form"])]
#[case::a_shared_edge(
    "of: reaction, face: ▸left",
    &["the reactions of `left` and", "leave `face` out to judge all walls together"]
)]
fn a_sum_in_a_plane_with(#[case] of: &str, #[case] words: &[&str]) {
    let judged = format!("judge: {{{of}}}\nmethods:");
    let walls = ("{left: fixed}", "{left: fixed, bottom: roller}");
    refused(super::PLATE, &[walls, ("methods:", &judged)], words);
}

#[rstest]
#[case::an_error_below_zero("error_below: ▸-1e-9", &["a bound is -1e-9, but must be above zero"])]
#[case::an_error_below_no_number("error_below: ▸.nan", &["finite"])]
#[case::an_error_above_zero("error_above: ▸0", &["a bound is 0, but must be above zero"])]
#[case::an_error_in_no_interval(
    "error_below: 1e-9\n    error_above: ▸1e-6",
    &["no error is below 1e-9 and above 1e-6"]
)]
#[case::a_drift_of_nothing("drift: ▸{}", &["`drift` is empty", "mass, momentum, angular_momentum"])]
#[case::a_drift_of_something_else("drift: {▸momentun: 1e-12}", &["not a known key", "did you mean `momentum`?"])]
#[case::a_drift_below_zero("drift: {momentum: ▸-1}", &["a bound is -1, but must be above zero"])]
#[case::a_spin_of_a_bar(
    "drift: {▸angular_momentum: 1e-12}",
    &["there is no angular momentum in 1-D"]
)]
#[case::a_rate_without_two_ends("energy_rate: ▸[1e-9]", &["an interval has two ends"])]
#[case::a_rate_that_ends_before_it_starts("energy_rate: ▸[1e-9, -1e-9]", &["expected [low, high]"])]
fn a_bound_with(#[case] bound: &str, #[case] words: &[&str]) {
    refused(BAR, &[(EXPECTED, &format!("    {bound}\n"))], words);
}

#[test]
fn an_energy_beside_an_initial_stress() {
    let bar = include_str!("../../../verification/equilibrium/prestressed-bar.yaml");
    let edits = [("{norm: max_rms}", "{of: ▸energy}")];
    refused(
        bar,
        &edits,
        &["the exact solution does not provide the stored energy of a body with an initial stress"],
    );
}

#[test]
fn a_place_that_is_not_observed() {
    let edits = [("observe: {at: [12.5]}\n", ""), (EXPECTED, "    ▸observed_within: 1e-3\n")];
    refused(
        BAR,
        &edits,
        &[
            "`observed_within` needs an observed point, but the suite has no `observe`",
            "add `observe: {at: [...]}` to the suite",
        ],
    );
}

#[rstest]
#[case::its_drift("▸drift: {momentum: 1e-12}")]
#[case::its_rate("▸energy_rate: [-1, 1]")]
fn a_sum_of_finite_elements(#[case] bound: &str) {
    let bound = FEM_EXPECTED.replace("verdict: too_few_levels", bound);
    let words = ["the built-in FEM does not compute the sums whose drift is bounded here"];
    refused(BAR, &[(FEM_EXPECTED, &bound)], &words);
}

/// In a plane, the stress of a law in rate form has no energy.
#[rstest]
#[case::its_drift("drift: {▸energy: 1e-3}")]
#[case::its_rate("▸energy_rate: [-1e-9, 1e-9]")]
fn an_energy_that_there_is_not(#[case] bound: &str) {
    let words = ["`linear_elastic` is integrated in rate form", "use `neo_hookean` or `hencky`"];
    refused(super::PLATE, &[("verdict: too_few_levels", bound)], &words);
}

#[test]
fn suite_with_bounds_and_one_level_is_valid() {
    let bounds = "    error_below: \"v0\"\n    error_above: 1e-9\n    drift: {mass: 1e-14}\n    observed_within: 1\n";
    let text = BAR.replace(EXPECTED, bounds).replace("cells: [6, 12]", "cells: 12");
    let text = text.replace("{norm: rms}", "{of: velocity, norm: max_linf, scale: v0}");
    valid_suite(&text);
}
