//! A diagnosis in words: the cause, the evidence, and what restores the order.

use super::prose::{paragraph_lines, row};
use super::table::Table;
use crate::report::columns::TableColumn;

use crate::verify::{ChangedRun, Diagnosis, Evidence, Interval, Verdict};

/// The finding on one case: a paragraph, and a table of the runs behind it.
pub fn diagnosis(found: &Diagnosis) -> String {
    let mut lines = vec![format!("== {} ==", found.case)];
    paragraph_lines(&mut lines, &paragraph(found));
    if !found.runs.is_empty() {
        lines.push(String::new());
        lines.extend(Table::new(&columns(), found.runs.iter()).lines());
    }
    if !found.skipped.is_empty() {
        row(&mut lines, "beyond the budget", &found.skipped.join("; "));
    }
    lines.join("\n") + "\n"
}

/// Verdict, cause, evidence and remedy.
pub(crate) fn paragraph(found: &Diagnosis) -> String {
    let p = found.formal_order;
    let judgement = &found.judgement;
    if found.is_sound() {
        return format!("As theory says: {}.", judgement.reason);
    }
    let seen = format!("Theory gives the order {p}, and the case is {}", judgement.verdict);
    let seen = format!("{seen}: {}.", judgement.reason);
    if found.left_grid {
        return format!(
            "{seen} Cause: the grid ends where the body moves to. What restores it: a larger `grid` in \
             `scene`, or a smaller motion."
        );
    }
    let levels = match (found.levels.first(), found.levels.last()) {
        (Some(first), Some(last)) => format!("{first} to {last}"),
        _ => String::new(),
    };
    let order = |order: Option<Interval>| order.map_or("none".to_owned(), |order| order.shown());
    let of_case = order(found.finest.order);
    let kink = found.kink.map_or(String::new(), |function| {
        format!(
            " The exact solution calls `{function}`: where it has a kink, the order of theory, which \
             is that of a smooth solution, is not to be had."
        )
    });
    let Some((run, evidence)) = found.found() else {
        return if found.finest.verdict == Verdict::Converging {
            format!(
                "{seen} From {levels} the order is {of_case}: coarser levels are not asymptotic, or \
                 are too few to tell."
            )
        } else {
            format!(
                "{seen} No change of one thing brings the order back on the levels from {levels}, or \
                 takes a quarter off the finest error: the cause is not among those that are \
                 tried.{kink}"
            )
        };
    };
    let ChangedRun { change, cause, remedy, order: with, ratio, .. } = run;
    let (with, ratio) = (order(*with), times(*ratio));
    match evidence {
        Evidence::Restored => format!(
            "{seen} Cause: {cause}. With {change} the order from {levels} is {with}, where it was \
             {of_case}; the finest error is {ratio}. What restores it: {remedy}."
        ),
        Evidence::Raised => format!(
            "{seen} Cause: {cause}. With {change} the order from {levels} is {with}, where it was \
             {of_case}, which is not yet that of theory.{kink} What helps: {remedy}."
        ),
        Evidence::Lowered => format!(
            "{seen} Largest part: {cause}. With {change} the finest error is {ratio}; the order \
             from {levels} is {with} then, so that this is not all.{kink} What \
             helps: {remedy}."
        ),
    }
}

/// A ratio to what was before.
fn times(ratio: f64) -> String {
    if !ratio.is_finite() {
        "a number, which it was not".to_owned()
    } else if ratio < 1e-4 {
        format!("{ratio:.0e} of that")
    } else if ratio < 0.1 {
        format!("1/{:.0} of that", 1.0 / ratio)
    } else {
        format!("{ratio:.2} times that")
    }
}

fn columns<'a>() -> [TableColumn<'a, &'a ChangedRun>; 4] {
    [
        TableColumn::<&ChangedRun>::text("changed", "the one thing", |run| run.change.clone())
            .flush_left(),
        TableColumn::<&ChangedRun>::text("verdict", "verdict", |run| run.verdict.to_string())
            .flush_left(),
        TableColumn::<&ChangedRun>::text("order", "observed order", |run| {
            run.order.map(|order| order.shown())
        }),
        TableColumn::<&ChangedRun>::text("error/before", "finest error over that before", |run| {
            let is_large = run.ratio >= 1e4;
            if is_large { format!("{:.1e}", run.ratio) } else { format!("{:.3}", run.ratio) }
        }),
    ]
}
