//! Scales for comparing errors and work between cases, for a bar with an exact solution.

use crate::cli::BAR;
use crate::common::cases;
use crate::common::solver::{Solver, prescribed, solver};
use approx::assert_relative_eq;
use mpm_verify::prelude::*;
use mpm_verify::subject::Precision;
use mpm_verify::suite::yaml::Source;
use mpm_verify::verify::ErrorScale;
use rstest::rstest;

/// Returns the scale of the first case of the bar. In its text, `from` is replaced by `to`.
fn scale(from: &str, to: &str) -> ErrorScale {
    let text = BAR.replace(from, to);
    assert!(text != BAR || from == to, "no `{from}`");
    cases(&text)[0].convergence().unwrap().error_scale.clone()
}

/// The largest displacement is that of the free end, 1e-3 sin(omega t)/omega, an eighth of a period
/// after the start.
#[test]
fn size_is_the_largest_displacement() {
    let largest = 1e-3 * 0.5_f64.sqrt() / (5.0 * std::f64::consts::PI);
    assert_relative_eq!(scale("", "").size, largest, max_relative = 1e-12);
    let stated = "judge: {scale: 1e-4}\nobserve:";
    assert_relative_eq!(scale("observe:", stated).size, 1.0);
}

/// The growth is one for the axis of the bar, plus the power of the spacing in the step.
#[rstest]
#[case::constant("dt: 1e-3", 1.0)]
#[case::with_the_spacing("dt: \"h/250\"", 2.0)]
#[case::with_its_square("dt: \"h^2/63\"", 3.0)]
fn work_grows_with_the_steps(#[case] dt: &str, #[case] growth: f64) {
    assert_relative_eq!(scale("dt: 1e-3", dt).growth, growth, max_relative = 0.05);
}

const STRETCHED: &str = r#"suite: stretched
title: Stretched bar
source: none
scene:
  dimension: 1
  body: {box: {from: [-3000], to: [-1400]}}
  material: {linear_elastic: {young: 1e6, poisson: 0, density: 1}}
exact: {equation: small_strain, displacement: ["(X + 3000)/80*(t/0.099)^2"]}
run: {until: 0.099, dt: 1e-3}
refine: {cells: [4, 6, 8, 12], ppc: 4}
methods: [{mpm: {basis: linear, transfer: flip, scheme: usl}}]
judge: {of: OF, scale: 1e-3}
"#;

/// The bar ends at -3000 m, and its right end moves by 20 m and at up to 404 m/s. Its modulus is
/// 1e6 Pa, and its strain 0.0125. By hand, the rounding error of 99 steps of positions of up to
/// 3000 m plus 20 m is 8 sqrt(100) 3020 m 2^-53. The unit of single precision is 2^29
/// times as large.
#[rstest]
#[case::displacement("displacement", Precision::Double, 3020.0)]
#[case::velocity("velocity", Precision::Double, 40.0 / 0.099)]
#[case::stress("stress", Precision::Double, 1e6)]
#[case::gradient("deformation_gradient", Precision::Double, 1.0)]
#[case::single("velocity", Precision::Single, 40.0 / 0.099 * libm::exp2(29.0))]
fn rounding_errors_are_those_of_the_largest_number(
    #[case] of: &str,
    #[case] precision: Precision,
    #[case] number: f64,
) {
    let text = STRETCHED.replace("OF", of);
    let source = Source::from_text("bar.yaml", text).expect("a text").trusted();
    let suite = Suite::load(&source).unwrap_or_else(|diagnostic| panic!("{diagnostic}"));
    let still = solver("still", |problem| {
        Ok(prescribed(problem, |problem, _, samples| {
            samples.stress = vec![0.0; problem.particles.len()];
            samples.deformation_gradient = vec![1.0; problem.particles.len()];
        }))
    });
    let solver = Solver { precision, ..still };
    let gated = under(&suite, &solver, true).expect("a study");
    let case = Runner::new(&gated).judging(&solver).case(0, &|| ());
    let study = case.convergence().expect(&case.reason);
    let bound = study.levels[0].rounding_bound.expect("a bound");
    assert_relative_eq!(bound, 80.0 * number * libm::exp2(-53.0), max_relative = 1e-9);
}
