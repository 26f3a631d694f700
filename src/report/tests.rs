//! The complete output of the writers for an outcome in which no two numbers are equal.

use super::fixture::{
    FIGURES, convergence, digits, figure, flat, interval, outcome, ranking, timed_suite,
};
use super::*;
use crate::subject::{ColumnSize, Holder};
use crate::verify::{
    Axis, CaseOutcome, ChangedRun, Convergence, Diagnosis, EstimateRefusal, Judgement, Quantity,
    StudyResults, SuiteOutcome, Verdict,
};
use rstest::rstest;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::sync::Arc;
use std::time::{Duration, UNIX_EPOCH};

/// The first rows are the three levels of two cases. Columns whose numbers consist of the digits of
/// case, level and index are listed with their index.
#[test]
fn csv_has_each_value_in_its_row_and_column() {
    let csv = csv(&[outcome()]);
    let mut reader = ::csv::Reader::from_reader(csv.as_bytes());
    let rows: Vec<BTreeMap<String, String>> =
        reader.deserialize().collect::<Result<_, _>>().expect("rows");
    assert_eq!(rows.len(), 15);
    let indices = "dt=1 rounding_bound=2 spread=3 errors.rms=21 errors.l1=22 errors.l2=23 \
                   errors.linf=24 errors.max_rms=26 energy_rate.0=41 energy_rate.1=42 energy_rate.2=43";
    for (column, index) in indices.split(' ').filter_map(|pair| pair.split_once('=')) {
        for row in 0..6 {
            let expected = digits(1 + row as u32 / 3, row % 3, index.parse().expect("an index"));
            assert_eq!(rows[row][column], expected.to_string(), "{column} of row {row}");
        }
    }
    for (column, expected) in [
        ("case", "mpm-linear mpm-linear mpm-linear mpm-ugimp mpm-ugimp mpm-ugimp"),
        ("verdict", "converging converging converging failed failed failed"),
        ("result", "pass pass pass FAIL FAIL FAIL"),
        ("cells", "5 10 20 5 10 20"),
        ("ppc", "4 5 6 - - -"),
        ("judged", "0.06 0.02 0.005 0.08 0.03 nan"),
        ("order", "- 1.11 1.22 - 2.11 2.22"),
        ("particles", "1051 1151 1251 2051 2151 2251"),
        ("steps", "1056 1156 1256 2056 2156 2256"),
        ("transfers", "1052000 1152000 1252000 2052000 2152000 2252000"),
        ("crossings", "1053 0 0 2053 0 0"),
        ("left_domain", "1054 1154 1254 2054 2154 2254"),
        ("min_j", "1.055 1.155 1.255 2.055 2.155 2.255"),
        ("residual_speed", "0.00004 0.005 0.0006 0.000004 0.0005 0.00006"),
        ("stable_time_step", "0.001506 0.001656 0.001806 0.001002 0.001052 0.001102"),
        ("spacing", "0.8 0.4 0.2 0.8 0.4 0.2"),
        ("h", "0.4 0.25 0.1 0.4 0.25 0.1"),
        ("counts", "false true false false false false"),
        ("excluded_by", "crossings - spread crossings - -"),
        ("drift.mass", "0.00001 0.001 0.0001 0.000001 0.0001 0.00001"),
        ("drift.momentum", "0.00002 0.002 0.0002 0.000002 0.0002 0.00002"),
        ("drift.angular_momentum", "0.00003 0.003 0.0003 0.000003 0.0003 0.00003"),
        ("drift.kinetic_energy", "0.00004 0.004 0.0004 0.000004 0.0004 0.00004"),
        ("drift.kinetic_energy_gain", "0.00005 0.005 0.0005 0.000005 0.0005 0.00005"),
        ("drift.energy", "0.00006 0.006 0.0006 0.000006 0.0006 0.00006"),
        ("observed_order.value", "2.0 2.0 2.0 - - -"),
        ("observed_order.low", "1.9 1.9 1.9 - - -"),
        ("observed_order.high", "2.2 2.2 2.2 - - -"),
        ("failure", "- - - - - broken_at_7_s"),
    ] {
        for (row, expected) in rows.iter().zip(expected.split(' ')) {
            let cell = row[column].replace(' ', "_");
            let is_number = cell.parse::<f64>().is_ok_and(|x| expected.parse() == Ok(x));
            assert!(is_number || cell == expected.trim_matches('-'), "{column}: {cell}");
        }
    }
    // One row of each study, as `row | column = value | ...`.
    let others = "\
        2|suite=odd|subject=mpm|axis=space|formal_order=1.75|expected=order 1.75|judge.of=velocity|\
        judge.norm=l2|judge.scale=2.5|judge.within.from.0=0.1|judge.within.from.1=0.2|\
        judge.within.to.0=0.3|judge.within.to.1=0.4\n\
        6|case=force|forces.position=0.125|forces.n_left=3|forces.n_right=4|forces.force=1.5|\
        forces.predicted=1.2|cells=\n\
        7|forces.position=0.625|forces.n_left=2|forces.n_right=5|forces.force=-2.5|\
        forces.predicted=-2.0\n\
        8|case=limit|stability.value=0.25|stability.predicted.at=0.731|stability.observed.above=|\
        stability.observed.below=0.05|stability.confirmed.0.share=0.9|stability.confirmed.0.steps=502|\
        stability.confirmed.0.verdict=stable|stability.confirmed.1.share=1.1|\
        stability.confirmed.1.steps=503|stability.confirmed.1.verdict=unstable\n\
        9|stability.value=0.375|stability.predicted.at=|stability.observed.above=4.0\n\
        10|case=sweep|stability.value=0.25|stability.run.verdict=stable|stability.run.why=\n\
        11|stability.value=0.375|stability.run.verdict=unstable|stability.run.why=energy grows\n\
        14|case=other|result=not applicable|cells=";
    for (row, values) in others.lines().filter_map(|line| line.split_once('|')) {
        let row: usize = row.parse().expect("a number");
        for (column, value) in values.split('|').filter_map(|pair| pair.split_once('=')) {
            assert_eq!(rows[row][column], value, "{column} of row {row}");
        }
    }
    for (index, name) in FIGURES.iter().enumerate() {
        let found = [10, 11].map(|row| &rows[row][&format!("stability.run.figures.{name}")]);
        assert!(found.into_iter().eq(&[0, 1].map(|k| figure(k, index).to_string())), "{name}");
    }
}

/// Checks the values at the keys (JSON pointers) of `expected`, in the object at `place`.
fn assert_values(document: &Value, place: &str, expected: &Value) {
    for (key, expected) in expected.as_object().expect("keys") {
        let value = document.pointer(&format!("{place}/{key}"));
        assert_eq!(value, Some(expected), "{key}");
    }
}

