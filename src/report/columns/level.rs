//! Columns of the levels of a convergence study.

use super::{Cell, TableColumn, decimals, json_object, number, scientific};
use crate::verify::{
    Axis, CaseOutcome, Conserved, Convergence, Exclusion, History, Interval, Level, LevelOutcome,
    Quantity, RunErrors, StepKind, observed_order,
};
use serde_json::Value;

pub(crate) struct LevelRow<'a> {
    study: &'a Convergence,
    index: usize,
    level: &'a LevelOutcome,
}

pub(crate) type LevelColumn<'a> = TableColumn<'a, LevelRow<'a>>;

pub(crate) type NamedStudy<'a> = (&'a str, &'a Convergence);

pub(crate) fn rows(study: &Convergence) -> impl Iterator<Item = LevelRow<'_>> {
    study.levels.iter().enumerate().map(move |(index, level)| LevelRow { study, index, level })
}

pub(crate) fn cells<'a>() -> LevelColumn<'a> {
    LevelColumn::plain("cells", "cells", "cells along the first axis", |row| row.level.cells)
}

fn dt<'a>() -> LevelColumn<'a> {
    LevelColumn::number("dt", "dt", "time step (s)", scientific, |row| row.level.dt)
}

fn ppc<'a>() -> LevelColumn<'a> {
    LevelColumn::plain("ppc", "ppc", "particles per cell (MPM)", |row| row.level.ppc)
}

/// Returns the column of the refined axis: cells, time step or particles per cell.
pub(crate) fn name<'a>(axis: Axis) -> LevelColumn<'a> {
    match axis {
        Axis::Space => cells(),
        Axis::Time => dt(),
        Axis::Particles => ppc(),
    }
}

pub(crate) fn names(study: &Convergence) -> Vec<String> {
    let name = name(study.axis);
    rows(study).map(|row| name.cell(&row).text).collect()
}

pub(crate) fn judged<'a>() -> LevelColumn<'a> {
    let about = "judged error; in parentheses if the level does not count for the verdict";
    LevelColumn::new("error", "judged", about, |row| {
        let cell = row.error(row.level.error);
        let text = if row.counts() { cell.text } else { format!("({})", cell.text) };
        Cell { text, ..cell }
    })
}

pub(crate) fn order<'a>() -> LevelColumn<'a> {
    let about = "order between the next coarser level and this one";
    LevelColumn::number("order", "order", about, decimals(2), |row| row.level.order)
}

/// Returns the columns of the displacement error norms (m).
fn norms<'a>() -> [LevelColumn<'a>; 5] {
    let column = |key: &'static str, about: &'static str, norm: fn(&RunErrors) -> f64| {
        LevelColumn::json(key, about, move |row| {
            row.study.compared.then(|| number(norm(row.level.run.errors_of_displacement())))
        })
    };
    [
        column("errors.rms", "root of the mean square error", |of| of.at_end.rms),
        column("errors.l1", "weighted mean error", |of| of.at_end.l1),
        column("errors.l2", "root of the weighted mean square error", |of| of.at_end.l2),
        column("errors.linf", "largest error", |of| of.at_end.linf),
        column("errors.max_rms", "largest rms over the instants", |of| of.largest.rms),
    ]
}

/// Returns two columns: the largest error of the quantity `of` at the end (a dash if it is the
/// judged error), and the order of this error.
pub(crate) fn largest_error<'a>(of: Quantity) -> [LevelColumn<'a>; 2] {
    let heading = format!("linf of {} at end ({})", of.words(), of.unit());
    let about = "order of the largest error between the two finest levels";
    [
        LevelColumn::text(heading, "largest error at the end of the run", |row| {
            let shown = row.error(row.linf()).text;
            (shown != row.error(row.level.error).text).then_some(shown)
        }),
        LevelColumn::text("linf order", about, |row| {
            let index = row.index.checked_sub(1)?;
            let coarser = LevelRow { study: row.study, index, level: row.study.levels.get(index)? };
            let level = |row: &LevelRow<'_>| Level::new(row.level.spacing, row.linf());
            let order = observed_order(&level(&coarser), &level(row));
            order.filter(|_| row.study.compared).map(decimals(2))
        }),
    ]
}

