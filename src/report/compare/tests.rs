use super::*;
use crate::report::fixture::flat;
use rstest::rstest;
use serde_json::{Value, json};

/// Creates a case that converges over four levels, with `error = c h^2` and `transfers = w/h^2`.
fn case(name: &str, c: f64, w: f64) -> Value {
    let level = |cells: u32| {
        let h = 1.0 / f64::from(cells);
        json!({"cells": cells, "h": h, "spacing": h, "ppc": 4, "judged": c * h * h,
            "transfers": (w / (h * h)) as u64, "failure": null})
    };
    json!({"case": name, "verdict": "converging", "passed": true, "axis": "space",
        "judge": {"of": "displacement", "norm": "rms", "scale": null, "within": null},
        "observed_order": {"value": 2.0, "low": 1.9, "high": 2.1},
        "levels": [level(10), level(20), level(40), level(80)],
        "unmet": [], "stability": null, "forces": null})
}

/// Creates a case of a stability study, with verdicts or limits for two values.
fn sweep(runs: &[Value; 2], predicted: &[Value; 2]) -> Value {
    let row = |k: usize, value: f64| {
        json!({"value": value, "run": runs[k],
        "predicted": predicted[k], "observed": null})
    };
    json!({"case": "a", "verdict": "swept", "passed": true, "axis": null, "judge": null,
        "observed_order": null, "levels": [],
        "stability": {"swept": "d", "sought": null, "rows": [row(0, 0.1), row(1, 0.5)]}})
}

fn document(cases: &[Value]) -> ReportDocument {
    let text = json!({"suites": [{"suite": "bar", "cases": cases}]}).to_string();
    ReportDocument::read(&text).expect("a document")
}

/// Creates a document with `case` in a suite whose statement contains the modulus `young`.
fn stating(young: &str, case: &Value) -> ReportDocument {
    let statement = json!([["parameters", young], ["dt", "h"]]);
    let suite = json!({"suite": "bar", "statement": statement, "cases": [case]});
    ReportDocument::read(&json!({ "suites": [suite] }).to_string()).expect("a document")
}

#[test]
fn figures_of_another_problem_are_not_compared() {
    let (before, mut after) = (case("a", 1.0, 1.0), case("a", 2.0, 1.0));
    let found = compare(&stating("E = 100", &before), &stating("E = 101", &after), TOLERANCE);
    assert_eq!((rank(&found), found.is_worse()), (Some(Rank::OtherProblem), false));
    assert!(text(&found).contains("  bar: parameters E = 100 -> E = 101\n"), "{}", text(&found));
    let same = compare(&stating("E = 100", &before), &stating("E = 100", &after), TOLERANCE);
    assert_eq!(rank(&same), Some(Rank::LessAccurate));
    after["passed"] = json!(false);
    let broken = compare(&stating("E = 100", &before), &stating("E = 101", &after), TOLERANCE);
    assert_eq!(rank(&broken), Some(Rank::Broken));
}

#[rstest]
#[case::one_of_several(["E = 1, nu = 0, rho = 2", "E = 1, nu = 0.3, rho = 2"], "nu = 0 -> nu = 0.3")]
#[case::another_list(["E = 1, nu = 0", "E = 1"], "E = 1, nu = 0 -> E = 1")]
#[case::no_list(["box (0, 1) m", "box (0, 2) m"], "box (0, 1) m -> box (0, 2) m")]
fn a_change_of_the_problem_shows_what_differs(#[case] values: [&str; 2], #[case] words: &str) {
    let [old, new] = values.map(|value| stating(value, &case("a", 1.0, 1.0)));
    let found = compare(&old, &new, TOLERANCE);
    assert!(text(&found).contains(&format!("  bar: parameters {words}\n")), "{}", text(&found));
}

