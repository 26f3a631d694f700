//! Prints a comparison as aligned text.

use super::changes::{CheapestMove, ErrorMove, Moved, Rank, ReportComparison};
use crate::report::columns::TableColumn;
use crate::report::text::table::{Table, printable};

/// Writes a comparison as aligned text: a summary line, and a table for each kind of change.
pub fn text(comparison: &ReportComparison) -> String {
    let head = if comparison.is_worse() { "worse" } else { "nothing worse" };
    let mut lines = vec![format!("{head}: {}", comparison.headline())];
    if !comparison.problems.is_empty() {
        lines.extend([
            String::new(),
            "changed problem: errors and orders are not compared".to_owned(),
        ]);
    }
    for problem in &comparison.problems {
        let line = |[key, old, new]: &[String; 3]| {
            printable(&format!("  {}: {key} {old} -> {new}", problem.suite))
        };
        lines.extend(problem.rows.iter().map(line));
    }
    for &rank in Rank::ALL {
        let table = Table::new(&cases(), comparison.of(rank));
        if table.is_empty() {
            continue;
        }
        lines.extend([String::new(), rank.name().to_owned()]);
        lines.extend(table.without_empty_columns().lines());
        for moved in comparison.of(rank) {
            let line = |note: &String| printable(&format!("    {}: {note}", moved.name));
            lines.extend(notes(moved).iter().map(line));
        }
    }
    if !comparison.cheapest.is_empty() {
        lines.extend([String::new(), "cheapest for an error".to_owned()]);
        lines.extend(Table::new(&targets(), &comparison.cheapest).lines());
    }
    let share = comparison.tolerance;
    let equality = format!("Values count as equal within a relative difference of {share}.");
    lines.extend([String::new(), equality]);
    lines.join("\n") + "\n"
}

/// Maximum number of printed notes of a case. The other notes are only counted.
const MAX_NOTES: usize = 3;

fn cases<'a>() -> [TableColumn<'a, Moved>; 7] {
    type MovedColumn<'a> = TableColumn<'a, Moved>;
    [
        MovedColumn::text("case", "suite and case", |moved| moved.name.clone()).flush_left(),
        MovedColumn::text("verdict", "verdicts", |moved| change(moved, moved.verdict.clone()))
            .flush_left(),
        MovedColumn::text("order", "observed orders", |moved| {
            change(moved, moved.order.map(|order| order.map(|order| format!("{order:.2}"))))
        }),
        MovedColumn::text("error", "judged errors", |moved| moved.error.as_ref().map(errors)),
        MovedColumn::text("times", "their ratio", |moved| {
            moved.error.as_ref().and_then(ErrorMove::ratio).map(times)
        }),
        MovedColumn::text("at", "level of the errors", |moved| {
            moved.error.as_ref().map(|error| error.level.clone())
        }),
        MovedColumn::text("transfers", "ratio on the same level", |moved| moved.work.map(times)),
    ]
}

fn errors(error: &ErrorMove) -> String {
    let text = |error: Option<f64>| error.map_or("failed".to_owned(), |e| format!("{e:.3e}"));
    format!("{} -> {}", text(error.old), text(error.new))
}

fn targets<'a>() -> [TableColumn<'a, CheapestMove>; 5] {
    type TargetColumn<'a> = TableColumn<'a, CheapestMove>;
    [
        TargetColumn::text("suite", "suite, and its problem", |moved| moved.place.clone())
            .flush_left(),
        TargetColumn::text("error", "target error", |moved| format!("{:.0e}", moved.target)),
        TargetColumn::text("times", "ratio of the work", |moved| {
            moved.old.as_ref().zip(moved.new.as_ref()).map(|_| times(moved.ratio()))
        }),
        TargetColumn::text("work", "least work", |moved| {
            both(moved, |(work, _)| format!("{work:.3e}"))
        }),
        TargetColumn::text("cheapest", "method", |moved| both(moved, |(_, case)| case.clone()))
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

fn notes(moved: &Moved) -> Vec<String> {
    let mut notes: Vec<String> = moved.notes.iter().take(MAX_NOTES).cloned().collect();
    if let more @ 1.. = moved.notes.len().saturating_sub(MAX_NOTES) {
        notes.push(format!("and {more} more"));
    }
    notes
}

/// Formats a change as `old -> new`, or one value if it did not change or is in one run only.
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

/// Formats a ratio: `1.80 x`, or `1.004 x` if the ratio is close to one.
fn times(ratio: f64) -> String {
    match ratio {
        r if !r.is_finite() => "-".to_owned(),
        r if (0.95..1.05).contains(&r) => format!("{r:.3} x"),
        r if (0.01..100.0).contains(&r) => format!("{r:.2} x"),
        r => format!("{r:.1e} x"),
    }
}
