//! The report as text: aligned tables that read well in a diff.
//!
//! Errors have four significant digits, orders two decimals; counters are exact. Nothing in it
//! depends on the machine.

use super::table::{Table, optional, scientific};
use crate::verify::{
    Axis, CaseOutcome, Convergence, ForceRow, History, LevelOutcome, Study, SuiteOutcome,
};

/// Width to which prose is wrapped.
const WIDTH: usize = 100;

/// The whole report of a suite.
pub fn text(outcome: &SuiteOutcome) -> String {
    let mut lines = vec![format!("{}: {}", outcome.suite, outcome.title), String::new()];
    for paragraph in outcome.about.split("\n\n") {
        wrap(&mut lines, WIDTH, paragraph);
    }
    lines.push(String::new());
    row(&mut lines, "source", &outcome.source);
    for (key, value) in &outcome.statement {
        row(&mut lines, key, value);
    }
    for case in &outcome.cases {
        lines.push(String::new());
        case_lines(&mut lines, case);
    }
    lines.join("\n") + "\n"
}

/// The report of one case, for failing tests.
pub fn case(outcome: &CaseOutcome) -> String {
    let mut lines = Vec::new();
    case_lines(&mut lines, outcome);
    lines.join("\n") + "\n"
}

/// One line for each case: the table that `run` prints.
pub fn summary(outcomes: &[SuiteOutcome]) -> String {
    let mut table = Table::new(&["", "case", "verdict", "order", "expected"]);
    for suite in outcomes {
        for case in &suite.cases {
            let order = case.convergence().and_then(|study| study.judgement.order);
            table.row(vec![
                if case.passed() { "pass" } else { "FAIL" }.to_owned(),
                format!("{}::{}", suite.suite, case.case),
                case.verdict.clone(),
                optional(order.map(|o| format!("{:.2} [{:.2}, {:.2}]", o.value, o.low, o.high))),
                case.expected.clone(),
            ]);
        }
    }
    table.flush_left(&[1, 2, 4]).lines().join("\n") + "\n"
}

fn case_lines(lines: &mut Vec<String>, case: &CaseOutcome) {
    lines.push(format!("== {} ==", case.case));
    let settings: Vec<String> =
        case.settings.iter().map(|(key, value)| format!("{key}: {value}")).collect();
    row(lines, "method", &settings.join("; "));
    lines.push(String::new());
    match &case.study {
        Study::Convergence(study) => convergence(lines, study),
        Study::InternalForce(rows) => internal_force(lines, rows),
        Study::Refused => {}
    }
    lines.push(String::new());
    row(lines, "verdict", &format!("{}: {}", case.verdict, case.reason));
    row(lines, "expected", &format!("{}, because {}", case.expected, case.because));
    if case.passed() {
        row(lines, "result", "as expected");
    }
    for unmet in &case.unmet {
        row(lines, "result", &format!("NOT AS EXPECTED: {unmet}"));
    }
}

fn convergence(lines: &mut Vec<String>, study: &Convergence) {
    let figures = ["rms", "l1", "l2", "linf", "max rms", "velocity", "judged", "order", "counts"];
    let mut errors = Table::new(&[spacing_heads(study.axis), &figures].concat());
    let figures = ["particles", "steps", "transfers", "crossings", "outside", "min J"];
    let mut work = Table::new(&[&level_heads(study.axis)[..], &figures].concat());
    for (index, level) in study.levels.iter().enumerate() {
        errors.row(error_row(study, index, level));
        work.row(work_row(study.axis, level));
    }
    lines.extend(errors.without_empty_columns().lines());
    lines.push(String::new());
    lines.extend(work.without_empty_columns().lines());
    drifts(lines, study);
    richardson(lines, study);
    let failure = |level: &LevelOutcome| Some((level.name(study.axis), level.run.failure.clone()?));
    for (level, failure) in study.levels.iter().filter_map(failure) {
        lines.push(String::new());
        row(lines, "failure", &format!("{level}: {failure}"));
    }
    if let Some(lost) = order_lost(study) {
        lines.push(String::new());
        row(lines, "crossing", &lost);
    }
}

/// What comes first in the table of errors: what the suite lists, and the spacing that is judged.
fn spacing_heads(axis: Axis) -> &'static [&'static str] {
    match axis {
        Axis::Space => &["cells", "h"],
        Axis::Time => &["dt"],
        Axis::Particles => &["ppc", "spacing"],
    }
}

fn spacings(axis: Axis, level: &LevelOutcome) -> Vec<String> {
    match axis {
        Axis::Space => vec![level.cells.to_string(), scientific(level.spacing)],
        Axis::Time => vec![scientific(level.spacing)],
        Axis::Particles => vec![optional(level.ppc), scientific(level.spacing)],
    }
}

/// What makes a level, the refined axis first.
fn level_heads(axis: Axis) -> [&'static str; 3] {
    match axis {
        Axis::Space => ["cells", "dt", "ppc"],
        Axis::Time => ["dt", "cells", "ppc"],
        Axis::Particles => ["ppc", "cells", "dt"],
    }
}

fn level_parts(axis: Axis, level: &LevelOutcome) -> [String; 3] {
    let (cells, dt, ppc) = (level.cells.to_string(), scientific(level.dt), optional(level.ppc));
    match axis {
        Axis::Space => [cells, dt, ppc],
        Axis::Time => [dt, cells, ppc],
        Axis::Particles => [ppc, cells, dt],
    }
}