#[test]
fn only_levels_that_count_in_a_run_are_compared() {
    let mut before = case("a", 1.0, 1.0);
    for (level, counts) in [false, true, true, true].into_iter().enumerate() {
        before["levels"][level]["counts"] = json!(counts);
    }
    let coarse = after(&before, set("/levels/0/judged", json!(1.0)));
    assert_eq!(rank(&coarse), None);
    let fine = after(&before, set("/levels/1/judged", json!(1.0)));
    assert_eq!(rank(&fine), Some(Rank::LessAccurate));
    for (level, counts) in [(0, true), (3, false)] {
        let one_run = after(&before, |case| {
            set(&format!("/levels/{level}/counts"), json!(counts))(case);
            set(&format!("/levels/{level}/judged"), json!(1.0))(case);
        });
        assert_eq!(rank(&one_run), Some(Rank::LessAccurate), "level {level}");
    }
}

fn run(verdict: &str) -> Value {
    json!({ "verdict": verdict })
}

/// Compares a case with itself after a change. Each of the two documents must equal itself.
fn after(before: &Value, change: impl Fn(&mut Value)) -> ReportComparison {
    let mut case = before.clone();
    change(&mut case);
    let [old, new] = [before, &case].map(|case| document(std::slice::from_ref(case)));
    for one in [&old, &new] {
        let same = compare(one, one, 0.0);
        assert_eq!((same.moved.len(), same.unchanged), (0, 1), "{}", text(&same));
        assert!(!same.is_worse());
    }
    compare(&old, &new, TOLERANCE)
}

fn rank(found: &ReportComparison) -> Option<Rank> {
    Rank::ALL.iter().copied().find(|rank| found.count(*rank) > 0)
}

fn set(path: &str, value: Value) -> impl Fn(&mut Value) {
    move |case| *case.pointer_mut(path).expect("a key") = value.clone()
}

#[rstest]
#[case(1.94, Rank::Otherwise)]
#[case(1.96, Rank::Better)]
fn smaller_error_of_a_lower_order_is_not_better(#[case] order: f64, #[case] expected: Rank) {
    let found = after(&case("a", 1.0, 1.0), |case| {
        set("/levels/3/judged", json!(1e-4))(case);
        set("/observed_order", json!({ "value": order }))(case);
    });
    assert_eq!(rank(&found), Some(expected), "{}", text(&found));
}

#[test]
fn levels_of_one_run_only_are_counted() {
    let found = after(&case("a", 1.0, 1.0), set("/levels/3/cells", json!(90)));
    assert!(text(&found).contains("    bar::a: levels: 4 -> 4, 3 in common\n"), "{}", text(&found));
}

/// The finest level has the old error 2e-4 and the old work 6400.
#[rstest]
#[case("space", "80 cells")]
#[case("time", "dt = 1.250e-2 s")]
#[case("particles", "4 particles per cell")]
fn changes_have_the_old_value_the_new_one_and_their_ratio(#[case] axis: &str, #[case] level: &str) {
    let found = after(&case("a", 1.28, 1.0), |case| {
        set("/levels/3/judged", json!(5e-4))(case);
        set("/levels/3/transfers", json!(9600))(case);
        set("/observed_order", json!({"value": 1.75}))(case);
        set("/axis", json!(axis))(case);
    });
    let page = flat(&text(&found));
    let row = format!("bar::a converging 2.00 -> 1.75 2.000e-4 -> 5.000e-4 2.50 x {level} ");
    assert!(page.contains(&row) && page.contains(" 1.50 x Values count"), "{page}");
}

