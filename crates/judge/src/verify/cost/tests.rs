//! Tests on series with known results.

use super::{
    Agreement, ConvergingPart, End, Exponent, Machine, MethodCost, Ranking, Reach, Sample, TARGETS,
    TimedSuite, Timing, Workload, by_transfers,
};
use crate::verify::convergence::tests::study;
use crate::verify::{CaseOutcome, StudyResults, SuiteOutcome};
use approx::assert_relative_eq;
use proptest::prelude::*;
use rstest::rstest;
use std::sync::Arc;

fn level(spacing: f64, error: f64, work: f64) -> Sample {
    Sample { spacing, error, work, usable: true, asymptotic: true, failed: false }
}

/// Creates levels with error = h^p and work = h^-g for h = 1/2, 1/4, ...
fn power(p: f64, g: f64, levels: i32) -> Vec<Sample> {
    let one = |k: i32| {
        let h = libm::exp2(-f64::from(k));
        level(h, libm::pow(h, p), libm::pow(h, -g))
    };
    (1..=levels).map(one).collect()
}

fn errors(errors: &[f64]) -> Vec<Sample> {
    let one = |(k, e): (usize, &f64)| level(libm::exp2(-(k as f64)), *e, libm::exp2(k as f64));
    errors.iter().enumerate().map(one).collect()
}

#[rstest]
#[case::falls(&[1.0, 0.25, 0.06, 0.015], 0..4, End::Levels)]
#[case::floor(&[1.0, 0.25, 0.06, 0.06, 0.055], 0..3, End::Floor)]
#[case::sways_on_a_floor(&[1.0, 0.25, 0.06, 0.07, 0.05], 0..3, End::Floor)]
#[case::grows(&[1.0, 0.25, 0.06, 0.25, 1.0], 0..3, End::Grows)]
#[case::late(&[1.0, 2.0, 0.5, 0.12, 0.03], 1..5, End::Levels)]
#[case::the_larger_fall(&[1.0, 0.9, 0.8, 1.5, 0.3, 0.1], 3..6, End::Levels)]
#[case::nan(&[1.0, 0.25, 0.06, f64::NAN], 0..3, End::Failed)]
#[case::all_nan(&[f64::NAN; 4], 0..0, End::NoTrend)]
#[case::two_levels(&[1.0, 0.1], 0..0, End::NoTrend)]
#[case::up_and_down(&[1.0, 2.0, 1.0, 2.0], 0..0, End::NoTrend)]
#[case::nothing(&[], 0..0, End::NoTrend)]
fn parts(#[case] series: &[f64], #[case] levels: std::ops::Range<usize>, #[case] end: End) {
    assert_eq!(ConvergingPart::of(&errors(series)), ConvergingPart { levels, end });
}

#[test]
fn a_level_that_failed_or_does_not_count_ends_the_part() {
    let mut samples = errors(&[1.0, 0.25, 0.06, 0.015]);
    samples[3].usable = false;
    assert_eq!(ConvergingPart::of(&samples), ConvergingPart { levels: 0..3, end: End::Crossings });
    samples[3].failed = true;
    assert_eq!(ConvergingPart::of(&samples), ConvergingPart { levels: 0..3, end: End::Failed });
    samples[1].failed = true;
    assert_eq!(ConvergingPart::of(&samples), ConvergingPart { levels: 0..0, end: End::Failed });
}

fn reach(samples: &[Sample], target: f64) -> Reach {
    Reach::of(samples, &ConvergingPart::of(samples), target)
}

#[test]
fn interpolation_of_a_power_law_is_exact() {
    let found = reach(&power(2.0, 3.0, 6), 1e-2);
    assert_relative_eq!(found.work().unwrap(), libm::pow(1e-2, -1.5), max_relative = 1e-12);
    assert!(matches!(found, Reach::At { .. }));
}