/// The rows of levels, forces and limits are those of the CSV.
#[test]
fn json_has_each_value_at_its_key() {
    let mut outcome = outcome();
    outcome.cases.push(CaseOutcome::new("excepted", "mpm", vec![]).excepted("a gap".to_owned()));
    let document: Value = serde_json::from_str(&json(&[outcome])).expect("JSON");
    let expected = json!({
        "suite": "odd", "group": "ends", "title": "50 % of a bar", "source": "a book",
        "problem": "0000000000000abc", "statement": [["young", "E = 7"]], "passed": false,
        "cases/0/settings": [["basis", "linear"], ["transfer", "flip"]],
        "cases/0/because": "a proof", "cases/0/reason": "reason mpm-linear", "cases/0/passed": true,
        "cases/1/passed": false, "cases/1/unmet": ["the run failed"], "cases/1/codes": ["run-failed"],
        "cases/7/passed": false, "cases/7/lacks": ["fixed"], "cases/7/levels": [],
        "cases/8/passed": false, "cases/8/result": "known limit", "cases/8/expected": null,
        "cases/0/profile": {
            "effects": ["gravity", "traction"], "particles": 20, "nodes": 9,
            "passes": ["P2G(mass)", "G2P(x)"],
            "visits": [{"part": "p2g mass", "particles": 40}, {"part": "g2p x", "particles": 3}],
            "columns": [{"name": "X", "of": "particle", "entries": 20, "bytes": 16},
                {"name": "layer", "of": "particle", "entries": 4, "bytes": 2},
                {"name": "m", "of": "node", "entries": 9, "bytes": 8}]},
        "cases/0/floor": {"cause": "space", "error": 0.5, "probes": [
            {"axis": "time", "error": 0.45, "failure": null},
            {"axis": "space", "error": 0.125, "failure": null},
            {"axis": "particles", "error": null, "failure": "no room"}]},
        "cases/3/stability/swept": "place", "cases/3/stability/sought": "C",
    });
    assert_values(&document, "/suites/0", &expected);
    // The function 3 q + 5 q^2 changes by 28 and 12.75, and by the derivative 22 and 11.
    let expected = json!({
        "functional": "mean_displacement", "parameter": "young",
        "value": 26.0, "reported_value": 26.5,
        "order": 2.0,
        "levels": [
            {"cells": 6, "dt": 0.006_001, "gradient": 22.0, "exact": 23.0, "error": 1.0, "order": null},
            {"cells": 12, "dt": 0.006_101, "gradient": 23.25, "exact": 23.0, "error": 0.25,
                "order": 2.0}],
        "taylor": [
            {"level": 1, "remainder": 6.0, "order": null, "difference": 23.0},
            {"level": 2, "remainder": 1.75, "order": (6.0_f64 / 1.75).ln() / 2.0_f64.ln(),
                "difference": 23.0}],
        "sweep": {"change": -3.0, "share": 0.875, "jumps": [0.25, -0.5]},
        "points": [{"parameter": 1.5, "value": 15.75, "gradient": 18.0},
            {"parameter": 2.5, "value": 38.75, "gradient": 28.0}],
    });
    assert_values(&document, "/suites/0/cases/5/gradient", &expected);
    let expected = json!([
            {"cells": 4.0, "courant": 0.25, "steps": 704, "phase_error": -0.012, "amplitude": 1.0,
                "predicted_phase_error": -0.0125, "predicted_amplitude": (-0.5_f64).exp(),
                "cells_for_one_percent": 4.75, "limit": 1.125, "failure": null},
            {"cells": 8.0, "courant": 0.5, "steps": 708, "phase_error": null, "amplitude": null,
                "predicted_phase_error": null, "predicted_amplitude": (-0.25_f64).exp(),
                "cells_for_one_percent": 8.75, "limit": 1.0625, "failure": "no wave"}]);
    assert_eq!(document["suites"][0]["cases"][6]["spectrum"], expected);
}

#[test]
fn text_has_each_value_in_its_row_and_column() {
    assert_eq!(text(&outcome()), TEXT);
    let summary = summary(&[outcome()]);
    let lines: Vec<&str> = summary.lines().collect();
    assert_eq!(
        [lines[1], lines[3], lines[4], lines[16]],
        [
            "            pass  odd::mpm-linear  converging        2.00 [1.90, 2.20]",
            "            FAIL  odd::mpm-ugimp   failed                            -",
            "      expected: order 1.75; reason mpm-ugimp",
            "      the solver lacks fixed",
        ]
    );
}

#[test]
fn profile_distinguishes_full_and_partial_columns() {
    let mut columns = outcome().cases.remove(0).profile.expect("a profile");
    columns.columns.push(ColumnSize { name: "fixed", holder: Holder::Node, entries: 3, bytes: 1 });
    let rows = profile(&columns);
    let expected = [
        ("effects", "gravity, traction"),
        ("a step", "P2G(mass), G2P(x)"),
        ("particle visits", "p2g mass x 2, g2p x at 3 of 20 particles"),
        ("particle memory", "16 B: X 16; layer 2 at 4 of 20"),
        ("node memory", "8 B: m 8; fixed 1 at 3 of 9"),
    ];
    for (key, text) in expected {
        assert!(rows.contains(&(key, text.to_owned())), "{key}: {rows:?}");
    }
}

#[test]
fn latex_has_the_errors_and_orders_of_each_case() {
    let version = env!("CARGO_PKG_VERSION");
    let head = format!("% Written by mpm-verify {version}. Needs \\usepackage{{booktabs}}.\n");
    assert_eq!(latex(&[outcome()]).strip_prefix(&head), Some(LATEX));
}

/// Only the second case has excluded levels and no valid order, and the third has other levels.
#[test]
fn latex_tables_have_cases_with_equal_levels() {
    let latex = latex(&[copies(3, |k, study| {
        study.bounded = k != 1;
        study.levels[0].usable = true;
        study.levels.iter_mut().for_each(|level| level.cells = level.cells * [5, 5, 8][k] / 5);
        study.judgement.verdict = [Verdict::Converging, Verdict::TooLow, Verdict::Converging][k];
    })]);
    let (first, second) = latex.split_once("\\end{table}").expect("two tables");
    let order = "{$2.00$ [$1.90$, $2.20$]}";
    let orders =
        format!(" & \\multicolumn{{2}}{{c}}{order} & \\multicolumn{{2}}{{c}}{{too low}} \\\\");
    assert!(first.contains(&orders) && second.contains(&format!("{{c}}{order} \\\\")), "{latex}");
    assert!(first.contains("    $20$ & ") && second.contains("    $32$ & "), "{latex}");
    let aside = "Levels in parentheses";
    assert!(first.contains(aside) && !second.contains(aside), "{latex}");
}

