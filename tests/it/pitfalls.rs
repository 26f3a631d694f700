//! Fourteen mistakes that were found in public verification tools. For each one, a test runs the
//! critical case and shows that this crate does not make the mistake.

use mpm_verify::embedded;
use mpm_verify::report::drift;
use mpm_verify::study::Runner;
use mpm_verify::suite::Suite;
use mpm_verify::suite::yaml::Source;
use mpm_verify::verify::{Level, Norms, OrderHypothesis, Verdict, judge};
use rstest::rstest;

const H: [f64; 5] = [0.16, 0.08, 0.04, 0.02, 0.01];

fn verdict(errors: &[f64], claim: OrderHypothesis) -> Verdict {
    let levels: Vec<Level> = H.iter().zip(errors).map(|(h, e)| Level::new(*h, *e)).collect();
    judge(&levels, &claim).verdict
}

fn power(order: f64) -> Vec<f64> {
    H.iter().map(|h| libm::pow(*h, order)).collect()
}

/// Creates a quick suite with the given expectation.
fn suite(expect: &str) -> Result<Suite, String> {
    let text = include_str!("../../verification/the-talk/vibrating-bar-small-amplitude.yaml");
    let (head, _) = text.split_once("expect:").expect("a suite expects something");
    let head = head.replace("80, 120, 160]", "80]").replace("[musl, usl]", "musl");
    load(&format!("{head}expect:\n  - {expect}\n"))
}

fn load(text: &str) -> Result<Suite, String> {
    let source = Source::from_text("case.yaml", text).map_err(|c| c.to_string())?;
    Suite::load(&source).map_err(|c| c.to_string())
}

fn unmet(expect: &str) -> Vec<String> {
    let suite = suite(expect).expect("a sound suite");
    let unmet = Runner::new(&suite).case(0, &|| ()).unmet;
    unmet.into_iter().map(|unmet| unmet.text).collect()
}

#[test]
fn p01_a_growing_error_is_divergent_and_its_order_negative() {
    let levels: Vec<Level> = H.iter().zip(power(-2.0)).map(|(h, e)| Level::new(*h, e)).collect();
    let found = judge(&levels, &OrderHypothesis::formal(2.0));
    assert_eq!(found.verdict, Verdict::Divergent);
    assert!(found.order.is_some_and(|order| order.value < 0.0));
    assert!(found.pairwise.iter().flatten().all(|order| *order < 0.0));
}

#[rstest]
#[case::nan(f64::NAN)]
#[case::infinite(f64::INFINITY)]
fn p02_non_finite_errors_fail(#[case] bad: f64) {
    for place in 0..H.len() {
        let mut errors = power(2.0);
        errors[place] = bad;
        assert_eq!(
            verdict(&errors, OrderHypothesis::formal(2.0)),
            Verdict::Failed,
            "at level {place}"
        );
    }
}

/// Pitfalls 3 and 9 (9: agreement with stored results is not correctness). The theory gate does not
/// read stored results: it judges the current run, independently of any snapshot.
#[test]
fn p03_p09_only_the_order_of_the_current_run_is_judged() {
    let unmet = unmet("{order: [2.9, 3.1], because: a snapshot said so}");
    assert!(unmet.iter().any(|line| line.contains("the order within [2.90, 3.10]")));
}

#[test]
fn p04_an_order_of_sixty_is_too_good() {
    assert_eq!(verdict(&power(60.0), OrderHypothesis::formal(2.0)), Verdict::TooGood);
}

#[test]
fn p05_the_true_ratio_of_h_is_used() {
    let h = [5.0, 2.5, 1.25, 0.625, 5.0 / 12.0, 0.3125];
    let levels: Vec<Level> = h.iter().map(|h| Level::new(*h, h * h)).collect();
    let found = judge(&levels, &OrderHypothesis::formal(2.0));
    assert_eq!(found.verdict, Verdict::Converging);
    assert!(found.pairwise.iter().flatten().all(|order| (order - 2.0).abs() <= 1e-12));
}

