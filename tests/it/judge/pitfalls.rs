//! Known mistakes of verification tools. Each test runs the judge on the critical case.

use approx::assert_abs_diff_eq;
use rstest::rstest;

use super::{halved, judged};
use mpm_verify::verify::{Level, Norms, OrderHypothesis, Verdict, judge};

#[rstest]
fn non_finite_value_fails_on_any_level(
    #[values(0, 2, 4)] level: usize,
    #[values(f64::NAN, f64::INFINITY, f64::NEG_INFINITY)] figure: f64,
    #[values(true, false)] usable: bool,
) {
    let mut series = halved(5, |h| h * h);
    series[level].error = figure;
    series[level].usable = usable;
    assert_eq!(judge(&series, &OrderHypothesis::formal(2.0)).verdict, Verdict::Failed);
    series[level] = Level::new(figure, 1.0);
    assert_eq!(judge(&series, &OrderHypothesis::formal(2.0)).verdict, Verdict::Failed);
}

/// If a ratio of two were assumed, the last pair of this series of order 2 would have the order
/// 0.83.
#[test]
fn the_true_ratio_of_spacings_is_used() {
    let cells = [5.0, 10.0, 20.0, 40.0, 60.0, 80.0, 120.0, 160.0];
    let series = cells.map(|n| Level::new(25.0 / n, 3.0 / (n * n)));
    let judgement = judge(&series, &OrderHypothesis::formal(2.0));
    assert_eq!(judgement.verdict, Verdict::Converging, "{}", judgement.reason);
    for order in &judgement.pairwise[1..] {
        assert_abs_diff_eq!(order.unwrap(), 2.0, epsilon = 1e-12);
    }
}

#[rstest]
#[case::tolerance_of_100(OrderHypothesis::within(2.0, -98.0, 102.0))]
#[case::wide_but_positive(OrderHypothesis::within(2.0, 0.5, 3.5))]
#[case::nan(OrderHypothesis::within(2.0, f64::NAN, f64::NAN))]
#[case::nan_formal_order(OrderHypothesis::formal(f64::NAN))]
fn a_claim_that_everything_meets_is_refused(#[case] claim: OrderHypothesis) {
    let judgement = judge(&halved(5, |h| h * h), &claim);
    assert_eq!(judgement.verdict, Verdict::Failed, "{}", judgement.reason);
}

/// If the field and the solution are both zero, there is no evidence of convergence.
#[test]
fn no_error_at_all_is_not_convergence() {
    assert_eq!(judged(&[0.0; 6], 2.0).verdict, Verdict::AtFloor);
    assert!(Norms::of(&[], 1, &[]).linf.is_nan());
}

/// The end points have order 2, but not the points between them.
#[rstest]
#[case(&[1.0, 0.9, 0.8, 0.7, 0.003_906_25])]
#[case(&[1.0, 0.005, 0.005, 0.004, 0.003_906_25])]
#[case(&[1.0, 0.01, 0.4, 0.008, 0.003_906_25])]
fn intermediate_levels_count(#[case] errors: &[f64]) {
    let verdict = judged(errors, 2.0).verdict;
    assert_ne!(verdict, Verdict::Converging);
}

/// The order alone would pass. The gate checks the interval, on both sides.
#[rstest]
#[case(1.95)]
#[case(2.05)]
fn an_order_inside_with_an_interval_outside_does_not_pass(#[case] order: f64) {
    let noise = [1.04, 0.96, 0.97, 1.04, 1.0];
    let mut series = halved(5, |h| libm::pow(h, order));
    series.iter_mut().zip(noise).for_each(|(level, noise)| level.error *= noise);
    let judgement = judge(&series, &OrderHypothesis::formal(2.0));
    assert_abs_diff_eq!(judgement.order.unwrap().value, 2.0, epsilon = 0.1);
    assert_eq!(judgement.verdict, Verdict::PreAsymptotic, "{}", judgement.reason);
    assert!(judgement.reason.contains("extends beyond"));
}

/// An order outside the range, whose interval overlaps the range, is undecided.
#[rstest]
#[case(1.85, 0.06, Verdict::TooLow, "below [1.9, 2.1], but the interval overlaps this range")]
#[case(2.15, 0.06, Verdict::TooGood, "above [1.9, 2.1], but the interval overlaps this range")]
#[case(1.5, 0.01, Verdict::TooLow, "below [1.9, 2.1]")]
#[case(2.5, 0.01, Verdict::TooGood, "above [1.9, 2.1]")]
fn an_order_out_of_the_range_may_be_undecided(
    #[case] order: f64,
    #[case] noise: f64,
    #[case] verdict: Verdict,
    #[case] words: &str,
) {
    let signs = [1.0, -1.0, -1.0, 1.0, 0.0];
    let mut series = halved(5, |h| libm::pow(h, order));
    series.iter_mut().zip(signs).for_each(|(level, sign)| level.error *= 1.0 + sign * noise);
    let judgement = judge(&series, &OrderHypothesis::formal(2.0));
    assert_eq!(judgement.verdict, verdict, "{}", judgement.reason);
    assert!(judgement.reason.contains(words), "{}", judgement.reason);
    let undecided = judgement.reason.ends_with("the interval overlaps this range: not decided");
    let interval = judgement.order.unwrap();
    assert_eq!(undecided, interval.low <= 2.1 && interval.high >= 1.9);
}

/// The judge must show the fitted levels, and must not remove an outlier among them.
#[test]
fn outlier_on_any_level_is_kept() {
    for outlier in 1..7 {
        let mut series = halved(8, |h| h * h);
        series[outlier].error *= 5.0;
        let judgement = judge(&series, &OrderHypothesis::formal(2.0));
        assert_eq!(judgement.verdict, Verdict::PreAsymptotic, "{}", judgement.reason);
        assert_eq!(judgement.window, Some((0..8).collect()));
    }
}

#[test]
fn a_drift_through_the_expected_range_is_not_settled() {
    let orders = [2.2, 2.15, 2.1, 2.05, 2.0, 1.95, 1.9, 1.85];
    let mut errors = vec![1.0];
    for order in orders {
        errors.push(errors[errors.len() - 1] * libm::exp2(-order));
    }
    let judgement = judged(&errors, 2.0);
    assert_eq!(judgement.verdict, Verdict::PreAsymptotic, "{}", judgement.reason);
    assert!(judgement.reason.contains("drifts by -0.400"), "{}", judgement.reason);
}
