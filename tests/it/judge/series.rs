//! Synthetic series with their expected verdicts.

use approx::assert_abs_diff_eq;
use rstest::rstest;

use super::{Random, halved, halvings, judged};
use mpm_verify::verify::{Level, OrderHypothesis, Verdict, judge};

const POWERS_OF_4: [f64; 6] = [1.0, 0.25, 0.0625, 0.015_625, 0.003_906_25, 0.000_976_562_5];

#[rstest]
fn a_pure_order_is_converging(
    #[values(1.0, 5.0 / 3.0, 2.0, 3.0)] order: f64,
    #[values(4, 5, 8)] levels: usize,
) {
    let series = halved(levels, |h| 7.0 * libm::pow(h, order));
    let judgement = judge(&series, &OrderHypothesis::formal(order));
    assert_eq!(judgement.verdict, Verdict::Converging, "{}", judgement.reason);
    assert_eq!(judgement.window, Some((0..levels).collect()));
    assert_abs_diff_eq!(judgement.order.unwrap().value, order, epsilon = 1e-12);
}

#[rstest]
fn noise_of_two_per_cent_does_not_change_the_verdict(
    #[values(1.0, 5.0 / 3.0, 2.0, 3.0)] order: f64,
) {
    let mut random = Random(1);
    let mut series = halved(7, |h| libm::pow(h, order));
    random.disturb(&mut series, 0.02);
    let judgement = judge(&series, &OrderHypothesis::formal(order));
    assert_eq!(judgement.verdict, Verdict::Converging, "{}", judgement.reason);
}

#[rstest]
#[case::order_60(60.0, 2.0, Verdict::TooGood)]
#[case::order_3_for_2(3.0, 2.0, Verdict::TooGood)]
#[case::order_1_for_2(1.0, 2.0, Verdict::TooLow)]
#[case::order_1_85_for_2(1.85, 2.0, Verdict::TooLow)]
#[case::order_minus_1(-1.0, 1.0, Verdict::Divergent)]
#[case::order_minus_3(-3.0, 2.0, Verdict::Divergent)]
#[case::order_0(0.0, 2.0, Verdict::AtFloor)]
#[case::order_2_3_for_2(2.3, 2.0, Verdict::TooGood)]
fn pure_order_is_judged_against_another_order(
    #[case] order: f64,
    #[case] formal: f64,
    #[case] expected: Verdict,
) {
    let judgement = judge(&halved(6, |h| libm::pow(h, order)), &OrderHypothesis::formal(formal));
    assert_eq!(judgement.verdict, expected, "{}", judgement.reason);
}

#[rstest]
#[case::flat(&[1.0, 1.02, 0.99, 1.01, 1.0], Verdict::AtFloor)]
#[case::all_zeros(&[0.0; 5], Verdict::AtFloor)]
#[case::oscillating(&[1.0, 2.0, 1.0, 2.0, 1.0], Verdict::Oscillatory)]
#[case::oscillating_irregularly(&[1.0, 3.0, 0.8, 2.0, 0.5, 2.5], Verdict::Oscillatory)]
#[case::outlier_in_the_middle(&[1.0, 0.25, 0.0625, 0.078, 0.0039, 0.00098, 0.000_244], Verdict::PreAsymptotic)]
#[case::outlier_downwards(&[1.0, 0.25, 0.0625, 0.0031, 0.0039, 0.00098, 0.000_244], Verdict::PreAsymptotic)]
#[case::nan(&[1.0, 0.25, f64::NAN, 0.0156, 0.0039], Verdict::Failed)]
#[case::infinite(&[f64::INFINITY, 0.25, 0.0625, 0.0156, 0.0039], Verdict::Failed)]
#[case::negative(&[1.0, 0.25, 0.0625, -0.0156, 0.0039], Verdict::Failed)]
#[case::zero_in_the_middle(&[1.0, 0.25, 0.0, 0.0156, 0.0039], Verdict::AtFloor)]
#[case::grows_after_a_zero(&[1.0, 0.25, 0.0, 0.5, 3.0, 12.0], Verdict::Divergent)]
#[case::floor_of_noise(&[1e-12, 2.5e-13, 6.25e-14, 1.56e-14, 1.1e-14, 0.8e-14, 1.2e-14, 0.9e-14], Verdict::AtFloor)]
#[case::floor_of_zeros(&[1e-12, 2.5e-13, 6.25e-14, 1.56e-14, 0.0, 0.0], Verdict::AtFloor)]
#[case::floor_of_one_level(&[1.0, 0.25, 0.0625, 0.0156, 0.0039, 0.0038], Verdict::AtFloor)]
#[case::two_levels(&[1.0, 0.25], Verdict::TooFewLevels)]
#[case::three_levels(&[1.0, 0.25, 0.0625], Verdict::TooFewLevels)]
#[case::no_level(&[], Verdict::TooFewLevels)]
#[case::converges_then_diverges(&[1.0, 0.25, 0.0625, 0.0156, 0.031, 0.12], Verdict::Divergent)]
#[case::diverges_then_converges(&[1.0, 4.0, 16.0, 4.0, 1.0, 0.25], Verdict::Converging)]
#[case::jump_at_the_finest(&[1.0, 0.25, 0.0625, 0.0156, 0.0039, 0.09], Verdict::PreAsymptotic)]
fn a_series_of_halvings(#[case] errors: &[f64], #[case] expected: Verdict) {
    let judgement = judged(errors, 2.0);
    assert_eq!(judgement.verdict, expected, "{}", judgement.reason);
}