/// A case that its solver does not support, or that the gate exempts, fails only in a suite that is
/// required.
#[test]
fn junit_has_the_result_of_each_case_and_the_times_of_the_run_and_the_suite() {
    let times = RunTimes {
        start: UNIX_EPOCH + Duration::from_secs(86_400),
        whole: Duration::from_millis(7500),
        suites: vec![Duration::from_millis(2250)],
    };
    let mut short = outcome();
    short.cases.drain(2..7);
    short.cases.push(CaseOutcome::new("excepted", "mpm", vec![]).excepted("a gap".to_owned()));
    let report = case(&short.cases[1]);
    let of = |required: &[&str]| {
        let required = required.iter().map(|suite| (*suite).to_owned()).collect();
        junit(std::slice::from_ref(&short), &required, &times)
    };
    let start = "timestamp=\"1970-01-02T00:00:00.000+00:00\"";
    let expected = format!(
        r#"<?xml version="1.0" encoding="UTF-8"?>
<testsuites name="mpm-verify" tests="4" skipped="2" failures="1" errors="0" {start} time="7.500">
    <testsuite name="odd" tests="4" skipped="2" errors="0" failures="1" {start} time="2.250">
        <testcase name="mpm-linear" classname="odd"/>
        <testcase name="mpm-ugimp" classname="odd">
            <failure message="the run failed" type="failed">{report}</failure>
        </testcase>
        <testcase name="other" classname="odd">
            <skipped message="the solver lacks fixed"/>
        </testcase>
        <testcase name="excepted" classname="odd">
            <skipped message="a gap"/>
        </testcase>
    </testsuite>
</testsuites>
"#
    );
    assert_eq!(of(&["even"]), expected);
    let failure = "<failure message=\"the solver lacks fixed\" type=\"not applicable\">";
    assert!(of(&["odd"]).contains(failure));
}

/// The error 0.01 lies between the first two levels of `exact`, at 10 s times 4, and in the middle
/// of the last two of `cheap`, at 24 s times the root of 8.
#[test]
fn ranking_has_each_work_in_its_row_and_column() {
    assert_eq!(cost(&ranking(), "seconds"), COST);
    let document = json!(json::rankings(&[ranking()], "seconds"));
    let close = |key: &str, expected: f64| {
        let value = document.pointer(&format!("/0/methods/{key}")).and_then(Value::as_f64);
        let value = value.unwrap_or_else(|| panic!("no {key} in {document:#}"));
        assert!((value / expected - 1.0).abs() < 1e-9, "{key}: {value}");
    };
    close("0/reached/0/work", 40.0);
    close("0/reached/1/work", 400.0);
    close("1/reached/0/work", 24.0 * 8.0_f64.sqrt());
    close("1/reached/0/times", 0.6 * 8.0_f64.sqrt());
    close("0/exponent/value", -1.0);
    close("1/exponent/low", -1.5);
    close("1/exponent/high", -1.5);
    let expected = json!({
        "work": "seconds", "problem": "a problem", "size": 4.0, "targets": [0.01, 0.001],
        "methods/0/case": "exact", "methods/0/best": 0.0004, "methods/0/not_reached": null,
        "methods/0/pareto_front": [0, 1, 2], "methods/0/exponent/theory": -0.75,
        "methods/0/exponent/agrees": false, "methods/1/exponent/agrees": true,
        "methods/1/best": 0.005, "methods/1/not_reached": "no finer level",
        "methods/1/pareto_front": [0, 1], "methods/1/reached/0/at_most": false,
        "methods/1/reached/1": null,
    });
    assert_values(&document, "/0", &expected);
    let mut ranking = ranking();
    let exponent = ranking.rows[1].exponent.as_mut().expect("an exponent");
    (exponent.theory, exponent.growth) = (-1.0, (3.0, 2.0));
    assert!(cost(&ranking, "seconds").contains("-1.00  growth of work 3.00, not 2.00\n"));
    let document = json!(json::rankings(std::slice::from_ref(&ranking), "seconds"));
    assert_values(&document, "/0/methods/1/exponent", &json!({ "agrees": false }));
    // The coarsest level of a method is not asymptotic, and the finest of the other one does not
    // converge: both are outside the window.
    ranking.rows[0].method.samples[0].asymptotic = false;
    ranking.rows[1].part.levels = 0..2;
    // The first method is on the front with all levels, and the other one with two.
    let figure = &cost_figures(&outcome(), &[ranking], "seconds (s)", "seconds")[0];
    let legend = figure.pgfplots.lines().filter(|line| line.starts_with("\\addlegendentry"));
    let names =
        ["exact", "cheap", "Pareto front"].map(|name| format!("\\addlegendentry{{{name}}}"));
    assert!(legend.eq(&names) && figure.pgfplots.contains("xlabel={seconds (s)}"), "{figure:?}");
    let points = figure.pgfplots.lines().filter(|line| line.starts_with(|c: char| c.is_numeric()));
    let (exact, cheap) =
        (["1e1 4e-2", "1e2 4e-3", "1e3 4e-4"], ["3e0 8e-2", "2.4e1 2e-2", "1.92e2 5e-3"]);
    let front = [cheap[0], exact[0], cheap[1], exact[1], exact[2]];
    let drawn = [&exact[..], &exact[1..], &cheap, &cheap[..2], &front].concat();
    assert_eq!((figure.file.as_str(), points.collect::<Vec<_>>()), ("odd-work-seconds.svg", drawn));
    let share =
        |value: f64, low: f64, high: f64| 0.06 + 0.88 * (value / low).ln() / (high / low).ln();
    let front = [(3.0, 0.08), (10.0, 0.04), (24.0, 0.02), (100.0, 0.004), (1000.0, 0.0004)];
    let front = front.map(|(work, error)| {
        let x = 74.0 + 348.0 * share(work, 3.0, 1000.0);
        format!("{x:.2},{:.2}", 291.0 - 256.0 * share(error, 0.0004, 0.08))
    });
    let band = elements(&figure.svg, "<polyline")[0];
    assert!(band.contains(&format!("points=\"{}\"", front.join(" "))), "{band}");
}

