//! Scales for comparing errors and work between cases, for a bar with an exact solution.

use crate::cli::BAR;
use crate::common::valid_suite;
use approx::assert_relative_eq;
use mpm_verify::study::Runner;
use mpm_verify::verify::ErrorScale;
use rstest::rstest;

/// Returns the scale of the first case of the bar. In its text, `from` is replaced by `to`.
fn scale(from: &str, to: &str) -> ErrorScale {
    let text = BAR.replace(from, to);
    assert!(text != BAR || from == to, "no `{from}`");
    let outcome = Runner::new(&valid_suite(&text)).run(&|| ());
    outcome.cases[0].convergence().unwrap().error_scale.clone()
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
