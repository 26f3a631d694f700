//! Tests of Richardson extrapolation from three values.

use approx::assert_relative_eq;
use mpm_verify::verify::Richardson;
use rstest::rstest;

/// Extrapolates three values, coarse to fine, with two equal refinements by `ratio`.
fn equal_ratio(values: [f64; 3], ratio: f64) -> Richardson {
    Richardson::new([ratio * ratio, ratio, 1.0], values)
}

#[rstest]
#[case::monotone_convergence([16.0, 4.0, 1.0], 4.0, true)]
#[case::monotone_convergence_from_below([-16.0, -4.0, -1.0], 4.0, true)]
#[case::oscillatory_convergence([3.0, 1.0, 2.0], -2.0, false)]
#[case::monotone_divergence([1.0, 2.0, 4.0], 0.5, false)]
#[case::equal_changes([1.0, 2.0, 3.0], 1.0, false)]
#[case::oscillatory_divergence([1.0, 2.0, 0.0], -0.5, false)]
#[case::equal_changes_of_alternating_sign([1.0, 2.0, 1.0], -1.0, false)]
fn only_monotone_convergence_has_an_order(
    #[case] values: [f64; 3],
    #[case] ratio: f64,
    #[case] converges: bool,
) {
    let richardson = equal_ratio(values, 2.0);
    assert_relative_eq!(richardson.ratio, ratio);
    assert_eq!(richardson.order.is_some(), converges);
    assert_eq!(richardson.extrapolated.is_some(), converges);
}

#[rstest]
#[case([1.0, 1.0, 1.0], 2.0)]
#[case([2.0, 1.0, 1.0], 2.0)]
#[case([1.0, 1.0, 2.0], 2.0)]
#[case([1.0, f64::NAN, 2.0], 2.0)]
#[case([f64::INFINITY, 2.0, 1.0], 2.0)]
#[case([f64::MAX, -f64::MAX, 1.0], 2.0)]
#[case([16.0, 4.0, 1.0], 1.0)]
#[case([16.0, 4.0, 1.0], 0.5)]
#[case([16.0, 4.0, 1.0], -2.0)]
#[case([16.0, 4.0, 1.0], f64::NAN)]
fn values_without_an_order_have_no_limit(#[case] values: [f64; 3], #[case] ratio: f64) {
    let richardson = equal_ratio(values, ratio);
    assert_eq!(richardson.order, None);
    assert_eq!(richardson.extrapolated, None);
}

/// For `u(h) = 3 + 2 h^p` the results must be p and 3.
#[rstest]
fn a_power_of_h_is_recovered(
    #[values(0.5, 1.0, 5.0 / 3.0, 2.0, 6.0)] order: f64,
    #[values([4.0, 2.0, 1.0], [5.0, 2.5, 1.6], [25.0 / 40.0, 25.0 / 60.0, 25.0 / 80.0])] h: [f64;
        3],
) {
    let values = h.map(|h| 3.0 + 2.0 * libm::pow(h, order));
    let richardson = Richardson::new(h, values);
    assert_relative_eq!(richardson.order.unwrap(), order, max_relative = 1e-9);
    assert_relative_eq!(richardson.extrapolated.unwrap(), 3.0, max_relative = 1e-9);
}

/// A negative order means divergence, for any spacings.
#[rstest]
fn a_negative_power_of_h_diverges(
    #[values(-0.2, -1.0)] order: f64,
    #[values([4.0, 2.0, 1.0], [5.0, 2.5, 1.6])] h: [f64; 3],
) {
    let values = h.map(|h| 3.0 + libm::pow(h, order));
    assert_eq!(Richardson::new(h, values).order, None);
}