#[rstest]
#[case::tolerance_of_a_hundred("{order: [-98, 102], because: anything goes}")]
#[case::as_wide_as_two_orders("{order: [1, 3], because: anything goes}")]
fn p06_an_expectation_that_cannot_fail_does_not_pass(#[case] expect: &str) {
    let passes = suite(expect).is_ok_and(|suite| Runner::new(&suite).case(0, &|| ()).passed());
    assert!(!passes);
}

#[test]
fn p06_an_all_zero_field_does_not_pass() {
    let text = include_str!("../../verification/the-talk/vibrating-bar-small-amplitude.yaml");
    let zero = text
        .replace(r#"["v0/omega*sin(pi*X/(2*L))*sin(omega*t)"]"#, r#"["0*v0*omega"]"#)
        .replace(r#"["v0*sin(pi*X/(2*L))"]"#, "[0]");
    let diagnostic = load(&zero).expect_err("a solution that is zero proves nothing");
    assert!(diagnostic.contains("zero everywhere"), "{diagnostic}");
}

#[test]
fn p07_intermediate_levels_count() {
    let mut errors = power(2.0);
    errors[2] *= 5.0;
    assert_ne!(verdict(&errors, OrderHypothesis::formal(2.0)), Verdict::Converging);
}

/// For any three errors, the order fitted to them makes the asymptotic-range ratio one. Here the
/// true order is 0.7: the ratio indicates "asymptotic", but the judge does not.
#[test]
fn p08_no_reported_ratio_is_one_by_construction() {
    let errors = power(0.7);
    let fitted = libm::log2((errors[2] - errors[3]) / (errors[3] - errors[4]));
    let index = |coarse: f64, fine: f64| (coarse - fine) / (libm::pow(2.0, fitted) - 1.0);
    let ratio =
        index(errors[2], errors[3]) / (libm::pow(2.0, fitted) * index(errors[3], errors[4]));
    assert!((ratio - 1.0).abs() <= 1e-12, "one by construction");
    assert_eq!(verdict(&errors, OrderHypothesis::formal(2.0)), Verdict::TooLow);
}

#[test]
fn p10_the_confidence_interval_follows_the_scatter() {
    let width = |scatter: f64| {
        let signs = [1.0, -1.0, 1.0, -1.0, 1.0];
        let levels: Vec<Level> = H
            .iter()
            .zip(signs)
            .map(|(h, sign)| Level::new(*h, h * h * libm::exp(sign * scatter)))
            .collect();
        judge(&levels, &OrderHypothesis::formal(2.0)).order.map(|order| order.high - order.low)
    };
    let (narrow, wide) = (width(0.01).unwrap(), width(0.05).unwrap());
    assert!((wide / narrow - 5.0).abs() <= 1e-6, "{narrow} {wide}");
}

#[test]
fn p11_every_suite_of_the_repository_is_built_in() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("verification");
    let files = Source::files_in(&folder).unwrap();
    assert_eq!(embedded::names().count(), files.len());
}

#[test]
fn p12_a_method_that_does_not_exist_is_refused() {
    let text = include_str!("../../verification/the-talk/vibrating-bar-small-amplitude.yaml");
    let diagnostic = load(&text.replace("basis: linear", "basis: quintic")).unwrap_err();
    assert!(diagnostic.contains("quintic"), "{diagnostic}");
}

#[rstest]
#[case::missing("  loads:\n    - gravity: [\"-g\"]\n", "")]
#[case::wrong_sign("gravity: [\"-g\"]", "gravity: [\"g\"]")]
fn p13_missing_force_or_wrong_sign_is_detected(#[case] right: &str, #[case] wrong: &str) {
    let text = include_str!("../../verification/the-talk/fem-oedometer.yaml");
    assert!(text.contains(right));
    let diagnostic = load(&text.replace(right, wrong)).unwrap_err();
    assert!(diagnostic.contains("equation of motion"), "{diagnostic}");
}

#[test]
fn p14_small_numbers_are_not_rounded_to_the_same_text() {
    assert!(!drift::same("rms 3.200e-09", "rms 3.200e-07"));
    assert!(!drift::same("rms 0.000e+00", "rms 3.200e-09"));
}

#[test]
fn norms_propagate_non_finite_errors() {
    let norms = Norms::of(&[1.0, f64::NAN, 2.0], 1, &[1.0; 3]);
    assert!(!norms.rms.is_finite() && !norms.linf.is_finite());
}
