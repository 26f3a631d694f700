//! Tests of Richardson extrapolation from three values.

use approx::assert_relative_eq;
use rstest::rstest;

use RichardsonClass::{
    Degenerate, Exact, Failed, MonotoneConvergent, MonotoneDivergent, OscillatoryConvergent,
    OscillatoryDivergent,
};
use mpm_verify::verify::{Richardson, RichardsonClass};

#[rstest]
#[case([16.0, 4.0, 1.0], 4.0, MonotoneConvergent)]
#[case([-16.0, -4.0, -1.0], 4.0, MonotoneConvergent)]
#[case([3.0, 1.0, 2.0], -2.0, OscillatoryConvergent)]
#[case([1.0, 2.0, 4.0], 0.5, MonotoneDivergent)]
#[case([1.0, 2.0, 3.0], 1.0, MonotoneDivergent)]
#[case([1.0, 2.0, 0.0], -0.5, OscillatoryDivergent)]
#[case([1.0, 2.0, 1.0], -1.0, OscillatoryDivergent)]
fn classes(#[case] values: [f64; 3], #[case] ratio: f64, #[case] class: RichardsonClass) {
    let richardson = Richardson::equal_ratio(values, 2.0);
    assert_eq!(richardson.class, class);
    assert_relative_eq!(richardson.ratio, ratio);
    let convergent = class == MonotoneConvergent;
    assert_eq!(richardson.order.is_some(), convergent);
    assert_eq!(richardson.extrapolated.is_some(), convergent);
}

#[rstest]
#[case([1.0, 1.0, 1.0], 2.0, Exact)]
#[case([2.0, 1.0, 1.0], 2.0, Degenerate)]
#[case([1.0, 1.0, 2.0], 2.0, Degenerate)]
#[case([1.0, f64::NAN, 2.0], 2.0, Failed)]
#[case([f64::INFINITY, 2.0, 1.0], 2.0, Failed)]
#[case([f64::MAX, -f64::MAX, 1.0], 2.0, Failed)]
#[case([16.0, 4.0, 1.0], 1.0, Failed)]
#[case([16.0, 4.0, 1.0], 0.5, Failed)]
#[case([16.0, 4.0, 1.0], -2.0, Failed)]
#[case([16.0, 4.0, 1.0], f64::NAN, Failed)]
fn values_without_an_order_have_no_limit(
    #[case] values: [f64; 3],
    #[case] ratio: f64,
    #[case] class: RichardsonClass,
) {
    let richardson = Richardson::equal_ratio(values, ratio);
    assert_eq!(richardson.class, class);
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
    assert_eq!(richardson.class, MonotoneConvergent);
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
    assert_eq!(Richardson::new(h, values).class, MonotoneDivergent);
}

#[test]
fn classes_have_names() {
    assert_eq!(MonotoneConvergent.to_string(), "monotone convergent");
    assert_eq!(format!("{Exact:>8}"), "   exact");
}