#[test]
fn timed_suite_has_each_time_in_its_row_and_column() {
    let text = timed(&timed_suite(), true);
    assert_eq!(text.split("\n== ").next(), Some(TIMED));
    for work in ["<=1.17e-03", "<=1.15e+06"] {
        let row = format!("  mpm-linear  {work}   1.00     1.25e-03  no trend  2 of 3\n");
        assert!(text.contains(&row), "{text}");
    }
    assert!(text.ends_with("\ncheapest for an error of 1e-2: mpm-linear, 1.17e-03 s\n"), "{text}");
    let document: Value = serde_json::from_str(&timed_json(&[timed_suite()])).expect("JSON");
    // The update of a particle takes 16 bytes; the layer exists for some particles only.
    let expected = json!({
        "suite": "odd", "machine/cores": 3, "machine/load": [0.25, 0.5], "machine/waited": 0.125,
        "machine/fixed_loop": {"median": 4.0, "low": 3.5, "high": 4.25, "repeats": 11},
        "cost/0/work": "seconds", "cost/0/methods/0/reached/0/work": 0.001_171,
        "cost/1/work": "transfers", "cost/1/methods/0/reached/0/work": 1_152_000.0,
        "cases/1/case": "mpm-ugimp", "cases/1/levels/2/bytes": null,
        "cases/1/levels/2/failure": "broken at 7 s",
        "cases/0/levels/1": {
            "cells": 10, "dt": 0.001_101, "ppc": 5, "error": 0.005, "transfers": 1_152_000,
            "seconds": {"median": 0.001_171, "low": 0.001_111, "high": 0.001_199, "repeats": 8},
            "particle_updates": 11_750, "steps": 1156, "bytes": 188_000, "failure": null},
    });
    assert_values(&document, "/suites/0", &expected);
}

/// The 13 rows of 60 characters show 4 and 2 dots each.
#[test]
fn plot_marks_each_level_at_its_spacing_and_error() {
    let plot = convergence_plot(&outcome()).expect("a plot");
    let mut marks = Vec::new();
    for (row, line) in plot.lines().skip(1).take(13).enumerate() {
        let cells = line.split_once('|').map_or("", |(_, cells)| cells).chars().enumerate();
        marks.extend(cells.filter(|(_, c)| c.is_ascii_lowercase()).map(|(x, c)| (row, x, c)));
    }
    // The dot of 0.06 is number 46 of 51, that of 0.03 number 33, and that of 0.02 number 26.
    assert_eq!(marks, [(0, 59, 'o'), (1, 59, 'o'), (4, 29, 'o'), (6, 29, 'a'), (12, 0, 'o')]);
    let lines: Vec<&str> = plot.lines().collect();
    assert!(
        lines[1].starts_with("   8.00e-02 |") && lines[13].starts_with("   5.00e-03 |"),
        "{plot}"
    );
    assert_eq!(flat(lines[15]), "0.2 0.8 cell size h (m)");
    assert_eq!(lines[16..18], ["  a  mpm-linear: 2.00 [1.90, 2.20]", "  b  mpm-ugimp: failed"]);
    // Errors of another quantity have another unit.
    let quantities = [Quantity::Displacement, Quantity::Stress];
    let plot = convergence_plot(&copies(2, |k, study| study.settings.of = quantities[k]));
    assert!(plot.is_some_and(|plot| plot.contains("  a  case-0: 2.00 [1.90, 2.20]\n")));
}

#[test]
fn page_has_the_values_of_each_case() {
    let outcome = outcome();
    let sources = [page::SuiteSource { outcome: &outcome, file: "odd.yaml", yaml: "" }];
    let page = page::page(&sources, &page::RunFacts::default());
    let linear = r##"<tr data-basis="linear" data-transfer="flip" data-verdict="converging"><td
        class="name"><a href="#case-odd.mpm-linear">odd::mpm-linear</a></td><td><span
        class="pass">pass</span></td><td class="name">converging</td><td class="number"
        data-value="2">2.00 [1.90, 2.20]</td><td class="number"
        data-value="0.02">2.000e-02</td><td class="number"
        data-value="1252000">1252000</td><td class="prose">order 1.75</td></tr>"##;
    let ugimp = r##"<tr data-basis="ugimp" data-transfer="flip" data-verdict="failed"><td
        class="name"><a href="#case-odd.mpm-ugimp">odd::mpm-ugimp</a></td><td><span
        class="FAIL">FAIL</span></td><td class="name">failed</td><td class="number">-</td><td
        class="number" data-value="Infinity">failed</td><td class="number"
        data-value="2252000">2252000</td><td class="prose">order 1.75</td></tr>"##;
    for row in [linear, ugimp].map(|row| row.replace("\n       ", "")) {
        assert!(page.contains(&row), "{row}");
    }
    let version = format!("mpm-verify {}", env!("CARGO_PKG_VERSION"));
    let title = ": 50 % of a bar</h2>";
    // The first two cases have the same expectation for different reasons.
    let reason = "rowspan=\"1\">order 1.75; reason: a guess</td>";
    for words in [&version, title, "a book", "0000000000000abc", "reason: a proof", reason] {
        assert!(page.contains(words), "{words}");
    }
    // One of one linear case has the order of theory, and none of the cases of uGIMP.
    let share = |percent, text| {
        format!("<td><span class=\"share\" style=\"--share:{percent}%\">{text}</span></td>")
    };
    assert!(page.contains(&(share(100, "1 of 1") + &share(0, "0 of 1") + "<td>-</td>")));
    let found = matrix::findings(&outcome);
    let linear = "2.00/see report/limit/unstable/not applicable";
    assert_eq!(found, [linear, "breaks", "-", "-", "-", "-", "-", "-"]);
}

fn sample_diagnosis() -> Diagnosis {
    let judgement = |verdict, order, reason: &str| Judgement {
        verdict,
        order: Some(order),
        window: None,
        pairwise: Vec::new(),
        levels: Vec::new(),
        reason: reason.to_owned(),
    };
    let run = |change: &str, verdict, order, error, ratio| ChangedRun {
        change: change.to_owned(),
        cause: "a cause",
        remedy: "a remedy",
        refusal: None,
        verdict,
        order: Some(order),
        error,
        ratio,
        relative_ratio: 0.5 * ratio,
        is_finer: false,
        has_more_particles: false,
    };
    Diagnosis {
        case: "bar".to_owned(),
        formal_order: 2.0,
        judgement: judgement(Verdict::TooLow, interval(1.1, 1.0, 1.3), "the order is low"),
        finest: judgement(Verdict::TooLow, interval(1.2, 1.15, 1.35), "it is low"),
        finest_error: 0.008,
        levels: vec!["8 cells".to_owned(), "16 cells".to_owned(), "32 cells".to_owned()],
        is_external: false,
        findings: Vec::new(),
        runs: vec![
            run("scheme: usf", Verdict::TooLow, interval(0.9, 0.7, 1.4), 0.012, 1.5),
            run("basis: cubic", Verdict::Converging, interval(2.01, 1.96, 2.04), 0.001, 0.125),
        ],
        skipped: vec!["64 cells".to_owned(), "more particles".to_owned()],
    }
}

