//! A comparison as aligned text.

use super::{
    moved::{Comparison, Rank},
    row::{HEADS, TARGET_HEADS, cells, notes, target},
};
use crate::report::text::table::Table;

/// A line that says what happened, then a table for each rank.
pub fn text(comparison: &Comparison) -> String {
    let head = if comparison.is_worse() { "worse" } else { "nothing worse" };
    let mut lines = vec![format!("{head}: {}", comparison.headline())];
    for rank in Rank::ALL {
        let mut table = Table::new(&HEADS);
        let mut below = Vec::new();
        for moved in comparison.of(rank) {
            let row = cells(moved).map(|cell| printable(&cell));
            below.extend(
                notes(moved).iter().map(|note| format!("    {}: {}", row[0], printable(note))),
            );
            table.row(row.to_vec());
        }
        if comparison.count(rank) == 0 {
            continue;
        }
        lines.extend([String::new(), rank.words().to_owned()]);
        lines.extend(table.without_empty_columns().flush_left(&[0, 1]).lines());
        lines.extend(below);
    }
    if !comparison.cheapest.is_empty() {
        let mut table = Table::new(&TARGET_HEADS);
        for moved in &comparison.cheapest {
            table.row(target(moved).map(|cell| printable(&cell)).to_vec());
        }
        lines.extend([String::new(), "cheapest for an error".to_owned()]);
        lines.extend(table.flush_left(&[0, 4]).lines());
    }
    let share = comparison.tolerance;
    lines.extend([String::new(), format!("Figures count as equal within a share of {share}.")]);
    lines.join("\n") + "\n"
}

/// Names come from a file: none of their characters may steer a terminal.
fn printable(text: &str) -> String {
    let safe = |c: char| if c.is_control() { '\u{fffd}' } else { c };
    text.chars().map(safe).collect()
}
