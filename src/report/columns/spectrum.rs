//! Columns of a spectrum study.

use super::{TableColumn, decimals};
use crate::verify::{SpectrumRow, WaveFigures};

type WaveColumn<'a> = TableColumn<'a, SpectrumRow>;

fn percent(value: f64) -> String {
    format!("{:.4} %", 100.0 * value + 0.0)
}

fn phase_error(figures: Option<&WaveFigures>) -> Option<f64> {
    figures.and_then(|figures| figures.phase_error)
}

fn measured(row: &SpectrumRow) -> Option<&WaveFigures> {
    row.measured.as_ref().ok()
}

fn courant<'a>() -> WaveColumn<'a> {
    WaveColumn::number(
        "C",
        "courant",
        "Courant number c dt/h",
        |c| c.to_string(),
        |row| row.courant,
    )
}

pub(crate) fn waves<'a>() -> Vec<WaveColumn<'a>> {
    let cells = "cells per wavelength";
    let phase = "measured relative error of the phase speed";
    let predicted_phase = "relative error of the phase speed, from the closed form";
    let amplitude = "measured factor of the amplitude in one exact period";
    let predicted_amplitude = "factor of the amplitude in one exact period, from the closed form";
    vec![
        WaveColumn::number(cells, "cells", cells, |value| value.to_string(), |row| row.cells),
        courant(),
        WaveColumn::plain("steps", "steps", "steps of the run", |row| row.steps),
        WaveColumn::number("phase error", "phase_error", phase, percent, |row| {
            phase_error(measured(row))
        }),
        WaveColumn::number(
            "predicted phase error",
            "predicted_phase_error",
            predicted_phase,
            percent,
            |row| phase_error(row.predicted.as_ref()),
        ),
        WaveColumn::number("amplitude", "amplitude", amplitude, decimals(6), |row| {
            measured(row).map(WaveFigures::kept)
        }),
        WaveColumn::number(
            "predicted amplitude",
            "predicted_amplitude",
            predicted_amplitude,
            decimals(6),
            |row| row.predicted.as_ref().map(WaveFigures::kept),
        ),
    ]
}

/// Returns the columns of closed-form values for each Courant number, which no run checks.
pub(crate) fn curves<'a>() -> Vec<WaveColumn<'a>> {
    let limit = "predicted stability limit of the Courant number";
    vec![
        courant(),
        WaveColumn::number(
            "cells per wavelength for a phase error of 1 %",
            "cells_for_one_percent",
            "cells per wavelength above which the predicted phase error is below 1 %",
            decimals(2),
            |row| row.cells_for_one_percent,
        ),
        WaveColumn::number("stability limit of C", "limit", limit, decimals(4), |row| row.limit),
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
