//! Predicts the error on the finest level of each case from the coarser levels, and compares it
//! with the observed error.

use mpm_verify::study::Runner;
use mpm_verify::suite::{ConvergencePlan, Suite, embedded};
use mpm_verify::verify::{
    Axis, CaseOutcome, Convergence, Level, OrderHypothesis, PredictedError, by_transfers, judge,
};
use std::sync::Arc;

/// Minimum number of levels of a case. Four levels then remain to be judged.
const FEWEST: usize = 5;

/// A case with its error on the finest level.
struct Found {
    suite: &'static str,
    cases: usize,
    /// Ratio of the upper to the lower end of the predicted interval, and whether the interval
    /// contains the observed error.
    predicted: Vec<(f64, bool)>,
}

/// Returns the cases of a suite that refines cells, with their predictions.
fn back_test(name: &'static str) -> Option<Found> {
    let suite = Suite::load(&embedded::source(name)?.unwrap()).unwrap();
    let plan = suite.plan::<ConvergencePlan>().filter(|plan| plan.refine.axis == Axis::Space)?;
    let mut found = Found { suite: name, cases: 0, predicted: Vec::new() };
    for case in Runner::new(&suite).run(&|| ()).cases {
        let Some(study) = case.convergence().filter(|study| study.levels.len() >= FEWEST) else {
            continue;
        };
        if !(study.compared && study.error_scale.size > 0.0) {
            continue;
        }
        found.cases += 1;
        found.predicted.extend(of_the_finest(plan, &case, study));
    }
    Some(found)
}

/// Predicts the error of the finest level from the judgement of the coarser ones.
fn of_the_finest(
    plan: &ConvergencePlan,
    case: &CaseOutcome,
    study: &Convergence,
) -> Option<(f64, bool)> {
    let own = plan.cases.iter().find(|own| own.name == case.case)?;
    let (finest, coarser) = study.levels.split_last()?;
    if coarser.iter().any(|level| level.run.failure.is_some()) {
        return None;
    }
    let (formal_order, axis) = (study.formal_order, study.axis);
    let expected = own.expectation.as_ref().and_then(|expectation| expectation.order);
    let hypothesis = OrderHypothesis { formal_order, expected, axis };
    let levels = coarser.iter().map(|level| {
        let judged = Level::new(level.spacing, level.error);
        if level.usable { judged } else { judged.unusable() }
    });
    let judgement = judge(&levels.collect::<Vec<_>>(), &hypothesis);
    let verdict = judgement.verdict;
    let mut cut = study.clone();
    (cut.levels, cut.judgement) = (coarser.to_vec(), judgement);
    let mut case = case.clone();
    case.study = Some(Arc::new(cut));
    let rankings = by_transfers(&[case]);
    let row = rankings.first()?.rows.first()?;
    let error = PredictedError::of(&row.method.samples, &row.part, verdict, formal_order);
    let error = error.at(finest.spacing)?;
    let measured = finest.error / study.error_scale.size;
    Some((error.high / error.low, error.low <= measured && measured <= error.high))
}

/// Returns the fraction of suites whose observed errors are all within the predicted intervals, and
/// the median of the interval widths.
fn covered(found: &[Found]) -> (f64, f64) {
    let given: Vec<&Found> = found.iter().filter(|one| !one.predicted.is_empty()).collect();
    let held = given.iter().filter(|one| one.predicted.iter().all(|(_, holds)| *holds)).count();
    let all = || given.iter().flat_map(|one| &one.predicted);
    let mut widths: Vec<f64> = all().map(|(width, _)| *width).collect();
    widths.sort_by(f64::total_cmp);
    let (cases, width) =
        (found.iter().map(|one| one.cases).sum::<usize>(), widths[widths.len() / 2]);
    for one in &given {
        let holds = one.predicted.iter().filter(|(_, holds)| *holds).count();
        println!("{}: {holds} of {} predicted of {}", one.suite, one.predicted.len(), one.cases);
    }
    println!(
        "{held} of {} suites, {} of {} predictions of {cases} cases, median width {width:.3}, \
         widest {:.3}",
        given.len(),
        all().filter(|(_, holds)| *holds).count(),
        widths.len(),
        widths[widths.len() - 1],
    );
    (held as f64 / given.len() as f64, width)
}

/// Suites that run within a second.
const SHORT: [&str; 11] = [
    "mms-fixed-bar-cubic",
    "mms-fixed-bar-plateau",
    "mms-fixed-bar-small-cubic",
    "mms-periodic-bar-cubic-cos",
    "mms-periodic-bar-cubic-sin",
    "plastic-bar",
    "simple-wave",
    "steffen-bar-small-load",
    "vibrating-bar",
    "vibrating-bar-small-amplitude",
    "vibrating-bar-smooth-bases",
];

#[test]
fn predicted_intervals_contain_measured_errors() {
    let found: Vec<Found> = SHORT.into_iter().filter_map(back_test).collect();
    let (share, width) = covered(&found);
    assert!(share >= 0.9 && width < 1.6, "{share} of the suites, median width {width}");
    let wave = found.iter().find(|one| one.suite == "simple-wave").unwrap();
    assert!(wave.predicted.iter().all(|(_, holds)| *holds));
    // For linear functions, cell changes cause a floor of the error.
    let floor = found.iter().find(|one| one.suite == "vibrating-bar").unwrap();
    assert!(floor.predicted.len() < floor.cases);
}

#[test]
#[ignore = "minutes: every suite; docs/design/cost.md has its figures"]
fn in_all_suites() {
    let found: Vec<Found> = embedded::names().filter_map(back_test).collect();
    let (share, width) = covered(&found);
    assert!(share >= 0.9 && width < 1.6, "{share} of the suites, median width {width}");
}
