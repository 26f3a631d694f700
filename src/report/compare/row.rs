//! The cells of a row, the same in text and in Markdown.

use super::moved::{CheapestMove, ErrorMove, Moved, Rank};

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

/// Heads of the columns for [`target`].
pub(super) const TARGET_HEADS: [&str; 5] = ["suite", "error", "times", "work", "cheapest"];

/// A target error and what it takes.
pub(super) fn target(moved: &CheapestMove) -> [String; 5] {
    let of = |found: &Option<(f64, String)>| found.clone().unzip();
    let ((old, old_case), (new, new_case)) = (of(&moved.old), of(&moved.new));
    let both = |old: Option<String>, new: Option<String>| match (old, new) {
        (old, new) if old == new => old.unwrap_or_else(dash),
        (old, new) => {
            [old, new].map(|side| side.unwrap_or_else(|| "not reached".to_owned())).join(" -> ")
        }
    };
    let work = |work: Option<f64>| work.map(|work| format!("{work:.3e}"));
    let reached = old.is_some() && new.is_some();
    [
        moved.place.clone(),
        format!("{:.0e}", moved.target),
        if reached { times(moved.ratio()) } else { dash() },
        both(work(old), work(new)),
        both(old_case, new_case),
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

/// A ratio: `1.80 x`, and `1.004 x` where it is close to one.
fn times(ratio: f64) -> String {
    match ratio {
        r if !r.is_finite() => "-".to_owned(),
        r if (0.95..1.05).contains(&r) => format!("{r:.3} x"),
        r if (0.01..100.0).contains(&r) => format!("{r:.2} x"),
        r => format!("{r:.1e} x"),
    }
}
