//! Columns of the levels of a convergence study.

use super::{Cell, TableColumn, decimals, json_object, scientific};
use crate::report::json::number::number;
use crate::verify::{Axis, Conserved, Convergence, History, Interval, LevelOutcome, Norms};
use serde_json::Value;

/// A level of a study.
pub(crate) struct LevelRow<'a> {
    study: &'a Convergence,
    index: usize,
    level: &'a LevelOutcome,
}

type LevelColumn<'a> = TableColumn<'a, LevelRow<'a>>;

/// The levels of a study, coarse to fine.
pub(crate) fn rows(study: &Convergence) -> impl Iterator<Item = LevelRow<'_>> {
    study.levels.iter().enumerate().map(move |(index, level)| LevelRow { study, index, level })
}

/// Cells along the first axis.
pub(crate) fn cells<'a>() -> LevelColumn<'a> {
    LevelColumn::new("cells", "cells", "cells along the first axis", |row| {
        Cell::plain(row.level.cells)
    })
}

fn dt<'a>() -> LevelColumn<'a> {
    LevelColumn::new("dt", "dt", "time step (s)", |row| Cell::number(row.level.dt, scientific))
}

fn ppc<'a>() -> LevelColumn<'a> {
    LevelColumn::new("ppc", "ppc", "particles per cell (MPM)", |row| Cell::plain(row.level.ppc))
}

fn spacing<'a>(heading: &'static str) -> LevelColumn<'a> {
    let about = "spacing that is refined: of cells (m), time (s) or particles (m)";
    LevelColumn::new(heading, "spacing", about, |row| Cell::number(row.level.spacing, scientific))
}

/// The number of cells, or else the spacing that is refined.
fn refined<'a>(axis: Axis) -> Vec<LevelColumn<'a>> {
    match axis {
        Axis::Space => vec![cells(), spacing("h")],
        Axis::Time => vec![spacing("dt")],
        Axis::Particles => vec![ppc(), spacing("spacing")],
    }
}

/// All that makes a level, the refined axis first.
fn setting<'a>(axis: Axis) -> [LevelColumn<'a>; 3] {
    match axis {
        Axis::Space => [cells(), dt(), ppc()],
        Axis::Time => [dt(), cells(), ppc()],
        Axis::Particles => [ppc(), cells(), dt()],
    }
}

/// The refined axis, by which other tables name a level.
pub(crate) fn name<'a>(axis: Axis) -> LevelColumn<'a> {
    let [first, ..] = setting(axis);
    first
}

/// The table of errors.
pub(crate) fn errors<'a>(axis: Axis) -> Vec<LevelColumn<'a>> {
    let mut columns = refined(axis);
    columns.extend(figures());
    columns
}

/// Errors are those of the displacement (m), in text those of the temperature (K) where that is
/// judged.
fn figures<'a>() -> Vec<LevelColumn<'a>> {
    vec![
        LevelColumn::new("rms", "errors.rms", "root of the mean square error", |row| {
            row.norm(|norms| norms.rms)
        }),
        LevelColumn::new("l1", "errors.l1", "weighted mean error", |row| {
            row.norm(|norms| norms.l1)
        }),
        LevelColumn::new("l2", "errors.l2", "root of the weighted mean square error", |row| {
            row.norm(|norms| norms.l2)
        }),
        LevelColumn::new("linf", "errors.linf", "largest error", |row| {
            row.norm(|norms| norms.linf)
        }),
        LevelColumn::new("max rms", "errors.max_rms", "largest rms over the instants", |row| {
            let run = &row.level.run;
            let shown = if row.study.of.is_primary() { run.largest.rms } else { run.max_rms };
            row.error(shown, run.max_rms)
        }),
        LevelColumn::text(
            "velocity",
            "error of the observed velocity over the largest exact one",
            |row| {
                let history = row.level.run.history.as_ref();
                history.and_then(History::relative_error).map(scientific)
            },
        ),
        LevelColumn::new(
            "judged",
            "judged",
            "the judged error, where it is none of these",
            |row| {
                let cell = row.error(row.level.error, row.level.error);
                let shown = row.study.is_judged_by_another_figure();
                if shown { cell } else { Cell::json(cell.json) }
            },
        ),
        LevelColumn::new(
            "order",
            "order",
            "order between the next coarser level and this one",
            |row| Cell::number(row.level.order, decimals(2)),
        ),
        LevelColumn::text("counts", "whether the level counts for the verdict", LevelRow::counts),
    ]
}

/// The table of work, and of what a reader must know beside an error.
pub(crate) fn work<'a>(axis: Axis) -> Vec<LevelColumn<'a>> {
    let mut columns: Vec<LevelColumn<'a>> = setting(axis).into();
    columns.extend(counters());
    columns
}