pub(crate) fn spread<'a>() -> LevelColumn<'a> {
    let about = "largest difference between repeated runs, in the norm of the error and divided by \
                 its scale";
    LevelColumn::new("spread", "spread", about, |row| {
        let text = |spread| if spread == 0.0 { "0".to_owned() } else { scientific(spread) };
        let spread = row.level.spread;
        Cell { json: spread.map_or(Value::Null, number), ..Cell::text(spread.map(text)) }
    })
}

pub(crate) fn velocity<'a>() -> LevelColumn<'a> {
    let about = "rms error over time of the velocity at the observed point, divided by the largest \
                 exact value";
    LevelColumn::text("velocity", about, |row| {
        let history = row.level.run.history.as_ref();
        history.and_then(History::relative_error).map(scientific)
    })
}

pub(crate) fn counters<'a>() -> Vec<LevelColumn<'a>> {
    let outside = "particles outside the grid at the end";
    let min_j = "smallest det F of the run; it remains positive if a particle is inverted along two \
                 axes at once";
    let speed = "for an equilibrium: largest speed in the last tenth of the run, divided by the wave \
                 speed";
    let stable = "time step divided by the stable time step; in JSON the stable time step (s)";
    vec![
        LevelColumn::plain("particles", "particles", "particles (MPM)", |row| {
            row.level.run.counters.particles
        }),
        LevelColumn::plain("steps", "steps", "steps taken", |row| row.level.run.steps),
        LevelColumn::new("transfers", "transfers", "particle-node pairs of P2G and G2P", |row| {
            // External solvers do not count transfers.
            let transfers = row.level.run.counters.transfers;
            Cell { json: transfers.into(), ..Cell::text(Some(transfers).filter(|n| *n > 0)) }
        }),
        LevelColumn::plain("crossings", "crossings", "changes of cell (MPM)", |row| {
            row.level.run.counters.crossings
        }),
        LevelColumn::new("outside", "left_domain", outside, |row| {
            let outside = row.level.run.counters.left_domain;
            Cell { json: outside.into(), ..Cell::text(outside.filter(|count| *count > 0)) }
        }),
        LevelColumn::number("min J", "min_j", min_j, decimals(4), |row| {
            Some(row.level.run.counters.min_j).filter(|j| !j.is_nan())
        }),
        LevelColumn::new("speed/c", "residual_speed", speed, |row| {
            let cell = row.unless_failed(row.level.run.residual_speed);
            // Load steps have no speed.
            let is_load = row.study.steps == StepKind::Load;
            if is_load { Cell { text: "-".to_owned(), ..cell } } else { cell }
        }),
        LevelColumn::new("dt/stable", "stable_time_step", stable, |row| {
            let stable = row.level.stable_time_step;
            let ratio = Cell::number(stable.map(|stable| row.level.dt / stable), decimals(3));
            Cell { json: stable.map_or(Value::Null, number), ..ratio }
        }),
    ]
}

pub(crate) fn drift<'a>(sum: Conserved) -> LevelColumn<'a> {
    let about = "largest relative change of the sum since t = 0";
    LevelColumn::new(sum.words(), sum.name(), about, move |row| {
        row.unless_failed(row.level.run.drift.map(|drift| drift.of(sum)))
    })
}

pub(crate) fn largest_drift<'a>(sum: Conserved) -> LevelColumn<'a> {
    LevelColumn::text(sum.words(), "largest drift of any level", move |row| {
        let of_level = |row: &LevelRow<'_>| row.level.run.drift.map_or(0.0, |drift| drift.of(sum));
        let most = rows(row.study).max_by(|a, b| of_level(a).total_cmp(&of_level(b)))?;
        Some(drift(sum).cell(&most).text)
    })
}