#[rstest]
#[case::nothing("/axis", json!("space"), None)]
#[case::another_reason("/passed", json!(true), None)]
#[case::unmet("/passed", json!(false), Some(Rank::Broken))]
#[case::divergent("/verdict", json!("divergent"), Some(Rank::WorseVerdict))]
#[case::failed_level("/levels/3/failure", json!("inverted"), Some(Rank::LessAccurate))]
#[case::nan("/levels/3/judged", json!("nan"), Some(Rank::LessAccurate))]
#[case::infinite("/levels/0/judged", json!("inf"), Some(Rank::LessAccurate))]
#[case::larger_error("/levels/3/judged", json!(3e-4), Some(Rank::LessAccurate))]
#[case::smaller_error("/levels/3/judged", json!(1e-4), Some(Rank::Better))]
#[case::coarse_level("/levels/0/judged", json!(0.02), Some(Rank::LessAccurate))]
#[case::within_tolerance("/levels/3/judged", json!(1.5625e-4 * 1.0005), None)]
#[case::more_work("/levels/3/transfers", json!(12_000), Some(Rank::MoreExpensive))]
#[case::less_work("/levels/3/transfers", json!(3000), Some(Rank::Better))]
#[case::another_norm("/judge/norm", json!("linf"), Some(Rank::Otherwise))]
#[case::another_scale("/judge/scale", json!(2.0), Some(Rank::Otherwise))]
#[case::another_box("/judge/within", json!({"from": [0.0], "to": [1.0]}), Some(Rank::Otherwise))]
#[case::no_judge("/judge", json!(null), None)]
#[case::another_grid("/levels/3/cells", json!(90), Some(Rank::Otherwise))]
fn one_change(#[case] path: &str, #[case] value: Value, #[case] expected: Option<Rank>) {
    let found = after(&case("a", 1.0, 1.0), set(path, value));
    assert_eq!(rank(&found), expected, "{}", text(&found));
    assert_eq!(found.unchanged, usize::from(expected.is_none()));
    assert_eq!(found.is_worse(), expected.is_some_and(Rank::is_worse));
}

/// A ratio close to one is printed with enough digits to distinguish it from one.
#[test]
fn a_small_change_is_detected() {
    let found = after(&case("a", 1.0, 1.0), set("/levels/3/transfers", json!(6426)));
    assert!(text(&found).contains("  1.004 x\n"), "{}", text(&found));
}

/// NaN before and after is the same failure. A number in place of NaN is an improvement.
#[test]
fn a_failure_in_both_runs_is_unchanged() {
    let broken = {
        let mut case = case("a", 1.0, 1.0);
        set("/levels/3/judged", json!("nan"))(&mut case);
        case
    };
    assert_eq!(rank(&after(&broken, |_| ())), None);
    assert_eq!(rank(&after(&broken, set("/levels/3/judged", json!("inf")))), None);
    assert_eq!(rank(&after(&broken, set("/levels/3/judged", json!(1e-4)))), Some(Rank::Better));
}

#[test]
fn a_new_failure_outweighs_a_better_finest_level() {
    let found = after(&case("a", 1.0, 1.0), |case| {
        set("/levels/1/failure", json!("inverted"))(case);
        set("/levels/3/judged", json!(1e-5))(case);
    });
    assert_eq!(rank(&found), Some(Rank::LessAccurate));
    assert!(text(&found).contains("2.500e-3 -> failed"), "{}", text(&found));
}

/// A rigid translation is exact; a change of its rounding errors is not a change of accuracy.
#[rstest]
#[case::rounding(1e-13, 3e-13, None)]
#[case::rounding_is_lost(1e-13, 1e-9, Some(Rank::LessAccurate))]
#[case::just_rounding(0.9e-11, 0.5e-11, None)]
#[case::just_no_rounding(1.1e-11, 0.5e-11, Some(Rank::Better))]
#[case::from_zero(0.0, 1e-14, None)]
#[case::to_something(0.0, 1e-3, Some(Rank::LessAccurate))]
fn rounding(#[case] old: f64, #[case] new: f64, #[case] expected: Option<Rank>) {
    let mut before = case("a", 1.0, 1.0);
    set("/observed_order", Value::Null)(&mut before);
    set("/levels", json!([before["levels"][0]]))(&mut before);
    set("/levels/0/judged", json!(old))(&mut before);
    assert_eq!(rank(&after(&before, set("/levels/0/judged", json!(new)))), expected);
}

/// Rounding errors may have an order by chance. The verdict of `run --gate` is then `at rounding`.
#[rstest]
#[case("converging", Some(Rank::LessAccurate))]
#[case("at rounding", None)]
fn small_errors_with_an_order(#[case] verdict: &str, #[case] expected: Option<Rank>) {
    let mut before = case("a", 1e-12, 1.0);
    set("/verdict", json!(verdict))(&mut before);
    assert_eq!(rank(&after(&before, set("/levels/3/judged", json!(3e-16)))), expected);
}