#[test]
fn diagnosis_has_the_values_of_each_run() {
    let mut found = sample_diagnosis();
    assert_eq!(diagnosis(&found), DIAGNOSIS);
    let document = diagnosis_json(&found);
    let run = |change: &str, verdict: &str, order: [f64; 3], error: f64, ratio: f64| {
        json!({"change": change, "cause": "a cause", "remedy": "a remedy", "verdict": verdict,
            "order": {"value": order[0], "low": order[1], "high": order[2]}, "error": error,
            "ratio": ratio, "relative_ratio": 0.5 * ratio})
    };
    let expected = json!({
        "case": "bar", "formal_order": 2.0, "verdict": "too low", "sound": false,
        "cause": "a cause", "remedy": "a remedy", "levels": ["8 cells", "16 cells", "32 cells"],
        "causes": [{"cause": "a cause", "remedy": "a remedy"}],
        "runs/0": run("scheme: usf", "too low", [0.9, 0.7, 1.4], 0.012, 1.5),
        "runs/1": run("basis: cubic", "converging", [2.01, 1.96, 2.04], 0.001, 0.125),
        "beyond_budget": ["64 cells", "more particles"],
    });
    assert_values(&document, "", &expected);
    found.runs.remove(1);
    found.runs[0].ratio = 0.25;
    found.runs[0].error = 0.002;
    let lowered = "With scheme: usf the error on the finest level is 2.000e-3, 0.25 times 8.000e-3; \
                   relative to the exact solution, it is 0.75 times the error before. The order from \
                   8 cells to 32 cells is then 0.90 [0.70, 1.40], so there is another cause. Partial \
                   remedy: a remedy.";
    let text = diagnosis(&found).replace('\n', " ");
    assert!(text.contains(&format!("Largest contribution: a cause. {lowered}")), "{text}");
}

/// Returns the lines of a document that begin with `tag`.
fn elements<'a>(svg: &'a str, tag: &str) -> Vec<&'a str> {
    svg.lines().filter(|line| line.starts_with(tag)).collect()
}

fn texts(svg: &str) -> Vec<&str> {
    let inside = elements(svg, "<text").into_iter().map(|line| line.split(['>', '<']).nth(2));
    inside.map(Option::unwrap_or_default).collect()
}

/// Returns the number that follows ` name="` in a line.
fn attribute(line: &str, name: &str) -> f64 {
    let (_, rest) = line.split_once(&format!(" {name}=\"")).expect(name);
    rest.split('"').next().and_then(|value| value.parse().ok()).expect("a number")
}

/// The spacings 0.2 to 0.8 m take 88 % of the width. The errors reach from 0.0025, half of the
/// smallest one, to 0.08, below the head of 13 + 13 px for one row of failures.
#[test]
fn convergence_figure_has_each_level_at_its_spacing_and_error() {
    let figures = svg(&outcome());
    let Figure { file, svg, .. } = &figures[0];
    let frame = elements(svg, "<rect")[1];
    let [left, top, width, height] =
        ["x", "y", "width", "height"].map(|name| attribute(frame, name));
    assert_eq!((file.as_str(), left, top, height), ("odd.svg", 74.0, 35.0, 256.0));
    let share = |value: f64, low: f64, high: f64| (value / low).ln() / (high / low).ln();
    let head = 0.06 + 26.0 / 256.0;
    let x = |h: f64| left + width * (0.06 + 0.88 * share(h, 0.2, 0.8));
    let y = |e: f64| top + height * (0.94 - (0.94 - head) * share(e, 0.0025, 0.08));
    let circle = |h, e, r: f64, fill| {
        format!(
            "<circle cx=\"{:.2}\" cy=\"{:.2}\" r=\"{r:.2}\" fill=\"{fill}\" stroke=\"#0072b2\" stroke-width=\"1.20\"/>",
            x(h),
            y(e)
        )
    };
    let circles = [
        circle(0.2, 0.005, 4.2, "#0072b2"),
        circle(0.4, 0.02, 4.2, "#0072b2"),
        circle(0.8, 0.06, 5.6, "#ffffff"),
    ];
    assert_eq!(elements(svg, "<circle")[..3], circles);
    let cross = format!("<line x1=\"{:.2}\" y1=\"{:.2}\" ", x(0.8) - 3.08, y(0.06) - 3.08);
    assert_eq!(svg.matches(&cross).count(), 1, "{cross}");
    // Squares of the failing case: the levels at 0.4 and 0.8 m, and below the arrow at 0.2 m.
    let squares = [(x(0.4), y(0.03), 4.2), (x(0.8), y(0.08), 5.6), (x(0.2), top + 20.0, 4.2)];
    let corner = |(x, y, radius): (f64, f64, f64)| {
        format!("<polygon points=\"{:.2},{:.2} ", x - 0.92 * radius, y - 0.92 * radius)
    };
    for (line, square) in elements(svg, "<polygon")[..3].iter().zip(squares) {
        assert!(line.starts_with(&corner(square)), "{line} {}", corner(square));
    }
    // Order 2 from half of the error on the coarsest level to half of the smallest error.
    let end = 0.8 * (0.0025_f64 / 0.03).sqrt();
    let dotted = elements(svg, "<line").into_iter().find(|line| line.contains("1.4 3"));
    let ends = [("x1", x(end)), ("y1", y(0.0025)), ("x2", x(0.8)), ("y2", y(0.03))];
    for (name, expected) in ends {
        assert!((attribute(dotted.expect("a line"), name) - expected).abs() < 0.0051, "{name}");
    }
    let expected = "50 % of a bar|0.2|0.3|0.5|0.7|0.002|0.005|0.01|0.02|0.05|0.1|cell size h (m)|\
                    l2 error of velocity, divided by 2.5 m/s|mpm-linear: order 2.00|\
                    mpm-ugimp: failed|order 2|in the asymptotic window|outside the window|\
                    particles changed cell|failed or not finite";
    assert_eq!(texts(svg).join("|"), expected);
    // Labels of ticks: below the frame at 0.3 m, and 4 px below their height at 0.05.
    let labels = elements(svg, "<text");
    let (below, beside) = (labels[2], labels[9]);
    assert_eq!([attribute(below, "y"), attribute(beside, "x")], [309.0, 67.0]);
    assert!((attribute(below, "x") - x(0.3)).abs() < 0.0051, "{below}");
    assert!((attribute(beside, "y") - y(0.05) - 4.0).abs() < 0.0051, "{beside}");
    // A grid line, and ticks of 6 px at both edges of the frame.
    for length in [height, -6.0, 6.0] {
        let from = if length < 0.0 { top + height } else { top };
        let ends = (x(0.3), from, from + length);
        let line = format!(
            "<line x1=\"{0:.2}\" y1=\"{1:.2}\" x2=\"{0:.2}\" y2=\"{2:.2}\"/>",
            ends.0, ends.1, ends.2
        );
        assert!(svg.contains(&line), "{line}");
    }
    assert_eq!(figures[0].pgfplots.split_once('\n').map(|(_, text)| text), Some(PGFPLOTS));
}