#[rstest]
#[case::small_second_term(0.001, Verdict::Converging)]
#[case::large_second_term(0.1, Verdict::PreAsymptotic)]
#[case::second_term_everywhere(1000.0, Verdict::TooLow)]
fn a_second_term_of_lower_order(#[case] c: f64, #[case] expected: Verdict) {
    let judgement = judge(&halved(6, |h| h * h + c * h), &OrderHypothesis::formal(2.0));
    assert_eq!(judgement.verdict, expected, "{}", judgement.reason);
}

#[test]
fn term_of_higher_order_affects_only_coarse_levels() {
    let judgement = judge(&halved(8, |h| h * h + h * h * h * h), &OrderHypothesis::formal(2.0));
    assert_eq!(judgement.verdict, Verdict::Converging, "{}", judgement.reason);
    assert!(judgement.window.unwrap()[0] > 0);
}

#[test]
fn constant_error_of_another_axis_is_a_floor() {
    let judgement = judge(&halved(12, |h| h * h + 1e-4), &OrderHypothesis::formal(2.0));
    assert_eq!(judgement.verdict, Verdict::AtFloor, "{}", judgement.reason);
    assert_abs_diff_eq!(judgement.order.unwrap().value, 2.0, epsilon = 0.03);
}

/// Levels after the first zero error belong to the floor, for any errors.
#[test]
fn the_order_before_a_floor_is_that_of_the_levels_before_it() {
    let judgement = judged(&[1.0, 0.25, 0.0625, 0.015_625, 0.0, 0.002, 0.0005], 2.0);
    assert_eq!(judgement.verdict, Verdict::AtFloor, "{}", judgement.reason);
    assert_eq!(judgement.window, Some(vec![0, 1, 2, 3]));
    assert_abs_diff_eq!(judgement.order.unwrap().value, 2.0, epsilon = 1e-12);
}

/// Creates levels of order 2 whose spacings start at 1 and have this ratio.
fn levels_by(ratio: f64, levels: usize) -> Vec<Level> {
    let spacing = |k: usize| libm::pow(ratio, -(k as f64));
    (0..levels).map(|k| Level::new(spacing(k), spacing(k) * spacing(k))).collect()
}

#[rstest]
#[case::thirds(3.0, 1e-12)]
#[case::hardly_finer(1.0001, 1e-9)]
fn any_ratio_of_spacings_has_its_order(#[case] ratio: f64, #[case] rounding: f64) {
    let judgement = judge(&levels_by(ratio, 6), &OrderHypothesis::formal(2.0));
    assert_eq!(judgement.verdict, Verdict::Converging, "{}", judgement.reason);
    let order = judgement.order.unwrap();
    assert!((order.low - 2.0).abs().max((order.high - 2.0).abs()) <= rounding, "{order:?}");
}

/// If a level is finer by a ten-thousandth, noise of 1 % causes an order of a hundred.
#[test]
fn noise_on_levels_that_are_hardly_finer_does_not_pass() {
    for seed in 1..1000 {
        let mut series = levels_by(1.0001, 6);
        Random(seed).disturb(&mut series, 0.01);
        let judgement = judge(&series, &OrderHypothesis::formal(2.0));
        assert_ne!(judgement.verdict, Verdict::Converging, "{}", judgement.reason);
    }
}

#[test]
fn superconvergent_first_pair_is_outside_the_window() {
    let judgement = judged(&[16.0, 1.0, 0.25, 0.0625, 0.015_625, 0.003_906_25], 2.0);
    assert_eq!(judgement.verdict, Verdict::Converging, "{}", judgement.reason);
    assert_eq!(judgement.window, Some(vec![1, 2, 3, 4, 5]));
    assert_abs_diff_eq!(judgement.pairwise[1].unwrap(), 4.0, epsilon = 1e-12);
}