#[rstest]
#[case::same([["stable", "unstable"], ["stable", "unstable"]], None)]
#[case::worse([["stable", "stable"], ["stable", "unstable"]], Some(Rank::WorseVerdict))]
#[case::mixed([["stable", "unstable"], ["failed", "stable"]], Some(Rank::WorseVerdict))]
#[case::better([["failed", "unstable"], ["unstable", "bounded_growth"]], Some(Rank::BetterVerdict))]
fn verdicts_of_a_sweep(#[case] words: [[&str; 2]; 2], #[case] expected: Option<Rank>) {
    let [old, new] = words.map(|words| sweep(&words.map(run), &[Value::Null, Value::Null]));
    assert_eq!(rank(&after(&old, |case| *case = new.clone())), expected);
}

#[rstest]
#[case::same(json!({"at": 1.0}), json!({"at": 1.0}), None)]
#[case::lower(json!({"at": 1.0}), json!({"at": 0.9}), Some(Rank::LessStable))]
#[case::higher(json!({"at": 1.0}), json!({"at": 1.1}), Some(Rank::Better))]
#[case::beyond(json!({"at": 1.0}), json!({"above": 4.0}), Some(Rank::Better))]
#[case::none_left(json!({"at": 1.0}), json!({"below": 0.01}), Some(Rank::LessStable))]
#[case::lost(json!({"at": 1.0}), json!(null), Some(Rank::LessStable))]
#[case::nan(json!({"at": 1.0}), json!({"at": "nan"}), Some(Rank::LessStable))]
#[case::rounding(json!({"at": 1.0}), json!({"at": 1.0001}), None)]
fn limits_of_a_sweep(#[case] old: Value, #[case] new: Value, #[case] expected: Option<Rank>) {
    let study =
        |limit: &Value| sweep(&[Value::Null, Value::Null], &[limit.clone(), json!({"at": 2})]);
    let new = study(&new);
    assert_eq!(rank(&after(&study(&old), |case| *case = new.clone())), expected);
}

#[test]
fn changed_rows_of_a_sweep_have_the_old_and_the_new_value() {
    let [old, new] =
        [("stable", 0.75, "at"), ("bounded_growth", 4.5, "above")].map(|(word, x, key)| {
            sweep(&[run("stable"), run(word)], &[json!({ key: x }), json!({"at": 2})])
        });
    let page = text(&after(&old, |case| *case = new.clone()));
    let notes = "    bar::a: d = 0.5: stable -> bounded growth\n    bar::a: d = 0.1: limit 0.7500 -> > 4.5\n";
    assert!(page.contains(notes), "{page}");
}

/// The most important change comes first, and within one kind the largest change.
#[test]
fn changes_are_sorted_by_importance() {
    let names = ["gone", "cheap", "costly", "costlier", "worse", "worst", "verdict", "unmet"];
    let before: Vec<Value> = names.iter().map(|name| case(name, 1.0, 1.0)).collect();
    let mut after = before[1..].to_vec();
    after[0] = case("cheap", 1.0, 0.5);
    after[1] = case("costly", 1.0, 1.5);
    after[2] = case("costlier", 1.0, 3.0);
    after[3] = case("worse", 1.5, 1.0);
    after[4] = case("worst", 9.0, 1.0);
    set("/verdict", json!("at floor"))(&mut after[5]);
    set("/passed", json!(false))(&mut after[6]);
    set("/unmet", json!(["an order of 2 was expected"]))(&mut after[6]);
    after.insert(0, case("added", 1.0, 1.0));
    let found = compare(&document(&before), &document(&after), TOLERANCE);
    let page = text(&found);
    let heads = "worse: 1 newly failing, 1 worse verdict, 2 less accurate, 2 more expensive, \
                 1 better, 1 new, 1 gone";
    assert_eq!(page.lines().next(), Some(heads));
    let order =
        ["unmet", "verdict", "worst", "worse", "costlier", "costly", "cheap", "added", "gone"];
    let row = |name: &str| page.find(&format!("\n  bar::{name} ")).expect(name);
    assert!(order.windows(2).all(|pair| row(pair[0]) < row(pair[1])), "{page}");
    assert!(page.contains("    bar::unmet: an order of 2 was expected"), "{page}");
}

