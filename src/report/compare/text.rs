//! A comparison as aligned text.

use super::changes::{Rank, ReportComparison};
use super::row::{cases, notes, targets};
use crate::report::text::table::{Table, printable};

/// A line that says what happened, then a table for each rank.
pub fn text(comparison: &ReportComparison) -> String {
    let head = if comparison.is_worse() { "worse" } else { "nothing worse" };
    let mut lines = vec![format!("{head}: {}", comparison.headline())];
    lines.extend(comparison.in_common().map(|line| printable(&line)));
    if !comparison.problems.is_empty() {
        lines.extend([
            String::new(),
            "another problem, so that figures are not compared".to_owned(),
        ]);
    }
    for problem in &comparison.problems {
        let line = |[key, old, new]: &[String; 3]| {
            printable(&format!("  {}: {key} {old} -> {new}", problem.suite))
        };
        lines.extend(problem.rows.iter().map(line));
    }
    for rank in Rank::ALL {
        let table = Table::new(&cases(), comparison.of(rank));
        if table.is_empty() {
            continue;
        }
        lines.extend([String::new(), rank.words().to_owned()]);
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
    lines.extend([String::new(), format!("Figures count as equal within a share of {share}.")]);
    lines.join("\n") + "\n"
}
