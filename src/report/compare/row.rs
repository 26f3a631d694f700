//! The cells of a row, the same in text and in Markdown.

use super::moved::{ErrorMove, Moved, Rank};

/// Heads of the columns.
pub(super) const HEADS: [&str; 8] =
    ["case", "verdict", "order", "error", "times", "at", "transfers", "for the same error"];

/// Notes of a case that are shown; the others are counted.
const MOST_NOTES: usize = 3;

/// What stands under [`HEADS`]; a dash where nothing moved or nothing is known.
pub(super) fn cells(moved: &Moved) -> [String; 8] {
    let order = moved.order.map(|order| order.map(|order| format!("{order:.2}")));
    let error = moved.error.as_ref().map(|error| {
        let shown = |error: Option<f64>| error.map_or("failed".to_owned(), |e| format!("{e:.3e}"));
        format!("{} -> {}", shown(error.old), shown(error.new))
    });
    [
        moved.name.clone(),
        change(moved, moved.verdict.clone()),
        change(moved, order),
        error.unwrap_or_else(dash),
        moved.error.as_ref().and_then(ErrorMove::ratio).map_or_else(dash, times),
        moved.error.as_ref().map_or_else(dash, |error| error.level.clone()),
        moved.work.map_or_else(dash, times),
        moved.equal.map_or_else(dash, |e| format!("{} at {:.0e}", times(e.ratio), e.target)),
    ]
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

/// A ratio: `1.80 x`.
fn times(ratio: f64) -> String {
    match ratio {
        r if !r.is_finite() => "-".to_owned(),
        r if (0.01..100.0).contains(&r) => format!("{r:.2} x"),
        r => format!("{r:.1e} x"),
    }
}