/// Errors of the displacement (m), and of the observed velocity relative to its largest value.
fn error_row(study: &Convergence, index: usize, level: &LevelOutcome) -> Vec<String> {
    let run = &level.run;
    let error = |value| if run.failure.is_some() { "failed".to_owned() } else { scientific(value) };
    let window = study.judgement.window.as_deref().unwrap_or_default();
    let counts = match (level.usable, window.contains(&index)) {
        (false, _) => "no: crossings",
        (true, true) => "yes",
        _ if study.bounded => "yes",
        (true, false) => "no",
    };
    let figures = [
        error(run.errors.rms),
        error(run.errors.l1),
        error(run.errors.l2),
        error(run.errors.linf),
        error(run.max_rms),
        optional(run.history.as_ref().and_then(History::relative_error).map(scientific)),
        if study.is_judged_by_another_figure() { error(level.error) } else { "-".to_owned() },
        optional(level.order.map(|order| format!("{order:.2}"))),
        counts.to_owned(),
    ];
    spacings(study.axis, level).into_iter().chain(figures).collect()
}

/// What the level cost, and what a reader must know beside its error.
fn work_row(axis: Axis, level: &LevelOutcome) -> Vec<String> {
    let census = &level.run.census;
    let figures = [
        optional(census.particles),
        level.run.steps.to_string(),
        census.transfers.to_string(),
        optional(census.crossings),
        optional(census.left_domain),
        format!("{:.4}", census.min_j),
    ];
    level_parts(axis, level).into_iter().chain(figures).collect()
}

/// How far totals drifted, of those that the suite asks for; of rounding one digit says enough.
fn drifts(lines: &mut Vec<String>, study: &Convergence) {
    if study.drifts.is_empty() {
        return;
    }
    lines.extend([String::new(), "  relative drift".to_owned()]);
    let names = study.drifts.iter().map(|sum| sum.words());
    let heads: Vec<String> = ["cells".to_owned()].into_iter().chain(names).collect();
    let mut table = Table::new(&heads.iter().map(String::as_str).collect::<Vec<_>>());
    for level in &study.levels {
        let shown = |drift: f64| match level.run.failure {
            Some(_) => "failed".to_owned(),
            None => format!("{drift:.0e}"),
        };
        let drift = |sum| optional(level.run.drift.map(|drift| shown(drift.of(sum))));
        let cells = [level.cells.to_string()].into_iter();
        table.row(cells.chain(study.drifts.iter().map(|sum| drift(*sum))).collect());
    }
    lines.extend(table.lines());
}

/// Richardson's extrapolation at the observed place, triple by triple.
fn richardson(lines: &mut Vec<String>, study: &Convergence) {
    let (Some(place), false) = (study.place(), study.richardson.is_empty()) else { return };
    lines.push(String::new());
    lines.push(format!("  Richardson's extrapolation of u at X = {place} m"));
    let head = level_heads(study.axis)[0];
    let mut table = Table::new(&[head, "ratio", "class", "order", "extrapolated u", "gci"]);
    for (triple, found) in &study.richardson {
        let [a, b, c] = triple.map(|k| level_parts(study.axis, &study.levels[k])[0].clone());
        table.row(vec![
            format!("{a}, {b}, {c}"),
            format!("{:.2}", found.ratio),
            found.class.to_string(),
            optional(found.order.map(|order| format!("{order:.2}"))),
            optional(found.extrapolated.map(scientific)),
            optional(found.gci.map(scientific)),
        ]);
    }
    lines.extend(table.lines());
}

/// Where particles begin to change their cell, and what that does to the order.
fn order_lost(study: &Convergence) -> Option<String> {
    let first = study.levels.iter().find(|level| level.run.census.crossings.unwrap_or(0) > 0)?;
    let crossings = first.run.census.crossings?;
    let finest = study.levels.last()?;
    if study.levels.len() == 1 {
        return Some(format!("particles change their cell {crossings} times"));
    }
    let pair = |level: &LevelOutcome| {
        level.order.map_or("no order".to_owned(), |order| format!("order {order:.2}"))
    };
    Some(format!(
        "particles change their cell from {} on ({crossings} crossings, {} against the next \
         coarser level); on the finest level, {}, {} crossings and {}",
        first.name(study.axis),
        pair(first),
        finest.name(study.axis),
        finest.run.census.crossings.unwrap_or(0),
        pair(finest),
    ))
}

fn internal_force(lines: &mut Vec<String>, rows: &[ForceRow]) {
    let mut table = Table::new(&["x/h", "n left", "n right", "force", "predicted", "difference"]);
    for force in rows {
        table.row(vec![
            format!("{:.4}", force.position),
            force.left.to_string(),
            force.right.to_string(),
            scientific(force.force),
            scientific(force.predicted),
            format!("{:.0e}", force.force - force.predicted),
        ]);
    }
    lines.extend(table.lines());
}

/// `key` in a column of its own, `value` wrapped beside it.
fn row(lines: &mut Vec<String>, key: &str, value: &str) {
    const KEY: usize = 18;
    let mut wrapped = Vec::new();
    wrap(&mut wrapped, WIDTH - KEY - 2, value);
    for (i, line) in wrapped.iter().enumerate() {
        let key = if i == 0 { key } else { "" };
        lines.push(format!("  {key:KEY$}{line}").trim_end().to_owned());
    }
}

/// Wraps prose at word boundaries.
fn wrap(lines: &mut Vec<String>, width: usize, prose: &str) {
    let mut line = String::new();
    for word in prose.split_whitespace() {
        if !line.is_empty() && line.chars().count() + 1 + word.chars().count() > width {
            lines.push(std::mem::take(&mut line));
        }
        if !line.is_empty() {
            line.push(' ');
        }
        line.push_str(word);
    }
    lines.push(line);
}
