//! Materials and their parameters.

use super::samples::BAR;
use super::{Edits, refused};
use crate::common::valid_suite;
use rstest::rstest;

const ELASTIC: &str = "{linear_elastic: {young: E, poisson: 0, density: rho}}";

#[rstest]
#[case::an_unknown_material(&[("linear_elastic", "▸linear_elastik")], &["unknown name `linear_elastik`", "did you mean `linear_elastic`?"])]
#[case::no_such_material(&[("linear_elastic", "▸rubber")], &["unknown name `rubber`", "j2"])]
#[case::two_materials(
    &[(ELASTIC, "▸{hencky: {young: E, poisson: 0, density: rho}, j2: {}}")],
    &["one name with its settings is expected here, found none or several"]
)]
#[case::a_parameter_of_another(
    &[(ELASTIC, "{newtonian: {bulk: E, viscosity: 0, density: rho, ▸poisson: 0}}")],
    &["unknown key `poisson`", "bulk"]
)]
#[case::a_misspelt_parameter(
    &[(ELASTIC, "{newtonian: {bulk: E, ▸viscositi: 0, density: rho}}")],
    &["unknown key `viscositi`", "did you mean `viscosity`?"]
)]
#[case::a_solid_without_yield_stress(
    &[(ELASTIC, "{j2: ▸{young: E, poisson: 0, density: rho}}")],
    &["missing key `yield` in `j2`", "add `yield: 1`"]
)]
#[case::a_yield_stress_of_zero(
    &[(ELASTIC, "{j2: {young: E, poisson: 0, yield: ▸0, density: rho}}")],
    &["the yield stress is 0, but must be above zero"]
)]
#[case::softening(
    &[(ELASTIC, "{j2: {young: E, poisson: 0, yield: 1, hardening: ▸\"-E\", density: rho}}")],
    &["the hardening modulus is -100, but must not be below zero", "expected zero or a positive number"]
)]
#[case::a_fluid_without_stiffness(
    &[(ELASTIC, "{newtonian: {bulk: ▸0, viscosity: 1, density: rho}}")],
    &["the bulk modulus is 0, but must be above zero"]
)]
#[case::a_negative_viscosity(
    &[(ELASTIC, "{newtonian: {bulk: E, viscosity: ▸-1, density: rho}}")],
    &["the viscosity is -1, but must not be below zero"]
)]
#[case::a_hencky_solid_that_is_not_stable(
    &[(ELASTIC, "{hencky: {young: E, poisson: ▸0.5, density: rho}}")],
    &["Poisson's ratio is 0.5", "expected a number above -1 and below 0.5"]
)]
#[case::dilation_above_friction(
    &[(ELASTIC, "{drucker_prager: {young: E, poisson: 0, friction: 0.1, dilation: ▸0.3, strength: 1, density: rho}}")],
    &["the coefficient of dilation is above that of friction", "does negative work"]
)]
#[case::a_dilation_angle_above_the_friction_angle(
    &[(ELASTIC, "{mohr_coulomb: {young: E, poisson: 0, friction_angle: 20, dilation_angle: ▸30, cohesion: 1, density: rho}}")],
    &["the dilation angle is above the friction angle"]
)]
#[case::a_friction_angle_of_a_right_angle(
    &[(ELASTIC, "{mohr_coulomb: {young: E, poisson: 0, friction_angle: ▸90, dilation_angle: 0, cohesion: 1, density: rho}}")],
    &["the friction angle is 90 degrees", "at least 0 and less than 90"]
)]
#[case::a_negative_cohesion(
    &[(ELASTIC, "{mohr_coulomb: {young: E, poisson: 0, friction_angle: 30, dilation_angle: 0, cohesion: ▸-1, density: rho}}")],
    &["the cohesion is -1, but must not be below zero"]
)]
#[case::clay_that_swells_more_than_it_compacts(
    &[(ELASTIC, "{cam_clay: {critical_state_slope: 1.2,\n      swelling_slope: ▸0.1, compression_slope: 0.1, poisson: 0.25,\n      initial_pressure: 100, preconsolidation: 150, density: rho}}")],
    &["the slope of swelling is not below that of compression", "plastic compaction"]
)]
#[case::clay_outside_its_yield_surface(
    &[(ELASTIC, "{cam_clay: {critical_state_slope: 1.2,\n      swelling_slope: 0.02, compression_slope: 0.1, poisson: 0.25,\n      initial_pressure: 100, preconsolidation: ▸50, density: rho}}")],
    &["the preconsolidation pressure is below the initial pressure", "outside its yield surface"]
)]
#[case::clay_without_pressure(
    &[(ELASTIC, "{cam_clay: {critical_state_slope: 1.2,\n      swelling_slope: 0.02, compression_slope: 0.1, poisson: 0.25,\n      initial_pressure: ▸0, preconsolidation: 150, density: rho}}")],
    &["the initial pressure is 0, but must be above zero"]
)]
#[case::clay_that_is_incompressible(
    &[(ELASTIC, "{cam_clay: {critical_state_slope: 1.2,\n      swelling_slope: 0.02, compression_slope: 0.1, poisson: ▸0.5,\n      initial_pressure: 100, preconsolidation: 150, density: rho}}")],
    &["Poisson's ratio is 0.5"]
)]
fn a_bar_with(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(BAR, edits, words);
}

const EXACT: &str =
    "exact:\n  equation: small_strain\n  displacement: [\"v0/omega*mode(X)*sin(omega*t)\"]\n";
const REFERENCE: &str = "reference:\n  equation: hencky\n  fem: {element: linear, mass: lumped, cells: 100, dt: \"1e-3/omega\"}\n";

#[rstest]
#[case::an_fem_bar_that_would_have_to_flow(
    &[(EXACT, REFERENCE), (ELASTIC, "{j2: {young: E, poisson: 0, yield: 1, density: rho}}"), ("- fem:", "- ▸fem:")],
    &["the built-in FEM does not support the law `j2`", "name the `law` of an elastic bar"]
)]
#[case::a_fluid_as_reference(
    &[(EXACT, REFERENCE), ("reference:", "▸reference:"), (ELASTIC, "{newtonian: {bulk: E, viscosity: 1, density: rho}}")],
    &["the built-in FEM is a solid bar, but `newtonian` has no Young's modulus"]
)]
fn a_reference_with(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(BAR, edits, words);
}

/// The bar has an elastic reference that the suite names, and the FEM case names its law too.
#[test]
fn plastic_bar_with_reference_and_law_is_valid() {
    let solid = "{j2: {young: E, poisson: 0, yield: 1, hardening: 2, density: rho}}";
    let sound = BAR
        .replace(EXACT, REFERENCE)
        .replace(ELASTIC, solid)
        .replace("mass: lumped}\n\njudge", "mass: lumped, law: hencky}\n\njudge");
    valid_suite(&sound);
}