/// Creates copies of the converging case. `change` gets the number of the copy.
fn copies(count: usize, change: impl Fn(usize, &mut Convergence)) -> SuiteOutcome {
    let mut copies = outcome();
    copies.cases.truncate(1);
    let case = copies.cases.remove(0);
    copies.cases.extend((0..count).map(|k| {
        let mut study = convergence(1);
        change(k, &mut study);
        let study = Some(StudyResults::Convergence(Arc::new(study)));
        CaseOutcome { case: format!("case-{k}"), study, ..case.clone() }
    }));
    copies
}

#[rstest]
#[case(
    Axis::Time,
    "$\\Delta t$ (s) & error & order",
    "$1.101 \\times 10^{-3}$ & ",
    "    dt = 1.001e-03, 1.101e-03, 1.201e-03 s\n    5 ... 20 cells along X\n    h = 0.4 ... 0.1 m\n    4",
    "time step dt (s)",
    "levels levels dt 1-2 2-3 case-0",
    json!(["time", 1.75])
)]
#[case(
    Axis::Particles,
    "particles per cell & error & order",
    "$5$ & ",
    "    4, 5, 6 particles per cell\n    5 ... 20 cells along X\n    h = 0.4 ... 0.1 m\n    dt = 0.001001",
    "particle spacing h/ppc^(1/D) (m)",
    "ppc 4-5 5-6 case-0",
    json!(["particles", null])
)]
fn refined_axis_names_the_levels(
    #[case] axis: Axis,
    #[case] heads: &str,
    #[case] row: &str,
    #[case] levels: &str,
    #[case] label: &str,
    #[case] pairs: &str,
    #[case] keys: Value,
) {
    let outcome = copies(1, |_, study| study.settings.axis = axis);
    let (latex, report) = (latex(std::slice::from_ref(&outcome)), text(&outcome));
    assert!(latex.contains(&format!("    {heads} \\\\\n")), "{latex}");
    assert!(latex.contains(&format!("    {row}$2.000 \\times 10^{{-2}}$ & $1.11$")), "{latex}");
    assert!(report.contains(&format!("  levels\n{levels}")), "{report}");
    assert!(texts(&svg(&outcome)[0].svg).contains(&label));
    let words = flat(&report);
    assert!(words.contains(&format!("order between neighbouring levels {pairs}")), "{report}");
    let case = suite::json::case(&outcome.cases[0]);
    assert_eq!(json!([case["axis"], case["formal_order"]]), keys);
}

/// The limits of the four cases are 0.0012 m, with an interval from 0.001 to 0.0015 m; the exact
/// value is 0.00126 m.
#[test]
fn overview_counts_the_cases_of_each_kind() {
    let estimates = copies(4, |k, study| match k {
        0 => study.levels[2].run.observed_exact = Some(vec![0.0016]),
        1 => study.observed_limit = Some(Err(EstimateRefusal::Unusable)),
        _ => study.judgement.order = Some(interval(1.5 + k as f64, 1.0, 5.0)),
    });
    let text = overview(std::slice::from_ref(&estimates));
    let words = flat(&text);
    assert!(words.contains("in 2 of 3 cases; 1 of 4 cases have no estimate"), "{text}");
    assert!(glance(&[estimates]).contains("  odd    2.00..4.50  4 pass\n"));
    let verdicts = copies(Verdict::ALL.len(), |k, study| study.judgement.verdict = Verdict::ALL[k]);
    let words = "2.00/floor/unsettled/oscillates/grows/breaks/few levels";
    assert_eq!(matrix::findings(&verdicts)[0], words);
    assert_eq!(matrix::shares(&[&verdicts])[0], (2, 9));
}

#[test]
fn report_describes_the_levels_with_crossings_and_failures() {
    let crossings = [[0, 0, 7], [0, 7, 7], [0, 0, 0], [7, 7, 7]];
    let report = text(&copies(4, |k, study| {
        for (level, count) in study.levels.iter_mut().zip(crossings[k]) {
            level.run.counters.crossings = Some(count);
        }
        let failed = if k == 2 { &mut study.levels[1..] } else { &mut study.levels[2..][..k / 3] };
        for level in failed {
            level.run.failure = Some("broken".to_owned());
        }
    }));
    for line in [
        "  crossings     particles change cells on the finest level only (case-0)\n",
        "  crossings     particles change cells on the level with 10 cells and on finer levels (case-1)\n",
        "  crossings     no particle changes its cell (case-2)\n",
        "  crossings     particles change cells on every level (case-3)\n",
        "  remark        case-2: 10 cells to 20 cells (2 levels): broken\n",
        "  remark        case-3: 20 cells: broken\n",
    ] {
        assert!(report.contains(line), "{line}{report}");
    }
}

/// A plot has at most six curves. Seven curves have the largest error 0.06 times 7.
#[test]
fn curves_of_many_cases_are_drawn_in_plots_with_the_same_axes() {
    let scale = |k: usize, study: &mut Convergence| {
        study.judgement.levels.iter_mut().for_each(|level| level.error *= 1.0 + k as f64);
    };
    let figures = svg(&copies(7, scale));
    let [first, second] = [0, 1].map(|k| texts(&figures[k].svg));
    assert_eq!([&figures[0].file, &figures[1].file], ["odd-1.svg", "odd-2.svg"]);
    let position = |texts: &[&str]| texts.iter().position(|text| text.starts_with("case-"));
    let (a, b) = (position(&first).expect("a name"), position(&second).expect("a name"));
    assert_eq!((&first[..a], first[a + 3]), (&second[..b], "case-3: order 2.00"));
    assert_eq!(second[b], "case-4: order 2.00");
    // Slopes of reference lines are multiples of a third.
    let slopes = svg(&copies(1, |_, study| study.judgement.order = Some(interval(1.34, 1.3, 1.4))));
    assert!(texts(&slopes[0].svg).contains(&"order 4/3"), "{slopes:?}");
    // Curves with equal points share a line, and a name.
    let equal = texts(&svg(&copies(2, |_, _| ()))[0].svg).join("|");
    assert!(equal.contains("|case-{0,1}: order 2.00|"), "{equal}");
}

