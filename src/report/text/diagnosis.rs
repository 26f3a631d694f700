//! A diagnosis in words: the cause, the evidence, and what restores the order.

use super::prose::{paragraph_lines, row};
use super::table::Table;
use crate::report::columns::TableColumn;
use crate::study::{Diagnosis, Trial};
use crate::verify::{Interval, Verdict};

/// The finding on one case: a paragraph, and a table of the runs behind it.
pub fn diagnosis(found: &Diagnosis) -> String {
    let mut lines = vec![format!("== {} ==", found.case)];
    paragraph_lines(&mut lines, &paragraph(found));
    if !found.trials.is_empty() {
        lines.push(String::new());
        lines.extend(Table::new(&columns(), found.trials.iter()).lines());
    }
    if !found.skipped.is_empty() {
        row(&mut lines, "beyond the budget", &found.skipped.join("; "));
    }
    lines.join("\n") + "\n"
}

fn paragraph(found: &Diagnosis) -> String {
    let p = found.formal_order;
    let judgement = &found.judgement;
    if found.is_sound() {
        return format!("As theory says: {}.", judgement.reason);
    }
    let seen = format!("Theory gives the order {p}, and the case is {}", judgement.verdict);
    let seen = format!("{seen}: {}.", judgement.reason);
    let levels = match (found.levels.first(), found.levels.last()) {
        (Some(first), Some(last)) => format!("{first} to {last}"),
        _ => String::new(),
    };
    let order = |order: Option<Interval>| order.map_or("none".to_owned(), shown);
    let of_case = order(found.finest.order);
    match found.found() {
        None if found.finest.verdict == Verdict::Converging => format!(
            "{seen} From {levels} the order is {of_case}: coarser levels are not asymptotic, or are \
             too few to tell."
        ),
        None => format!(
            "{seen} No change of one thing restores the order on the levels from {levels} or takes a \
             quarter off the finest error: the cause is not among those that are tried."
        ),
        Some((Trial { change, cause, remedy, order: with, ratio, .. }, true)) => format!(
            "{seen} Cause: {cause}. With {change} the order from {levels} is {}, where it was \
             {of_case}, and the finest error {ratio:.2} times as large. What restores it: {remedy}.",
            order(*with)
        ),
        Some((Trial { change, cause, remedy, order: with, ratio, .. }, false)) => format!(
            "{seen} Largest part: {cause}. With {change} the finest error is {ratio:.2} times as \
             large; the order from {levels} is {} then, so that this is not all. What helps: \
             {remedy}.",
            order(*with)
        ),
    }
}

fn shown(order: Interval) -> String {
    format!("{:.2} [{:.2}, {:.2}]", order.value, order.low, order.high)
}

fn columns<'a>() -> [TableColumn<'a, &'a Trial>; 4] {
    [
        TableColumn::<&Trial>::text("changed", "the one thing", |trial| trial.change.clone())
            .flush_left(),
        TableColumn::<&Trial>::text("verdict", "verdict", |trial| trial.verdict.to_string())
            .flush_left(),
        TableColumn::<&Trial>::text("order", "observed order", |trial| trial.order.map(shown)),
        TableColumn::<&Trial>::text("error/before", "finest error over that before", |trial| {
            format!("{:.3}", trial.ratio)
        }),
    ]
}
