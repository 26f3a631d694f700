//! Initial stresses: invalid laws, scenes and studies, and exact solutions that do not balance the
//! stresses.

use super::{Edits, refused};
use rstest::rstest;

const BAR: &str = include_str!("../../../verification/equilibrium/prestressed-bar.yaml");
const SLOPE: &str = include_str!("../../../verification/equilibrium/geostatic-slope.yaml");
const RATE: &str = include_str!("../../../verification/equilibrium/released-bar.yaml");
const LONG: &str = include_str!("../../../verification/conservation/vibrating-bar-long.yaml");
const HEATED: &str = include_str!("../../../verification/heat/thermal-expansion-clamped.yaml");
const RIGID: &str = include_str!("../../../verification/heat/heat-2d.yaml");
const SOIL: &str = include_str!("../../../verification/soils/geostatic-mohr-coulomb.yaml");
const PATH: &str = include_str!("../../../verification/soils/path-mohr-coulomb-stressed.yaml");
const CLAY: &str = include_str!("../../../verification/soils/clay-at-rest.yaml");
const FROZEN: &str = include_str!("../../../verification/stability/courant-limit.yaml");

/// Some laws, scenes and studies do not allow an initial stress.
#[rstest]
#[case::outside_the_yield_surface(
    SOIL,
    &[("cohesion: coh", "cohesion: 0.5*coh"), ("  initial_stress", "  ▸initial_stress")],
    &["violates the yield condition of `mohr_coulomb`: f = ", "at (0, 0) m", "f must not be positive"]
)]
#[case::without_the_stress_across(
    SOIL,
    &[(", zz: \"-K0*G*(H - Y)\"}", "}"), ("  initial_stress", "  ▸initial_stress")],
    &["`initial_stress` does not state `zz`", "all three normal stresses"]
)]
#[case::a_shear_across(
    SOIL,
    &[("zz: \"-K0", "▸yz: 1, zz: \"-K0")],
    &["`yz` is not a stress component in 2-D", "components: `xx`, `yy`, `zz`, `xy`"]
)]
#[case::across_for_an_elastic_law(
    BAR,
    &[("{xx: S0}", "{xx: S0, ▸zz: 1}")],
    &["`zz` is not a stress component in 1-D", "components: `xx`"]
)]
#[case::of_clay(
    CLAY,
    &[("  loads:", "  ▸initial_stress: {xx: 1}\n  loads:")],
    &["a `cam_clay` body does not support an initial stress", "starts under its `initial_pressure`"]
)]
#[case::of_a_fluid(
    BAR,
    &[
        ("hencky: {young: E, poisson: 0", "newtonian: {bulk: E, viscosity: 0"),
        ("  initial_stress", "  ▸initial_stress"),
    ],
    &["a `newtonian` body does not support an initial stress", "state an `initial_displacement`"]
)]
#[case::of_a_body_at_rest(
    RIGID,
    &[("  loads:", "  ▸initial_stress: {xx: 1}\n  loads:")],
    &["a `rigid` body does not support an initial stress"]
)]
#[case::a_component_below_the_diagonal(
    SLOPE,
    &[("xy: \"along*top(Y)\"", "▸yx: \"along*top(Y)\"")],
    &["unknown key `yx`", "possible keys: `xx`, `yy`, `zz`, `xy`"]
)]
#[case::no_component(
    BAR,
    &[("{xx: S0}", "▸{}")],
    &["`initial_stress` states no component", "components: `xx`"]
)]
#[case::a_stress_that_depends_on_time(
    BAR,
    &[("{xx: S0}", "{xx: \"S0*▸t\"}")],
    &["`t`"]
)]
#[case::beside_a_list_of_bodies(
    SLOPE,
    &[("  boundary:", "  ▸initial_stress: {xx: 1}\n  boundary:")],
    &["`initial_stress` is for a single body"]
)]
#[case::beside_expansion(
    HEATED,
    &[
        ("  loads:", "  initial_stress: {xx: 1}\n  loads:"),
        ("- thermal_expansion", "- ▸thermal_expansion"),
    ],
    &["`thermal_expansion` is not supported with an initial stress"]
)]
#[case::in_finite_elements(
    RATE,
    &[("  initial_displacement", "  ▸initial_stress: {xx: 0}\n  initial_displacement")],
    &["the built-in FEM does not support an initial stress"]
)]
#[case::whose_energy_is_not_known(
    LONG,
    &[
        ("  initial_velocity", "  initial_stress: {xx: 0}\n  initial_velocity"),
        ("    energy_rate", "    ▸energy_rate"),
    ],
    &["the law `linear_elastic` is integrated in rate form and has no stored energy with an initial stress"]
)]
#[case::of_a_frozen_body(
    FROZEN,
    &[("scene:", "scene:\n  initial_stress: {xx: 1}"), ("frozen: true", "▸frozen: true")],
    &["a frozen run must start at rest, without loads and without initial stress"]
)]
fn refusal(#[case] suite: &str, #[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(suite, edits, words);
}

/// The solutions use the wave speed of the law alone, a weight without support, a surface that is
/// not free, and an interface with different tractions.
#[rstest]
#[case::soil_with_different_lateral_stresses(
    PATH,
    &[("zz: \"-l0\"", "zz: \"-0.9*l0\""), ("[\"rate*t*X", "[▸\"rate*t*X")],
    &["the lateral initial stresses yy and zz differ"]
)]
#[case::soil_strained_on_two_axes(
    SOIL,
    &[("displacement: [0, 0]", "displacement: [▸\"1e-3*X*t^2\", \"1e-3*Y*t^2\"]")],
    &["is known in uniaxial strain only, but du_Y/dY is not zero"]
)]
#[case::the_speed_of_the_law_alone(
    BAR,
    &[("c: \"sqrt((E + S0)/rho)\"", "c: \"sqrt(E/rho) + 0*S0\""), ("[\"A*sin", "[▸\"A*sin")],
    &["equation of motion in X"]
)]
#[case::a_weight_that_is_borne_in_part(
    SLOPE,
    &[("yy: \"-across*top(Y)\"", "yy: \"-0.99*across*top(Y)\""), ("displacement: [0", "displacement: [▸0")],
    &["equation of motion in Y"]
)]
#[case::a_surface_under_load(
    SLOPE,
    &[("top(Y): \"upper*(2*H - Y)", "top(Y): \"upper*(2.1*H - Y)"), ("displacement: [0", "displacement: [▸0")],
    &["boundary condition: top is free, traction in"]
)]
#[case::a_joint_out_of_balance(
    SLOPE,
    &[("base(Y): \"upper*H", "base(Y): \"0.9*upper*H"), ("displacement: [0", "displacement: [▸0")],
    &["their tractions in"]
)]
fn no_balance(#[case] suite: &str, #[case] edits: Edits<'_>, #[case] words: &[&str]) {
    refused(suite, edits, words);
}