#[test]
fn a_level_given_twice_counts_once_and_contradicting_levels_fail() {
    let mut series = halved(4, |h| h * h);
    series[3] = series[2].clone();
    let judgement = judge(&series, &OrderHypothesis::formal(2.0));
    assert_eq!(judgement.verdict, Verdict::TooFewLevels);
    assert_eq!(judgement.levels.len(), 3);
    series[3].error *= 1.5;
    let judgement = judge(&series, &OrderHypothesis::formal(2.0));
    assert_eq!(judgement.verdict, Verdict::Failed);
}

#[test]
fn crossing_levels_are_shown_and_do_not_count() {
    let mut series = halved(5, |h| h * h);
    let crossing = [(0.05, 0.03), (0.04, 0.2), (0.03, 0.9)];
    series.extend(crossing.map(|(h, error)| Level::new(h, error).unusable()));
    let judgement = judge(&series, &OrderHypothesis::formal(2.0));
    assert_eq!(judgement.verdict, Verdict::Converging, "{}", judgement.reason);
    assert_eq!(judgement.window, Some(vec![0, 1, 2, 3, 4]));
    assert!(judgement.pairwise[7].unwrap() < 0.0);
}

#[test]
fn an_unusable_level_in_between_is_skipped_and_one_that_failed_is_not() {
    let mut series = halved(6, |h| h * h);
    series[2] = Level::new(0.25, 5.0).unusable();
    let judgement = judge(&series, &OrderHypothesis::formal(2.0));
    assert_eq!(judgement.verdict, Verdict::Converging, "{}", judgement.reason);
    assert_eq!(judgement.window, Some(vec![0, 1, 3, 4, 5]));
    series[2] = series[2].clone().failing("particle 7 left the domain at t = 0.2");
    let judgement = judge(&series, &OrderHypothesis::formal(2.0));
    assert_eq!(judgement.verdict, Verdict::Failed);
    assert_eq!(judgement.reason, "h = 0.25: particle 7 left the domain at t = 0.2");
}

/// A level that does not count must not be quoted.
#[test]
fn a_floor_is_that_of_usable_levels() {
    let mut series = halvings(&[16.0, 4.0, 1.0, 0.0, 0.0, 0.0]);
    series[4] = Level::new(series[4].h, 7.0).unusable();
    let judgement = judge(&series, &OrderHypothesis::formal(2.0));
    let reason = "the error stays at 0 for h <= 0.125";
    assert!(judgement.reason.starts_with(reason), "{}", judgement.reason);
}

#[rstest]
#[case(&POWERS_OF_4, "order 2.000 [2.000, 2.000] over 6 levels, h = 1 ... 0.03125, within [1.9, 2.1]")]
#[case(&POWERS_OF_4[..3], "3 usable levels, but an order needs 4")]
#[case(&[64.0, 16.0, 4.0, 1.0, 1.2, 1.1], "the error stays between 1 and 1.2 for h <= 0.125; before that, the order is 2.000 [2.000, 2.000] over 3 levels, h = 1 ... 0.25")]
#[case(&[64e6, 16e6, 4e6, 1e6], "order 2.000 [2.000, 2.000] over 4 levels, h = 1 ... 0.125, within [1.9, 2.1]")]
#[case(&[64e-6, 8e-6, 1e-6, 0.125e-6], "order 3.000 [3.000, 3.000] over 4 levels, h = 1 ... 0.125, above [1.9, 2.1]")]
#[case(&[8e-6, 4e-6, 2e-6, 1e-6], "order 1.000 [1.000, 1.000] over 4 levels, h = 1 ... 0.125, below [1.9, 2.1]")]
#[case(&[4.0, 2.0, 4.0, 2.0], "the error goes up and down without a trend: 4, 2, 4, 2")]
#[case(&[4.0, 1.0, 2.0, 4.0], "the error grows from 1 at h = 0.5 to 4 at h = 0.125: order -1.000 [-1.000, -1.000] over 3 levels, h = 0.5 ... 0.125")]
#[case(&[4.0, 1.0, 0.0, 0.0], "the error stays at 0 for h <= 0.25; before that, there is no order")]
#[case(&[16.0, 4.0, 1.0, 0.0], "the error stays at 0 for h <= 0.125; before that, the order is 2.000 [2.000, 2.000] over 3 levels, h = 1 ... 0.25")]
#[case(&[3.2e-9; 4], "the error stays at 3.2e-9 for h <= 1; before that, there is no order")]
fn reasons_give_the_figures(#[case] errors: &[f64], #[case] expected: &str) {
    assert_eq!(judged(errors, 2.0).reason, expected);
}
