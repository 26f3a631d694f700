//! Columns of a spectrum study.

use super::{Cell, TableColumn, decimals};
use crate::verify::{SpectrumRow, WaveFigures};

type WaveColumn<'a> = TableColumn<'a, SpectrumRow>;

fn figure<'a>(
    heading: &'static str,
    key: &'static str,
    about: &'static str,
    format: fn(f64) -> String,
    value: fn(&SpectrumRow) -> Option<f64>,
) -> WaveColumn<'a> {
    WaveColumn::new(heading, key, about, move |row| Cell::number(value(row), format))
}

fn percent(value: f64) -> String {
    format!("{:.4} %", 100.0 * value + 0.0)
}

fn six_decimals(value: f64) -> String {
    decimals(6)(value)
}

fn phase_error(figures: Option<&WaveFigures>) -> Option<f64> {
    figures.and_then(|figures| figures.phase_error)
}

fn measured(row: &SpectrumRow) -> Option<&WaveFigures> {
    row.measured.as_ref().ok()
}

fn cells<'a>() -> WaveColumn<'a> {
    figure(
        "cells per wavelength",
        "cells",
        "cells per wavelength",
        |value| value.to_string(),
        |row| Some(row.cells),
    )
}

fn courant<'a>() -> WaveColumn<'a> {
    figure(
        "C",
        "courant",
        "Courant number c dt/h",
        |value| value.to_string(),
        |row| Some(row.courant),
    )
}

pub(crate) fn waves<'a>() -> Vec<WaveColumn<'a>> {
    vec![
        cells(),
        courant(),
        WaveColumn::new("steps", "steps", "steps of the run", |row| Cell::plain(row.steps)),
        figure(
            "phase error",
            "phase_error",
            "measured relative error of the phase speed",
            percent,
            |row| phase_error(measured(row)),
        ),
        figure(
            "predicted phase error",
            "predicted_phase_error",
            "relative error of the phase speed, from the closed form",
            percent,
            |row| phase_error(row.predicted.as_ref()),
        ),
        figure(
            "amplitude",
            "amplitude",
            "measured factor of the amplitude in one exact period",
            six_decimals,
            |row| measured(row).map(WaveFigures::kept),
        ),
        figure(
            "predicted amplitude",
            "predicted_amplitude",
            "factor of the amplitude in one exact period, from the closed form",
            six_decimals,
            |row| row.predicted.as_ref().map(WaveFigures::kept),
        ),
    ]
}

/// Returns the columns of closed-form values for each Courant number, which no run checks.
pub(crate) fn curves<'a>() -> Vec<WaveColumn<'a>> {
    vec![
        courant(),
        figure(
            "cells per wavelength for a phase error of 1 %",
            "cells_for_one_percent",
            "cells per wavelength above which the predicted phase error is below 1 %",
            |value| format!("{value:.2}"),
            |row| row.cells_for_one_percent,
        ),
        figure(
            "stability limit of C",
            "limit",
            "predicted stability limit of the Courant number",
            |value| format!("{value:.4}"),
            |row| row.limit,
        ),
    ]
}

pub(crate) fn json_columns<'a>() -> Vec<WaveColumn<'a>> {
    let mut columns = waves();
    columns.extend(curves().into_iter().skip(1));
    columns.push(WaveColumn::json("failure", "reason why nothing is measured", |row| {
        row.measured.as_ref().err().cloned()
    }));
    columns
}