#[test]
fn maps_have_the_limits_and_the_measured_values() {
    let figures = svg(&outcome());
    let files: Vec<&str> = figures.iter().map(|figure| figure.file.as_str()).collect();
    let expected = ["odd.svg", "odd.svg", "odd-momentum.svg", "odd-least_j.svg"];
    assert_eq!(files, [&expected[..], &["odd-work-transfers.svg"]].concat());
    // A limit above the searched range has no colour.
    assert!(figures[1].pgfplots.contains("\n0 0 7.31e-1\n1 0 nan\n"), "{figures:?}");
    let scale = "dark is low, light is high";
    for (figure, expected) in figures[1..4].iter().zip([
        "50 % of a bar|parameter place|0.25|0.375|limit|0.731|&gt; 4|limit of C",
        "50 % of a bar: momentum drift|parameter load|0.25|0.375|sweep|0.400|0.401|momentum drift",
        "50 % of a bar: min J|parameter load|0.25|0.375|sweep|0.600|0.601|min J",
    ]) {
        assert_eq!(texts(&figure.svg).join("|"), format!("{expected}: {scale}"));
    }
}

const TEXT: &str = r"odd: 50 % of a bar

  result        4 pass, 2 known limits, 1 not applicable, 1 FAIL
  FAIL          mpm-ugimp: the run failed

  case        result          note  verdict           order  95 % interval         error
  mpm-linear  pass            a     converging         2.00  [1.90, 2.20]      2.000e-02
  mpm-ugimp   FAIL            b     failed                -  -                    failed
  force       pass            a     agrees                -  -                         -
  limit       pass            a     limit of C            -  -                         -
  sweep       known limit     a     stable, unstable      -  -                         -
  derivative  pass            a     wrong                 -  -                         -
  wave        known limit     a     failed                -  -                         -
  other       not applicable  a     not applicable        -  -                         -

  a   order 1.75; reason: a proof
  b   order 1.75; reason: a guess

  remark        mpm-linear: on the finest level the main cause of the error is the cell size; the
                error is 0.5; with half the time step it is 0.45, with half the cell size it is
                0.125, with half the particle spacing it is not available (no room)
  remark        mpm-linear: remark 1
  remark        mpm-ugimp: steps are longer than the stable time step: 5 cells, 10 cells, 20 cells
  remark        mpm-ugimp: 20 cells: broken at 7 s
  remark        mpm-ugimp: remark 2
  remark        sweep: load = 0.375: energy grows
  remark        wave: 8 cells, C = 0.5: no wave
  remark        wave: reason wave
  remark        other: the solver lacks fixed

First.

  source        a book
  problem
    young                E = 7
  methods
    transfer             flip
  effects       gravity, traction
  levels (mpm-linear)
    5, 10, 20 cells along X
    h = 0.4 ... 0.1 m
    dt = 0.001001 ... 0.001201 s
    4 ... 6 particles per cell
    1051 ... 1251 particles
    1056 ... 1256 steps
  levels (mpm-ugimp)
    5, 10, 20 cells along X
    h = 0.4 ... 0.25 m
    dt = 0.002001 ... 0.002101 s
    2051 ... 2151 particles
    2056 ... 2156 steps
  crossings     particles change cells on every level

  l2 error of velocity at the end, divided by 2.5 m/s
  cells                 5           10           20
  mpm-linear  (6.000e-02)    2.000e-02  (5.000e-03)
  mpm-ugimp   (8.000e-02)  (3.000e-02)     (failed)
  (in parentheses: errors that are not used to determine the order)

  order between neighbouring levels
  cells        5-10  10-20
  mpm-linear   1.11   1.22
  mpm-ugimp    2.11   2.22

  spread between runs, in the norm of the error
  cells                 5           10           20
  mpm-linear    1.003e-03    1.103e-03    1.203e-03
  mpm-ugimp     2.003e-03    2.103e-03    2.203e-03

  rms error over time of the velocity near X = 0.35 m, divided by its largest exact value
  cells                 5           10           20
  mpm-linear    5.590e-01    7.289e-01    9.014e-01
  mpm-ugimp     1.075e+00    1.250e+00    1.425e+00

  on the finest level
                   linf of
              displacement   linf
  case          at end (m)  order  transfers    outside   min J      speed/c  dt/stable
  mpm-linear     1.224e-03  -0.12    1252000       1254  1.2550         6e-4      0.665
  mpm-ugimp              -  -0.07    2252000       2254  2.2550       failed      1.997

  conservation, all levels: largest change since t = 0, divided by the sum of magnitudes over the
  body
  case           momentum       energy
  mpm-linear         2e-3         6e-3
  mpm-ugimp          2e-4         6e-4

  rate of the energy on the finest level, d ln E/dt (1/s)
  case               rate          low  high (95 %)
  mpm-linear    1.241e-03    1.242e-03    1.243e-03
  mpm-ugimp        failed       failed       failed

  u at X = 0.35 m at the end, extrapolated from the four finest levels to zero spacing; 1 of 1 cases
  have an estimate
                                                                     exact
                            extrapolated                                 u
  case        order     +-             u    +- (95 %)   true error  inside
  mpm-linear   1.50   0.31       1.20e-3     2.50e-04     6.00e-05     yes

  force
             n      n
     x/h  left  right        force    predicted   difference
  0.1250     3      4    1.500e+00    1.200e+00         3e-1
  0.6250     2      5   -2.500e+00   -2.000e+00        -5e-1

  predicted
  C          place=0.25  place=0.375
  limit          0.7310            -

  critical
  eigenvalue       place=0.25  place=0.375
  limit       -0.60 +- 0.80 i            -

  observed
  C         place=0.25  place=0.375
  limit         < 0.05          > 4

  runs at
  0.9 times
  the
  predicted
  C          place=0.25  place=0.375
  limit          stable            -

  runs at
  1.1 times
  the
  predicted
  C          place=0.25  place=0.375
  limit        unstable            -

                                          momentum
  case    load  verdict         steps        drift        min J
  sweep   0.25  stable            500    4.000e-01    6.000e-01
  sweep  0.375  unstable          501    4.010e-01    6.010e-01

  derivative
  cells           dt     gradient        exact        error  order
      6    6.001e-03    2.200e+01    2.300e+01    1.000e+00      -
     12    6.101e-03    2.325e+01    2.300e+01    2.500e-01   2.00

  k    remainder  order   difference
  1    6.000e+00      -    2.300e+01
  2    1.750e+00   1.78    2.300e+01

                                             predicted
         cells per                    phase      phase             predicted
  case  wavelength      C  steps      error      error  amplitude  amplitude
  wave           4   0.25    704  -1.2000 %  -1.2500 %   1.000000   0.606531
  wave           8    0.5    708          -          -          -   0.778801

                cells per
               wavelength
                    for a
                    phase  stability
               error of 1   limit of
  case      C           %          C
  wave   0.25        4.75     1.1250
  wave    0.5        8.75     1.0625