#[rstest]
#[case::beyond_the_finest(&[1.0, 0.25, 0.06], 0.05, None)]
#[case::on_the_finest(&[1.0, 0.25, 0.06], 0.06, Some(4.0))]
#[case::on_the_coarsest(&[1.0, 0.25, 0.06], 1.0, Some(1.0))]
#[case::everywhere(&[1e-15, 2e-15, 0.0, 1e-15], 1e-4, Some(1.0))]
#[case::an_accident(&[1.0, 1e-9, 0.5, 0.6], 1e-2, None)]
#[case::before_a_floor(&[1.0, 0.25, 0.06, 0.06, 0.0599], 0.25, Some(2.0))]
#[case::below_a_floor(&[1.0, 0.25, 0.06, 0.06, 0.0599], 0.05995, None)]
#[case::nan(&[f64::NAN, f64::NAN, f64::NAN, f64::NAN], 1.0, None)]
#[case::nan_last(&[1e-5, 1e-6, f64::NAN], 1e-2, Some(1.0))]
fn targets(#[case] series: &[f64], #[case] target: f64, #[case] work: Option<f64>) {
    assert_eq!(reach(&errors(series), target).work(), work);
}

/// A good coarsest level must not hide a failure on a finer level.
#[test]
fn failure_on_a_finer_level_is_not_hidden() {
    let mut samples = errors(&[1e-5, 1e-6, 1e-7]);
    samples[1].failed = true;
    assert_eq!(reach(&samples, 1e-2), Reach::Never);
}

#[rstest]
#[case::as_theory(2.0, 3.0, 2.0, 3.0, Agreement::Agrees)]
#[case::lower_order(1.5, 3.0, 2.0, 3.0, Agreement::Order)]
#[case::steps_stay(2.0, 2.0, 2.0, 3.0, Agreement::Growth)]
fn exponents(
    #[case] p: f64,
    #[case] g: f64,
    #[case] order: f64,
    #[case] growth: f64,
    #[case] wanted: Agreement,
) {
    let samples = power(p, g, 5);
    let found = Exponent::of(&samples, &ConvergingPart::of(&samples), order, growth).unwrap();
    assert_relative_eq!(found.observed.value, -g / p, max_relative = 1e-12);
    assert_relative_eq!(found.theory, -growth / order, max_relative = 1e-15);
    assert_relative_eq!(found.order.0, p, max_relative = 1e-12);
    assert_relative_eq!(found.growth.0, g, max_relative = 1e-12);
    assert_eq!(found.agreement(), wanted);
}

#[test]
fn noise_widens_the_interval_about_the_exponent() {
    let mut samples = power(2.0, 3.0, 6);
    for (k, one) in samples.iter_mut().enumerate() {
        one.error *= if k % 2 == 0 { 1.2 } else { 1.0 / 1.2 };
    }
    let found = Exponent::of(&samples, &ConvergingPart::of(&samples), 2.0, 3.0).unwrap();
    assert!(found.observed.low < -1.55 && found.observed.high > -1.45, "{:?}", found.observed);
    assert_eq!(found.agreement(), Agreement::Agrees);
}

#[test]
fn exponent_ignores_levels_outside_the_window() {
    let mut samples = power(2.0, 3.0, 6);
    samples[0].error *= 10.0;
    samples[0].asymptotic = false;
    let found = Exponent::of(&samples, &ConvergingPart::of(&samples), 2.0, 3.0).unwrap();
    assert_relative_eq!(found.observed.value, -1.5, max_relative = 1e-12);
}

fn method(name: &str, samples: Vec<Sample>) -> MethodCost {
    MethodCost { name: name.to_owned(), samples, formal_order: 2.0, growth: 2.0 }
}

fn names(ranking: &Ranking) -> Vec<&str> {
    ranking.rows.iter().map(|row| row.method.name.as_str()).collect()
}

