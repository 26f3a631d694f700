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
