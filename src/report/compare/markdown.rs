//! A comparison as Markdown, for a comment on a pull request.
//!
//! One line says what happened; what got worse is open to the eye, the rest is folded. Every text
//! comes from a file and is escaped: it can be no markup, mention nobody and end no table.

use super::changes::{CheapestMove, Moved, Rank, ReportComparison};
use super::escape::{code, prose};
use super::row::{cases, notes, targets};
use crate::report::columns::TableColumn;

/// Most rows of a table: a comment may have 65536 characters.
const MOST_ROWS: usize = 40;

/// The comment.
pub fn markdown(comparison: &ReportComparison) -> String {
    let head = if comparison.is_worse() { "Worse" } else { "Nothing worse" };
    let mut page = format!("**mpm-verify: {head}**: {}\n", comparison.headline());
    if let Some(line) = comparison.in_common() {
        page += &format!("\n{}\n", prose(&line));
    }
    if !comparison.problems.is_empty() {
        page += "\n**Another problem, so that figures are not compared**\n\n";
    }
    for problem in &comparison.problems {
        for [key, old, new] in &problem.rows {
            let change = prose(&format!("{key} {old} -> {new}"));
            page += &format!("- {}: {change}\n", code(&problem.suite));
        }
    }
    for rank in Rank::ALL {
        let moved: Vec<&Moved> = comparison.of(rank).collect();
        if moved.is_empty() {
            continue;
        }
        let (count, words) = (moved.len(), rank.words());
        let table = changes(&moved);
        page += &if rank.is_worse() {
            format!("\n**{count} {words}**\n\n{table}")
        } else {
            format!("\n<details><summary>{count} {words}</summary>\n\n{table}\n</details>\n")
        };
    }
    page += &cheapest(comparison);
    let share = comparison.tolerance;
    page + &format!(
        "\n<sub>Figures count as equal within a share of {share}. Transfers between particles and nodes are the measure of work.</sub>\n"
    )
}

/// Cases that moved; columns with nothing but dashes are left out.
fn changes(moved: &[&Moved]) -> String {
    let mut columns: Vec<_> = cases().into();
    let joined = |moved: &Moved| Some(notes(moved).join("; ")).filter(|notes| !notes.is_empty());
    columns.push(TableColumn::text("notes", "notes", joined).flush_left());
    let is_kept = |column: &TableColumn<'_, Moved>| {
        moved.iter().take(MOST_ROWS).any(|moved| column.cell(moved).text != "-")
    };
    columns.retain(is_kept);
    table(&columns, moved)
}

/// Least work for target errors: open if one takes more.
fn cheapest(comparison: &ReportComparison) -> String {
    let moved: Vec<&CheapestMove> = comparison.cheapest.iter().collect();
    let Some(first) = moved.first() else { return String::new() };
    let (words, table) = ("Cheapest for an error", table(&targets(), &moved));
    if first.ratio() < 1.0 {
        format!("\n<details><summary>{words}</summary>\n\n{table}\n</details>\n")
    } else {
        format!("\n**{words}**\n\n{table}")
    }
}

/// A table whose first column is code.
fn table<R>(columns: &[TableColumn<'_, R>], rows: &[&R]) -> String {
    let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
    let rule =
        |column: &TableColumn<'_, R>| if column.flush_left { "---" } else { "---:" }.to_owned();
    let mut table = line(columns.iter().map(|column| column.heading.to_string()).collect());
    table += &line(columns.iter().map(rule).collect());
    for row in rows.iter().take(MOST_ROWS) {
        let texts = columns.iter().map(|column| column.cell(row).text).enumerate();
        let cells = texts.map(|(k, text)| if k == 0 { code(&text) } else { prose(&text) });
        table += &line(cells.collect());
    }
    if let more @ 1.. = rows.len().saturating_sub(MOST_ROWS) {
        table += &format!("\nand {more} more\n");
    }
    table
}