#[test]
fn the_finest_target_decides_and_who_reaches_less_comes_last() {
    let scaled = |factor: f64, levels: i32| {
        let scaled_work = |one: Sample| Sample { work: factor * one.work, ..one };
        power(2.0, 2.0, levels).into_iter().map(scaled_work).collect::<Vec<_>>()
    };
    let methods = vec![
        method("short", scaled(0.1, 4)),
        method("costly", scaled(3.0, 8)),
        method("cheap", scaled(1.0, 8)),
        method("broken", errors(&[f64::NAN, 1.0, f64::NAN])),
    ];
    let ranking = Ranking::new(String::new(), 1.0, &TARGETS, methods);
    assert_eq!(names(&ranking), ["cheap", "costly", "short", "broken"]);
    let [cheap, costly, short, broken] = &ranking.rows[..] else { panic!("four rows") };
    assert_relative_eq!(costly.times[2].unwrap(), 3.0, max_relative = 1e-12);
    assert_relative_eq!(cheap.times[1].unwrap(), 1.0, max_relative = 1e-12);
    assert_eq!((short.times[2], short.obstacle()), (None, Some(End::Levels)));
    assert_eq!((cheap.obstacle(), broken.obstacle()), (None, Some(End::NoTrend)));
    assert_eq!((short.front.len(), costly.front.len(), broken.front.len()), (4, 0, 0));
}

/// Creates a case with five levels of order 2 after the first one. Each level has four times the
/// transfers of the one before.
fn case(name: &str, problem: &str, size: f64, transfers: u64) -> CaseOutcome {
    let mut study = study(&[8e-7, 4e-8, 1e-8, 2.5e-9, 6.25e-10]);
    study.settings.error_scale.problem = problem.to_owned();
    (study.settings.error_scale.size, study.settings.error_scale.growth) = (size, 3.0);
    for (k, level) in study.levels.iter_mut().enumerate() {
        level.run.counters.transfers = transfers << (2 * k);
    }
    let study = Some(StudyResults::Convergence(Arc::new(study)));
    CaseOutcome { study, ..CaseOutcome::new(name, "mpm", Vec::new()) }
}

/// Errors are divided by the size of the solution, 2e-6 m or 4e-5 m: 1e-2 is 2e-8 or 4e-7 m.
#[test]
fn cases_are_ranked_by_problem_with_relative_errors() {
    let cases = [
        case("expensive", "a", 2e-6, 60),
        case("other", "b", 4e-5, 30),
        case("external", "a", 2e-6, 0),
        case("cheap", "a", 2e-6, 30),
        case("unknown", "a", f64::NAN, 30),
    ];
    let all = by_transfers(&cases);
    let rankings: Vec<_> =
        all.iter().map(|one| (one.problem.as_str(), one.size, names(one))).collect();
    assert_eq!(rankings, [("a", 2e-6, vec!["cheap", "expensive"]), ("b", 4e-5, vec!["other"])]);
    let cheap = &all[0].rows[0];
    let sample = cheap.method.samples[2];
    assert_relative_eq!(sample.error, 5e-3, max_relative = 1e-14);
    assert_eq!((sample.spacing, sample.work), (0.25, 480.0));
    assert_eq!((cheap.method.formal_order, cheap.method.growth), (2.0, 3.0));
    let asymptotic: Vec<bool> = cheap.method.samples.iter().map(|one| one.asymptotic).collect();
    assert_eq!(asymptotic, [false, true, true, true, true]);
    // The error halves with the root of the work between 120 and 480 transfers.
    assert_relative_eq!(cheap.reaches[0].work().unwrap(), 240.0, max_relative = 1e-12);
    assert_relative_eq!(all[0].rows[1].times[0].unwrap(), 2.0, max_relative = 1e-12);
    assert_relative_eq!(cheap.best.unwrap(), 3.125e-4, max_relative = 1e-14);
    let seconds = |case: f64| {
        [1.0, 2.0, 4.0, 8.0, 16.0].map(|k| Timing::of(&[0.5 * k * case, k * case, 9.0 * k * case]))
    };
    let load = Workload { transfers: 1.0, updates: 1.0, steps: 1.0 };
    let levels =
        [5.0, 1.0, 3.0, 2.0, 7.0].map(|case| seconds(case).map(|timing| (load, timing)).into());
    let outcome = SuiteOutcome {
        suite: String::new(),
        group: String::new(),
        title: String::new(),
        source: String::new(),
        about: String::new(),
        statement: Vec::new(),
        meaning: 0,
        cases: cases.into(),
    };
    let machine = Machine { cores: 1, load: None, waited: None, fixed_loop: None };
    let timed = TimedSuite { outcome, levels: levels.into(), machine };
    assert_eq!(timed.timing("external", 3).map(|timing| timing.median), Some(24.0));
    let first = &timed.by_seconds()[0];
    assert_eq!(names(first), ["cheap", "external", "expensive"]);
    assert_eq!(first.rows[0].method.samples[2].work, 8.0);
}