fn counters<'a>() -> Vec<LevelColumn<'a>> {
    vec![
        LevelColumn::new("particles", "particles", "particles (MPM)", |row| {
            Cell::plain(row.level.run.counters.particles)
        }),
        LevelColumn::new("steps", "steps", "steps taken", |row| Cell::plain(row.level.run.steps)),
        LevelColumn::new("transfers", "transfers", "particle-node pairs of P2G and G2P", |row| {
            Cell::plain(row.level.run.counters.transfers)
        }),
        LevelColumn::new("crossings", "crossings", "changes of cell (MPM)", |row| {
            Cell::plain(row.level.run.counters.crossings)
        }),
        LevelColumn::new(
            "outside",
            "left_domain",
            "particles outside the grid at the end",
            |row| Cell::plain(row.level.run.counters.left_domain),
        ),
        LevelColumn::new(
            "min J",
            "min_j",
            "smallest det F met; a particle that is turned inside out along two axes at once has a positive one",
            |row| {
                let known = Some(row.level.run.counters.min_j).filter(|j| !j.is_nan());
                Cell::number(known, decimals(4))
            },
        ),
        LevelColumn::new(
            "speed/c",
            "residual_speed",
            "of a body that comes to rest: largest speed towards the end over the wave speed",
            |row| row.unless_failed(row.level.run.residual_speed),
        ),
        LevelColumn::new(
            "dt/stable",
            "stable_time_step",
            "time step over the stable one; in JSON the latter (s)",
            |row| {
                let stable = row.level.stable_time_step;
                let ratio = Cell::number(stable.map(|stable| row.level.dt / stable), decimals(3));
                Cell { json: stable.map_or(Value::Null, number), ..ratio }
            },
        ),
    ]
}

/// The relative drift of a conserved sum.
pub(crate) fn drift<'a>(sum: Conserved) -> LevelColumn<'a> {
    let about = "largest relative change of the sum since t = 0";
    LevelColumn::new(sum.words(), sum.name(), about, move |row| {
        row.unless_failed(row.level.run.drift.map(|drift| drift.of(sum)))
    })
}

/// The rate of the energy, d ln E/dt (1/s).
pub(crate) fn energy_rate<'a>() -> [LevelColumn<'a>; 3] {
    let column = |heading: &'static str, about: &'static str, end: fn(Interval) -> f64| {
        LevelColumn::new(heading, "", about, move |row| {
            let run = &row.level.run;
            Cell::number(run.energy_rate.map(end), scientific).or_failed(run.failure.as_ref())
        })
    };
    [
        column("rate", "rate of the energy, d ln E/dt (1/s)", |rate| rate.value),
        column("from", "lower end of its 95 % interval (1/s)", |rate| rate.low),
        column("to (95 %)", "upper end of its 95 % interval (1/s)", |rate| rate.high),
    ]
}

/// All columns with a JSON key.
pub(crate) fn json_columns<'a>() -> Vec<LevelColumn<'a>> {
    let mut columns: Vec<LevelColumn<'a>> = setting(Axis::Space).into();
    columns.push(spacing("h"));
    columns.extend(figures());
    columns.extend(counters());
    columns.extend([
        LevelColumn::json("h", "cell size (m)", |row| number(row.level.h)),
        LevelColumn::json("drift", "relative drift of each conserved sum", |row| {
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
        LevelColumn::json("failure", "why and when the run broke", |row| {
            row.level.run.failure.clone()
        }),
    ]);
    columns
}

impl LevelRow<'_> {
    /// A norm of the errors at the end, in text of the primary unknown of the study.
    fn norm(&self, norm: impl Fn(&Norms) -> f64) -> Cell {
        let run = &self.level.run;
        let shown = if self.study.of.is_primary() { &run.at_end } else { &run.errors };
        self.error(norm(shown), norm(&run.errors))
    }

    /// An error, where there is a truth to compare with.
    fn error(&self, text: f64, json: f64) -> Cell {
        let compared = |value| self.study.compared.then_some(value);
        let cell = Cell::number(compared(text), scientific);
        let json = compared(json).map_or(Value::Null, number);
        Cell { json, ..cell }.or_failed(self.level.run.failure.as_ref())
    }

    /// A figure of which one digit says enough; a dash also on a failed level that has none.
    fn unless_failed(&self, figure: Option<f64>) -> Cell {
        let cell = Cell::number(figure, |value| format!("{value:.0e}"));
        cell.or_failed(figure.and(self.level.run.failure.as_ref()))
    }

    fn counts(&self) -> &'static str {
        let window = self.study.judgement.window.as_deref().unwrap_or_default();
        match (self.level.usable, window.contains(&self.index) || self.study.bounded) {
            (false, _) => "no: crossings",
            (true, true) => "yes",
            (true, false) => "no",
        }
    }
}
