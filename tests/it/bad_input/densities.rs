//! Gases, and densities that vary over the body.

use super::{Edits, refused};
use rstest::rstest;

const CLOUD: &str = include_str!("../../../verification/plasticity-and-fluids/gas-cloud.yaml");
const SPINNING: &str =
    include_str!("../../../verification/plasticity-and-fluids/spinning-cloud.yaml");
const RADIUS: &str =
    include_str!("../../../verification/plasticity-and-fluids/spinning-cloud-radius.yaml");

/// The density of the cloud in 1-D.
const LINE: &str = "\"sqrt(A*(1 - X^2))\"";
const PLANE: &str = "\"A*(1 - X^2 - Y^2)\"";
const GAS: &str = "polytropic: {stiffness: K, exponent: 2, density";

#[rstest]
#[case::an_exponent_of_one(
    &[("exponent: 3", "exponent: ▸1")],
    &["the exponent is 1, but must be above one", "expected a number above 1"]
)]
#[case::no_exponent(
    &[("{stiffness: K, exponent: 3,", "▸{stiffness: K,")],
    &["missing key `exponent` in `polytropic`"]
)]
#[case::no_stiffness(
    &[("stiffness: K", "stiffness: ▸0")],
    &["the stiffness is 0, but must be above zero"]
)]
#[case::an_exponent_that_varies(
    &[("exponent: 3", "exponent: \"3 + ▸X\"")],
    &["unknown name `X`", "only the density of a material can vary over a body"]
)]
#[case::a_density_of_zero(
    &[(LINE, "▸0")],
    &["the density is 0, but must be above zero"]
)]
#[case::a_density_below_zero_in_a_part(
    &[(LINE, "▸\"A*(X + 0.5)\"")],
    &["the density is -0.", "kg/m3 at (-0.", "expected a positive density inside the body"]
)]
#[case::a_density_that_is_zero_inside(
    &[(LINE, "▸\"A*abs(X)*step(X)\"")],
    &["the density is 0 kg/m3 at (-0.", "at least zero on its rim"]
)]
#[case::a_density_that_is_no_number_in_a_part(
    &[(LINE, "▸\"sqrt(A*(0.5 - X^2))\"")],
    &["the density is NaN kg/m3 at (-0."]
)]
#[case::a_density_of_a_coordinate_of_more_dimensions(
    &[(LINE, "\"1 + ▸Y\"")],
    &["unknown name `Y`", "the variables are `X`"]
)]
#[case::a_density_of_time(&[(LINE, "\"1 + ▸t\"")], &["unknown name `t`"])]
#[case::another_acceleration(
    &[("\"sqrt(1 + C*t^2)\"", "\"sqrt(1 + 1.01*C*t^2)\""), ("[\"(a(t)", "[▸\"(a(t)")],
    &["equation of motion in X"]
)]
#[case::another_density(
    &[(LINE, "\"1.01*sqrt(A*(1 - X^2))\""), ("[\"(a(t)", "[▸\"(a(t)")],
    &["equation of motion in X"]
)]
#[case::a_uniform_density(
    &[(LINE, "A"), ("[\"(a(t)", "[▸\"(a(t)")],
    &["boundary condition", "is free, traction in X"]
)]
#[case::a_pressure_on_a_free_surface(
    &[(LINE, "\"sqrt(A*(1.5 - X^2))\""), ("[\"(a(t)", "[▸\"(a(t)")],
    &["boundary condition", "traction in X"]
)]
fn clouds_on_a_line(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(CLOUD, edits, words);
}

#[rstest]
#[case::a_solid_without_density_on_its_rim(
    &[(GAS, "neo_hookean: {young: K, poisson: 0, density"), (PLANE, "▸\"A*(1 - X^2 - Y^2)\"")],
    &["the density is zero on the rim, where the wave speed of `neo_hookean` is unbounded"]
)]
#[case::a_polygon(
    &[
        ("disk: {centre: [0, 0], radius: 1}", "polygon: [[0, 0], [0.5, 0], [0, 0.5]]"),
        (PLANE, "▸\"A*(1 - X^2 - Y^2)\""),
    ],
    &["a density that varies over the body is not supported here", "in a box or a round body only"]
)]
#[case::a_body_of_revolution(
    &[("dimension: 2", "dimension: 2\n  plane: axisymmetric"), (PLANE, "▸\"A*(1 - X^2 - Y^2)\"")],
    &["a density that varies over the body is not supported here", "not integrated in a body of revolution"]
)]
#[case::negative_in_the_corners(
    &[
        ("disk: {centre: [0, 0], radius: 1}", "box: {from: [-1, -1], to: [1, 1]}"),
        (PLANE, "▸\"A*(1 - X^2 - Y^2)\""),
    ],
    &["the density is -0.", "kg/m3 at (-0."]
)]
fn clouds_in_a_plane(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(SPINNING, edits, words);
}

#[rstest]
#[case::weighted_by_mass(
    &[("radius_of_gyration}", "radius_of_gyration, norm: ▸mass_l2}")],
    &["the radius of gyration is one number for the whole body, so `mass_l2`, a norm over particles, does not apply", "use `rms`"]
)]
#[case::the_largest_weighted_by_mass(
    &[("radius_of_gyration}", "radius_of_gyration, norm: ▸max_mass_l2}")],
    &["the radius of gyration is one number for the whole body, so a norm over particles does not apply"]
)]
#[case::of_no_known_name(
    &[("radius_of_gyration}", "▸radius_of_giration}")],
    &["unknown name `radius_of_giration`", "did you mean `radius_of_gyration`?"]
)]
fn radii(#[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(RADIUS, edits, words);
}
