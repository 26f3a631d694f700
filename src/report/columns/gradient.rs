//! Columns of a gradient study.

use super::{TableColumn, decimals, number, scientific};
use crate::verify::{GradientLevel, GradientStudy, Perturbed, SweepPoint};
use serde_json::{Value, json};

/// One level, with the order relative to the previous level.
pub(crate) type GradientLevelRow = (GradientLevel, Option<f64>);

/// A perturbation, the Taylor remainder with its order, and the central difference.
pub(crate) struct TaylorRow {
    perturbed: Perturbed,
    remainder: f64,
    order: Option<f64>,
    difference: f64,
}

pub(crate) fn level_rows(study: &GradientStudy) -> Vec<GradientLevelRow> {
    let orders = std::iter::once(None).chain(study.pairwise_orders().into_iter().map(Some));
    study.levels.iter().copied().zip(orders).collect()
}

pub(crate) fn taylor_rows(study: &GradientStudy) -> Vec<TaylorRow> {
    let taylor = &study.taylor;
    let orders = std::iter::once(None).chain(taylor.orders());
    let all = taylor.perturbed.iter().zip(taylor.remainders()).zip(orders);
    let row = |(((perturbed, remainder), order), difference): (_, f64)| {
        let perturbed: &Perturbed = perturbed;
        TaylorRow { perturbed: *perturbed, remainder, order, difference }
    };
    all.zip(taylor.differences()).map(row).collect()
}

pub(crate) fn levels<'a>() -> Vec<TableColumn<'a, GradientLevelRow>> {
    type GradientLevelColumn<'a> = TableColumn<'a, GradientLevelRow>;
    let of = |key, about, value: fn(&GradientLevel) -> f64| {
        GradientLevelColumn::number(key, key, about, scientific, move |(level, _)| value(level))
    };
    let order = "order from the level before";
    vec![
        GradientLevelColumn::plain("cells", "cells", "cells along the first axis", |(level, _)| {
            level.cells
        }),
        of("dt", "time step (s)", |level| level.dt),
        of("gradient", "derivative that the solver reports", |level| level.gradient),
        of("exact", "exact derivative", |level| level.exact),
        of("error", "magnitude of the error of the derivative", GradientLevel::error),
        GradientLevelColumn::number("order", "order", order, decimals(2), |(_, order)| *order),
    ]
}

pub(crate) fn taylor<'a>() -> Vec<TableColumn<'a, TaylorRow>> {
    type TaylorColumn<'a> = TableColumn<'a, TaylorRow>;
    let of = |key, about, value: fn(&TaylorRow) -> f64| {
        TaylorColumn::number(key, key, about, scientific, value)
    };
    let order = "order of the remainder in e";
    vec![
        TaylorColumn::plain("k", "level", "the perturbation is the parameter times 2^-k", |row| {
            u64::from(row.perturbed.level)
        }),
        of("remainder", "|J(q + e) - J(q) - e g|", |row| row.remainder),
        TaylorColumn::number("order", "order", order, decimals(2), |row| row.order),
        of("difference", "(J(q + e) - J(q - e))/(2 e)", |row| row.difference),
    ]
}

pub(crate) fn points<'a>() -> Vec<TableColumn<'a, SweepPoint>> {
    type SweepColumn<'a> = TableColumn<'a, SweepPoint>;
    vec![
        SweepColumn::json("parameter", "value of the parameter", |point| number(point.at)),
        SweepColumn::json("value", "value of the functional", |point| number(point.value)),
        SweepColumn::json("gradient", "derivative that the solver reports", |p| number(p.gradient)),
    ]
}

pub(crate) fn sweep(study: &GradientStudy) -> Option<Value> {
    let sweep = study.sweep.as_ref()?;
    let jumps: Vec<Value> = sweep.jumps.iter().map(|jump| number(*jump)).collect();
    Some(json!({"change": number(sweep.change), "share": number(sweep.share), "jumps": jumps}))
}

#[cfg(test)]
mod tests {
    use super::super::json_objects;
    use super::*;
    use crate::verify::{Sweep, Taylor, ValueCheck};

    fn texts<R>(columns: &[TableColumn<'_, R>], rows: &[R]) -> Vec<String> {
        let row = |row| columns.iter().map(|one| one.cell(row).text).collect::<Vec<_>>().join(" ");
        rows.iter().map(row).collect()
    }

    /// The remainders are |2.5 - 1 - 1| and |1.625 - 1 - 0.5|, and the integral of the sweep is 10.
    #[test]
    fn tables_of_a_gradient_by_hand() {
        let level =
            |(cells, h, dt, gradient, exact)| GradientLevel { cells, h, dt, gradient, exact };
        let at = |(level, by, above, below)| Perturbed { level, by, above, below };
        let point = |(at, value, gradient)| SweepPoint { at, value, gradient };
        let points = [(1.0, 7.0, 4.0), (3.0, 15.0, 6.0)].map(point);
        let study = GradientStudy {
            functional: "kinetic_energy",
            parameter: "young",
            single_precision: false,
            value: ValueCheck { reported: 1.0, computed: 1.0, tolerance: 0.0 },
            taylor: Taylor {
                value: 1.0,
                gradient: 2.0,
                rounding: 1e-15,
                perturbed: [(4, 0.5, 2.5, 0.25), (5, 0.25, 1.625, 0.75)].map(at).into(),
            },
            levels: [(4, 1.0, 0.5, 5.0, 1.0), (8, 0.5, 0.01, -2.0, -3.0)].map(level).into(),
            sweep: Sweep::new(&points, 1e-15),
            points: points.into(),
            evidence: None,
        };
        let (rows, remainders) = (level_rows(&study), taylor_rows(&study));
        assert_eq!(
            texts(&levels(), &rows),
            [
                "4 5.000e-01 5.000e+00 1.000e+00 4.000e+00 -",
                "8 1.000e-02 -2.000e+00 -3.000e+00 1.000e+00 2.00",
            ]
        );
        assert_eq!(
            texts(&taylor(), &remainders),
            ["4 5.000e-01 - 2.250e+00", "5 1.250e-01 2.00 1.750e+00"]
        );
        let second = json!({"cells": 8, "dt": 0.01, "gradient": -2.0, "exact": -3.0, "error": 1.0, "order": 2.0});
        assert_eq!(json_objects(&levels(), rows)[1], second);
        let second = json!({"level": 5, "remainder": 0.125, "order": 2.0, "difference": 1.75});
        assert_eq!(json_objects(&taylor(), &remainders[1..])[0], second);
        let second = json!({"parameter": 3.0, "value": 15.0, "gradient": 6.0});
        assert_eq!(json_objects(&self::points(), study.points.clone())[1], second);
        assert_eq!(sweep(&study), Some(json!({"change": 8.0, "share": 1.25, "jumps": [-0.25]})));
    }
}
