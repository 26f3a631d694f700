//! Tables of levels: what was measured on each, and what it cost.

use super::table::{Table, optional, scientific};
use crate::verify::{Axis, Convergence, History, LevelOutcome, Quantity};

/// Errors, work, drifts and Richardson's extrapolation, level by level.
pub(crate) fn tables(lines: &mut Vec<String>, study: &Convergence) {
    let figures = ["rms", "l1", "l2", "linf", "max rms", "velocity", "judged", "order", "counts"];
    let mut errors = Table::new(&[spacing_heads(study.axis), &figures].concat());
    let figures =
        ["particles", "steps", "transfers", "crossings", "outside", "min J", "speed/c", "dt/safe"];
    let mut work = Table::new(&[&level_heads(study.axis)[..], &figures].concat());
    for (index, level) in study.levels.iter().enumerate() {
        errors.row(error_row(study, index, level));
        work.row(work_row(study.axis, level));
    }
    lines.extend(errors.without_empty_columns().lines());
    lines.push(String::new());
    lines.extend(work.without_empty_columns().lines());
    drifts(lines, study);
    rates(lines, study);
    richardson(lines, study);
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

/// Errors of the displacement (m), or of the temperature (K) where that is judged; and of the observed velocity relative to its largest value.
fn error_row(study: &Convergence, index: usize, level: &LevelOutcome) -> Vec<String> {
    let run = &level.run;
    let (errors, max_rms) = match study.of {
        Quantity::Temperature => (run.at_end, run.largest.rms),
        _ => (run.errors, run.max_rms),
    };
    let error = |value| match (&run.failure, study.compared) {
        (Some(_), _) => "failed".to_owned(),
        (None, true) => scientific(value),
        (None, false) => "-".to_owned(),
    };
    let window = study.judgement.window.as_deref().unwrap_or_default();
    let counts = match (level.usable, window.contains(&index)) {
        (false, _) => "no: crossings",
        (true, true) => "yes",
        _ if study.bounded => "yes",
        (true, false) => "no",
    };
    let figures = [
        error(errors.rms),
        error(errors.l1),
        error(errors.l2),
        error(errors.linf),
        error(max_rms),
        optional(run.history.as_ref().and_then(History::relative_error).map(scientific)),
        if study.is_judged_by_another_figure() { error(level.error) } else { "-".to_owned() },
        optional(level.order.map(|order| format!("{order:.2}"))),
        counts.to_owned(),
    ];
    spacings(study.axis, level).into_iter().chain(figures).collect()
}

/// What the level cost, and what a reader must know beside its error.
fn work_row(axis: Axis, level: &LevelOutcome) -> Vec<String> {
    let counters = &level.run.counters;
    let figures = [
        optional(counters.particles),
        level.run.steps.to_string(),
        counters.transfers.to_string(),
        optional(counters.crossings),
        optional(counters.left_domain),
        format!("{:.4}", counters.min_j),
        optional(level.run.unrest.map(|unrest| match level.run.failure {
            Some(_) => "failed".to_owned(),
            None => format!("{unrest:.0e}"),
        })),
        optional(level.safe_step.map(|stable| format!("{:.3}", level.dt / stable))),
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

/// How fast the energy grows or decays, where the suite asks.
fn rates(lines: &mut Vec<String>, study: &Convergence) {
    if !study.rated {
        return;
    }
    lines.extend([String::new(), "  rate of the energy, d ln E/dt (1/s)".to_owned()]);
    let mut table = Table::new(&["cells", "rate", "from", "to (95 %)"]);
    for level in &study.levels {
        let figures = match (&level.run.failure, level.run.energy_rate) {
            (None, Some(rate)) => [rate.value, rate.low, rate.high].map(scientific),
            (None, None) => ["-"; 3].map(str::to_owned),
            (Some(_), _) => ["failed"; 3].map(str::to_owned),
        };
        table.row([level.cells.to_string()].into_iter().chain(figures).collect());
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