/// Creates a document with one suite that ranks two methods at errors of 1e-2 and 1e-3.
fn ranked(first: [Option<f64>; 2], second: [Option<f64>; 2]) -> ReportDocument {
    let method = |name: &str, work: [Option<f64>; 2]| {
        let reached =
            work.map(|work| work.map(|work| json!({"work": work, "at_most": false, "times": 1.0})));
        json!({"case": name, "reached": reached, "best": 1e-4, "pareto_front": true})
    };
    let cost = json!([{"problem": "exact", "size": 1.0, "work": "transfers", "targets": [1e-2, 1e-3],
        "methods": [method("linear", first), method("cubic", second)]}]);
    let text = json!({"suites": [{"suite": "bar", "cases": [], "cost": cost}]}).to_string();
    ReportDocument::read(&text).expect("a document")
}

#[rstest]
#[case::same([Some(1e3), Some(1e5)], [Some(2e3), Some(1e4)], None)]
#[case::the_dearer_method_is_none_of_it([Some(1e3), Some(9e5)], [Some(2e3), Some(1e4)], None)]
#[case::more_expensive([Some(1.8e3), Some(1e5)], [Some(2e3), Some(1e4)],
    Some((true, "bar, exact   1e-2  1.80 x    1.000e3 -> 1.800e3  linear")))]
#[case::another_method([Some(5e3), Some(1e5)], [Some(2e3), Some(1e4)],
    Some((true, "bar, exact   1e-2  2.00 x  1.000e3 -> 2.000e3  linear -> cubic")))]
#[case::cheaper([Some(1e3), Some(1e5)], [Some(2e3), Some(5e3)],
    Some((false, "bar, exact   1e-3  0.50 x  1.000e4 -> 5.000e3  cubic")))]
#[case::not_reached([Some(1e3), None], [Some(2e3), None],
    Some((true, "bar, exact   1e-3      -  1.000e4 -> not reached  cubic -> not reached")))]
fn cheapest_for_a_target(
    #[case] first: [Option<f64>; 2],
    #[case] second: [Option<f64>; 2],
    #[case] expected: Option<(bool, &str)>,
) {
    let old = ranked([Some(1e3), Some(1e5)], [Some(2e3), Some(1e4)]);
    let found = compare(&old, &ranked(first, second), TOLERANCE);
    let page = flat(&text(&found));
    assert_eq!(found.is_worse(), expected.is_some_and(|(worse, _)| worse), "{page}");
    match expected {
        Some((_, row)) => assert!(page.contains(&flat(row)), "{page}"),
        None => assert!(found.cheapest.is_empty(), "{page}"),
    }
}

#[rstest]
#[case::cut("{\"suites\": [", "EOF while parsing a list", (1, 12))]
#[case::empty("", "EOF while parsing a value", (1, 1))]
#[case::no_cases("{\"suites\": [\n {\"suite\": \"a\"}]}", "missing field `cases`", (2, 15))]
#[case::nested(&format!("{{\"x\": {}", "[".repeat(100_000)), "EOF while parsing a list", (1, 100_006))]
fn what_is_no_document(#[case] text: &str, #[case] words: &str, #[case] place: (usize, usize)) {
    let error = ReportDocument::read(text).expect_err("no document");
    assert!(error.message.contains(words), "{error:?}");
    assert_eq!(error.place, Some(place), "{error:?}");
}

#[test]
fn duplicate_cases_are_refused() {
    let twice =
        json!({"suites": [{"suite": "bar", "cases": [case("a", 1.0, 1.0), case("a", 2.0, 1.0)]}]});
    let error = ReportDocument::read(&twice.to_string()).expect_err("no document");
    assert_eq!(error.message, "the case `bar::a` is there twice");
}