fn series() -> impl Strategy<Value = Vec<Sample>> {
    let number = prop_oneof![4 => 1e-9..1.0_f64, 1 => Just(f64::NAN), 1 => Just(0.0)];
    let one = (number, 1e-3..1e9_f64, any::<bool>(), 0..8_u8);
    prop::collection::vec(one, 0..9).prop_map(|all| {
        let level = |(k, (error, work, usable, chance)): (usize, (f64, f64, bool, u8))| Sample {
            usable: usable || chance > 2,
            failed: chance == 0,
            ..level(libm::exp2(-(k as f64)), error, work)
        };
        all.into_iter().enumerate().map(level).collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(400) })]

    /// The work for a reached error lies between the work of two levels.
    #[test]
    fn nothing_is_extrapolated(samples in series(), target in 1e-9..1.0_f64) {
        if let Some(work) = reach(&samples, target).work() {
            prop_assert!(samples.iter().any(|one| one.counts() && one.error <= target));
            let works = || samples.iter().filter(|one| one.counts()).map(|one| one.work);
            let (least, most) = (works().fold(f64::INFINITY, f64::min), works().fold(0.0, f64::max));
            prop_assert!(least * (1.0 - 1e-12) <= work && work <= most * (1.0 + 1e-12));
        }
    }

    #[test]
    fn a_coarser_target_is_reached_first(samples in series(), target in 1e-9..1e-1_f64) {
        let fine = reach(&samples, target);
        let coarse = reach(&samples, 10.0 * target);
        prop_assert!(fine.work().is_none() || coarse.work().is_some());
    }

    /// No level dominates the front, and the front dominates or equals every level that counts.
    #[test]
    fn pareto_front_dominates_all_other_levels(samples in series()) {
        let front = super::pareto_front(&samples);
        let beats = |a: &Sample, b: &Sample| {
            a.work <= b.work && a.error <= b.error && (a.work, a.error) != (b.work, b.error)
        };
        let counted = || samples.iter().filter(|one| one.counts());
        for k in &front {
            prop_assert!(!counted().any(|one| beats(one, &samples[*k])));
        }
        for one in counted() {
            let worth = one.error / (1.0 - super::sample::WORTH) * (1.0 + 1e-12);
            let covered = |k: &usize| samples[*k].work <= one.work && samples[*k].error <= worth;
            prop_assert!(front.iter().any(covered));
        }
    }

    #[test]
    fn units_do_not_matter(samples in series(), unit in 1e-6..1e6_f64, target in 1e-6..1.0_f64) {
        let other: Vec<Sample> = samples
            .iter()
            .map(|one| Sample { work: unit * one.work, spacing: one.spacing / 8.0, ..*one })
            .collect();
        prop_assert_eq!(ConvergingPart::of(&samples), ConvergingPart::of(&other));
        match (reach(&samples, target).work(), reach(&other, target).work()) {
            (Some(a), Some(b)) => prop_assert!((unit * a / b - 1.0).abs() < 1e-9),
            (a, b) => prop_assert_eq!(a, b),
        }
    }
}
