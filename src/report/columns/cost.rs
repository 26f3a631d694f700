//! Columns of the cost tables: work of the methods for target errors.

use super::{Cell, TableColumn, decimals, json_object, number, short};
use crate::verify::{Agreement, End, Exponent, Ranked, Ranking, Reach};

type MethodColumn<'a> = TableColumn<'a, Ranked>;

pub(crate) fn methods(ranking: &Ranking) -> Vec<MethodColumn<'_>> {
    let mut columns = vec![name("method")];
    for (k, target) in ranking.targets.iter().enumerate() {
        columns.extend([
            MethodColumn::text(format!("work for {target:e}"), "work for the error", move |row| {
                reach_text(row.reaches[k])
            }),
            MethodColumn::text("x", "times the least work", move |row| {
                row.times[k].map(|t| if t < 1000.0 { format!("{t:.2}") } else { short(t) })
            }),
        ]);
    }
    let best = "smallest error, relative to the size of the solution";
    let not_reached = "reason why the smallest target error is not reached";
    columns.extend([
        MethodColumn::number("best error", "best", best, short, |row| row.best),
        MethodColumn::plain("not reached", "not_reached", not_reached, |row| {
            row.obstacle().map(End::words)
        }),
        MethodColumn::new(
            "Pareto front",
            "pareto_front",
            "levels for which no level of any method has both a smaller error and less work",
            |row| {
                let (count, all) = (row.front.len(), row.method.samples.len());
                let text = (count > 0).then(|| format!("{count} of {all}"));
                Cell { json: row.front.clone().into(), ..Cell::text(text) }
            },
        ),
    ]);
    columns
}

fn name<'a>(heading: &'static str) -> MethodColumn<'a> {
    MethodColumn::plain(heading, "case", "method", |row| row.method.name.clone()).flush_left()
}

pub(crate) fn exponents<'a>() -> Vec<MethodColumn<'a>> {
    let columns = exponent().map(|column| column.within(|row: &Ranked| row.exponent.as_ref()));
    std::iter::once(name("work ~ error^k")).chain(columns).collect()
}

fn exponent<'a>() -> [TableColumn<'a, Exponent>; 5] {
    type ExponentColumn<'a> = TableColumn<'a, Exponent>;
    let of = |heading, key, about, value: fn(&Exponent) -> f64| {
        ExponentColumn::number(heading, key, about, decimals(2), value)
    };
    let agrees = "whether the exponent agrees with theory, or else the difference";
    [
        of("k", "value", "exponent of work ~ error^k", |e| e.observed.value),
        of("low", "low", "lower end of its interval", |e| e.observed.low),
        of("high (95 %)", "high", "upper end", |e| e.observed.high),
        of("theory", "theory", "exponent in theory", |e| e.theory),
        ExponentColumn::new("", "agrees", agrees, |e| {
            Cell::new(agreement(e), e.agreement() == Agreement::Agrees)
        })
        .flush_left(),
    ]
}

pub(crate) fn json_columns(ranking: &Ranking) -> Vec<MethodColumn<'_>> {
    let mut columns = methods(ranking);
    columns.extend([
        MethodColumn::json("reached", "work for each target", |row| {
            let pairs = row.reaches.iter().zip(&row.times);
            let reached = |(reach, times): (&Reach, &Option<f64>)| {
                reach.work().is_some().then(|| json_object(&reached(), &(*reach, *times)))
            };
            pairs.map(reached).collect::<Vec<_>>()
        }),
        MethodColumn::json("exponent", "exponent of work ~ error^k", |row| {
            row.exponent.as_ref().map(|found| json_object(&exponent(), found))
        }),
    ]);
    columns
}

/// Work and spacing at a target error, and the work over the minimum work of all methods.
type Reached = (Reach, Option<f64>);

fn reached<'a>() -> [TableColumn<'a, Reached>; 3] {
    type ReachedColumn<'a> = TableColumn<'a, Reached>;
    [
        ReachedColumn::json("work", "work for the error", |(reach, _)| reach.work().map(number)),
        ReachedColumn::json("at_most", "whether less work may be enough", |(reach, _)| {
            matches!(reach, Reach::Already { .. })
        }),
        ReachedColumn::json("times", "times the least work", |(_, times)| times.map(number)),
    ]
}

fn agreement(found: &Exponent) -> String {
    match found.agreement() {
        Agreement::Agrees => "agrees".to_owned(),
        Agreement::Order => {
            let (observed, formal) = found.order;
            differing("order", observed, formal)
        }
        Agreement::Growth => {
            let (observed, expected) = found.growth;
            differing("growth of work", observed, expected)
        }
    }
}

/// Formats the observed and the expected number with enough decimals to distinguish them.
fn differing(name: &str, observed: f64, expected: f64) -> String {
    let decimals = if (observed - expected).abs() < 0.015 { 4 } else { 2 };
    format!("{name} {observed:.decimals$}, not {expected:.decimals$}")
}

/// Formats the work. If the coarsest level is already accurate enough, its work is an upper bound.
fn reach_text(reach: Reach) -> String {
    match reach {
        Reach::At { work, .. } => short(work),
        Reach::Already { work, .. } => format!("<={}", short(work)),
        Reach::Never => "-".to_owned(),
    }
}
