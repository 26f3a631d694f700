//! Columns of a comparison, the same in text and in Markdown.

use super::changes::{CheapestMove, ErrorMove, Moved, Rank};
use crate::report::columns::TableColumn;

/// Notes of a case that are shown; the others are counted.
const MOST_NOTES: usize = 3;

/// Changes of a case; dashes where nothing moved or nothing is known.
pub(super) fn cases<'a>() -> [TableColumn<'a, Moved>; 8] {
    [
        TableColumn::<Moved>::text("case", "suite and case", |moved| moved.name.clone())
            .flush_left(),
        TableColumn::<Moved>::text("verdict", "verdicts", |moved| {
            change(moved, moved.verdict.clone())
        })
        .flush_left(),
        TableColumn::<Moved>::text("order", "observed orders", |moved| {
            change(moved, moved.order.map(|order| order.map(|order| format!("{order:.2}"))))
        }),
        TableColumn::<Moved>::text("error", "judged errors", |moved| {
            moved.error.as_ref().map(errors)
        }),
        TableColumn::<Moved>::text("times", "their ratio", |moved| {
            moved.error.as_ref().and_then(ErrorMove::ratio).map(times)
        }),
        TableColumn::<Moved>::text("at", "level of the errors", |moved| {
            moved.error.as_ref().map(|error| error.level.clone())
        }),
        TableColumn::<Moved>::text("transfers", "ratio on the same level", |moved| {
            moved.work.map(times)
        }),
        TableColumn::<Moved>::text("for the same error", "ratio of transfers", |moved| {
            moved.equal.map(|e| format!("{} at {:.0e}", times(e.ratio), e.target))
        }),
    ]
}

fn errors(error: &ErrorMove) -> String {
    let text = |error: Option<f64>| error.map_or("failed".to_owned(), |e| format!("{e:.3e}"));
    format!("{} -> {}", text(error.old), text(error.new))
}

/// Least work for a target error.
pub(super) fn targets<'a>() -> [TableColumn<'a, CheapestMove>; 5] {
    [
        TableColumn::<CheapestMove>::text("suite", "suite, and its problem", |moved| {
            moved.place.clone()
        })
        .flush_left(),
        TableColumn::<CheapestMove>::text("error", "target error", |moved| {
            format!("{:.0e}", moved.target)
        }),
        TableColumn::<CheapestMove>::text("times", "ratio of the work", |moved| {
            moved.old.as_ref().zip(moved.new.as_ref()).map(|_| times(moved.ratio()))
        }),
        TableColumn::<CheapestMove>::text("work", "least work", |moved| {
            both(moved, |(work, _)| format!("{work:.3e}"))
        }),
        TableColumn::<CheapestMove>::text("cheapest", "method", |moved| {
            both(moved, |(_, case)| case.clone())
        })
        .flush_left(),
    ]
}

fn both(moved: &CheapestMove, part: impl Fn(&(f64, String)) -> String) -> String {
    let [old, new] = [&moved.old, &moved.new].map(|side| side.as_ref().map(&part));
    if old == new {
        return old.unwrap_or_else(dash);
    }
    [old, new].map(|side| side.unwrap_or_else(|| "not reached".to_owned())).join(" -> ")
}

/// The first notes of a case.
pub(super) fn notes(moved: &Moved) -> Vec<String> {
    let mut notes: Vec<String> = moved.notes.iter().take(MOST_NOTES).cloned().collect();
    if let more @ 1.. = moved.notes.len().saturating_sub(MOST_NOTES) {
        notes.push(format!("and {more} more"));
    }
    notes
}

/// `old -> new`, or what both are; for a case of one run only, what that has.
fn change(moved: &Moved, [old, new]: [Option<String>; 2]) -> String {
    match (moved.rank, old, new) {
        (Rank::New, _, only) | (Rank::Gone, only, _) => only.unwrap_or_else(dash),
        (_, old, new) if old == new => old.unwrap_or_else(dash),
        (_, old, new) => {
            format!("{} -> {}", old.unwrap_or_else(dash), new.unwrap_or_else(dash))
        }
    }
}

fn dash() -> String {
    "-".to_owned()
}

/// A ratio: `1.80 x`, and `1.004 x` where it is close to one.
fn times(ratio: f64) -> String {
    match ratio {
        r if !r.is_finite() => "-".to_owned(),
        r if (0.95..1.05).contains(&r) => format!("{r:.3} x"),
        r if (0.01..100.0).contains(&r) => format!("{r:.2} x"),
        r => format!("{r:.1e} x"),
    }
}