";

const LATEX: &str = r"\begin{table}
  \centering
  \caption{50 \% of a bar: l2 error of velocity at the end, divided by 2.5 m/s. Levels in parentheses do not count for the order.}
  \label{tab:odd}
  \begin{tabular}{rrrrr}
    \toprule
    & \multicolumn{2}{c}{mpm-linear} & \multicolumn{2}{c}{mpm-ugimp} \\
    \cmidrule(lr){2-3} \cmidrule(lr){4-5}
    cells & error & order & error & order \\
    \midrule
    $5$ & ($6.000 \times 10^{-2}$) & -- & ($8.000 \times 10^{-2}$) & -- \\
    $10$ & $2.000 \times 10^{-2}$ & $1.11$ & ($3.000 \times 10^{-2}$) & $2.11$ \\
    $20$ & ($5.000 \times 10^{-3}$) & $1.22$ & (failed) & $2.22$ \\
    \midrule
    order (95\,\%) & \multicolumn{2}{c}{$2.00$ [$1.90$, $2.20$]} & \multicolumn{2}{c}{failed} \\
    \bottomrule
  \end{tabular}
\end{table}
";

const COST: &str = r"== cost, a problem ==
  error             divided by 4.00e+00, the largest exact value of the judged quantity
  work              seconds, interpolated between neighbouring levels, never extrapolated

             work for            work for                                      Pareto
  method         1e-2      x         1e-3      x   best error     not reached   front
  exact      4.00e+01   1.00     4.00e+02   1.00     4.00e-04               -  3 of 3
  cheap      6.79e+01   1.70            -      -     5.00e-03  no finer level  2 of 3

                          high
  work ~                   (95
  error^k      k    low     %)  theory
  exact    -1.00  -1.00  -1.00   -0.75  order 3.32, not 4.00
  cheap    -1.50  -1.50  -1.50   -1.50  agrees
";

const TIMED: &str = r"odd: 50 % of a bar

  machine           3 cores, load 0.25 before, 0.50 after
  noise             12 % of the time was spent waiting for a core, and is excluded; times of a fixed
                    loop differ by 18.8 % between quartiles (11 runs)
  seconds           steps only, on one thread, median of interleaved repeats

  case        cells           dt  ppc        error  transfers      seconds           quartiles
  mpm-linear      5     1.00e-03    4     1.50e-02    1052000     1.07e-03  1.01e-03..1.10e-03
  mpm-linear     10     1.10e-03    5     5.00e-03    1152000     1.17e-03  1.11e-03..1.20e-03
  mpm-linear     20     1.20e-03    6     1.25e-03    1252000     1.27e-03  1.21e-03..1.30e-03
  mpm-ugimp       5     2.00e-03    -     2.00e-02    2052000     2.07e-03  2.01e-03..2.10e-03
  mpm-ugimp      10     2.10e-03    -     7.50e-03    2152000     2.17e-03  2.11e-03..2.20e-03
  mpm-ugimp      20     2.20e-03    -       failed    2252000     2.27e-03  2.21e-03..2.30e-03

  case        repeats  ns/transfer
  mpm-linear        7         1.02
  mpm-linear        8         1.02
  mpm-linear        9         1.02
  mpm-ugimp         7         1.01
  mpm-ugimp         8         1.01
  mpm-ugimp         9         1.01
";

const DIAGNOSIS: &str = r"== bar ==
Theory gives order 2, and the verdict is too low: the order is low. Cause: a cause. With basis:
cubic the order from 8 cells to 32 cells is 2.01 [1.96, 2.04] (before: 1.20 [1.15, 1.35]), and the
error on the finest level is 1.000e-3, 1/8 of 8.000e-3; relative to the exact solution, it is 1/16
of the error before. Remedy: a remedy.

  changed       verdict                     order  error/before
  scheme: usf   too low         0.90 [0.70, 1.40]         1.500
  basis: cubic  converging      2.01 [1.96, 2.04]         0.125
  beyond the budget 64 cells; more particles
";

const PGFPLOTS: &str = r"\documentclass{standalone}
\usepackage{pgfplots}
\pgfplotsset{compat=1.15}
\begin{document}
\begin{tikzpicture}
\begin{loglogaxis}[title={50 \% of a bar}, xlabel={cell size h (m)}, ylabel={l2 error of velocity, divided by 2.5 m/s}, grid=major, legend pos=outer north east, legend cell align=left, xtick={1e-1,2e-1,5e-1,1e0,2e0,5e0}, xticklabels={$0.1$,$0.2$,$0.5$,$1$,$2$,$5$}, ytick={1e-3,2e-3,5e-3,1e-2,2e-2,5e-2,1e-1,2e-1,5e-1}, yticklabels={$10^{-3}$,$2 \cdot 10^{-3}$,$5 \cdot 10^{-3}$,$0.01$,$0.02$,$0.05$,$0.1$,$0.2$,$0.5$}]
\definecolor{neutral}{HTML}{4D4D4D}
\definecolor{context}{HTML}{8E8E8E}
\definecolor{series0}{HTML}{0072B2}
\addplot[series0, dashed, thin, forget plot, mark=*, mark options={solid, fill=white, rotate=0}] table {
x y
2e-1 5e-3
4e-1 2e-2
8e-1 6e-2
};
\addplot[series0, thick, mark=*, mark options={solid, rotate=0}, forget plot] table {
x y
2e-1 5e-3
4e-1 2e-2
};
\addlegendimage{series0, thick, mark=*, mark options={solid, rotate=0}}
\addlegendentry{mpm-linear: order 2.00}
\definecolor{series1}{HTML}{D55E00}
\addplot[series1, dashed, thin, forget plot, mark=square*, mark options={solid, fill=white, rotate=0}] table {
x y
4e-1 3e-2
8e-1 8e-2
};
\addplot[series1, thick, mark=square*, mark options={solid, rotate=0}, forget plot] table {
x y
};
\addlegendimage{series1, thick, mark=square*, mark options={solid, rotate=0}}
\addlegendentry{mpm-ugimp: failed}
\addplot[neutral, dotted, thick, forget plot] table {
x y
2.3094010767585035e-1 2.5e-3
8e-1 3e-2
};
\addlegendimage{neutral, dotted, thick}
\addlegendentry{order $2$}
\end{loglogaxis}
\end{tikzpicture}
\end{document}
";