pub(crate) fn energy_rate<'a>() -> [LevelColumn<'a>; 3] {
    let column = |heading: &'static str, about: &'static str, end: fn(Interval) -> f64| {
        LevelColumn::new(heading, "", about, move |row| {
            let run = &row.level.run;
            Cell::number(run.energy_rate.map(end), scientific).or_failed(run.failure.as_ref())
        })
    };
    [
        column("rate", "rate of the energy, d ln E/dt (1/s)", |rate| rate.value),
        column("low", "lower end of its 95 % interval (1/s)", |rate| rate.low),
        column("high (95 %)", "upper end of its 95 % interval (1/s)", |rate| rate.high),
    ]
}

pub(crate) fn json_columns<'a>() -> Vec<LevelColumn<'a>> {
    let mut columns = vec![cells(), dt(), ppc(), judged(), order(), spread()];
    columns.extend(norms());
    columns.extend(counters());
    columns.extend([
        LevelColumn::json(
            "spacing",
            "spacing that is refined: of cells (m), time (s) or particles (m)",
            |row| number(row.level.spacing),
        ),
        LevelColumn::json("counts", "whether the level counts for the verdict", LevelRow::counts),
        LevelColumn::json(
            "excluded_by",
            "reason for which the level does not count for the order: `crossings`, `rounding` or \
             `spread`",
            |row| row.level.exclusion().filter(|_| !row.counts()).map(Exclusion::name),
        ),
        LevelColumn::json(
            "rounding_bound",
            "bound of the rounding error in the judged norm, before the division by the scale of the \
             suite, in single precision and with `run --gate`",
            |row| row.level.rounding_bound.map(number),
        ),
        LevelColumn::json("h", "cell size (m)", |row| number(row.level.h)),
        LevelColumn::json("drift", "relative change of each conserved sum over the run", |row| {
            let columns: Vec<_> = Conserved::ALL.iter().map(|sum| drift(*sum)).collect();
            row.level.run.drift.map(|_| json_object(&columns, row))
        }),
        LevelColumn::json(
            "energy_rate",
            "rate of the energy, d ln E/dt (1/s), and both ends of its 95 % interval",
            |row| {
                let cells = || energy_rate().map(|column| column.cell(row).json);
                row.level.run.energy_rate.map(|_| cells().to_vec())
            },
        ),
        LevelColumn::json("failure", "reason and time of the failure", |row| {
            row.level.run.failure.clone()
        }),
    ]);
    columns
}

impl LevelRow<'_> {
    /// Returns the cell of an error: a dash without an exact or reference solution.
    fn error(&self, error: f64) -> Cell {
        let error = self.study.compared.then_some(error);
        Cell::number(error, scientific).or_failed(self.level.run.failure.as_ref())
    }

    /// Returns the largest error at the end: that of the judged quantity if it is a primary
    /// unknown, otherwise that of the displacement.
    fn linf(&self) -> f64 {
        let run = &self.level.run;
        let errors =
            if self.study.of.is_primary() { &run.errors } else { run.errors_of_displacement() };
        errors.at_end.linf
    }

    /// Formats a value with one digit; a dash without a value, `failed` if the level failed.
    fn unless_failed(&self, figure: Option<f64>) -> Cell {
        let cell = Cell::number(figure, |value| format!("{value:.0e}"));
        cell.or_failed(figure.and(self.level.run.failure.as_ref()))
    }

    /// Whether the level counts for the verdict.
    pub(crate) fn counts(&self) -> bool {
        let window = self.study.judgement.window.as_deref().unwrap_or_default();
        let is_in_window = self.level.exclusion().is_none() && window.contains(&self.index);
        self.level.usable && (is_in_window || self.study.bounded)
    }
}

/// Returns the finest level that counts, or else the finest one; `None` without a judged error.
pub(crate) fn finest_counted(case: &CaseOutcome) -> Option<&LevelOutcome> {
    let study = case.convergence().filter(|study| study.compared)?;
    let counted = rows(study).filter(LevelRow::counts).last();
    counted.map(|row| row.level).or(study.levels.last())
}
