//! A comparison as Markdown, for a comment on a pull request.
//!
//! One line says what happened; what got worse is open to the eye, the rest is folded. Every text comes
//! from a file and is escaped: it can be no markup, mention nobody and end no table.

use super::{
    moved::{Comparison, Moved, Rank},
    row::{HEADS, TARGET_HEADS, cells, notes, target},
};

/// Most rows of a table: a comment may have 65536 characters.
const MOST_ROWS: usize = 40;

/// The comment.
pub fn markdown(comparison: &Comparison) -> String {
    let head = if comparison.is_worse() { "Worse" } else { "Nothing worse" };
    let mut page = format!("**mpm-verify: {head}**: {}\n", comparison.headline());
    for rank in Rank::ALL {
        let moved: Vec<&Moved> = comparison.of(rank).collect();
        if moved.is_empty() {
            continue;
        }
        let (count, words) = (moved.len(), rank.words());
        let table = table(&moved);
        page += &if rank.is_worse() {
            format!("\n**{count} {words}**\n\n{table}")
        } else {
            format!("\n<details><summary>{count} {words}</summary>\n\n{table}\n</details>\n")
        };
    }
    page += &targets(comparison);
    let share = comparison.tolerance;
    page + &format!(
        "\n<sub>Figures count as equal within a share of {share}. Transfers between particles and nodes are the measure of work.</sub>\n"
    )
}

/// Columns with nothing but dashes are left out.
fn table(moved: &[&Moved]) -> String {
    let shown = &moved[..moved.len().min(MOST_ROWS)];
    let rows: Vec<Vec<String>> = shown.iter().map(|moved| row(moved)).collect();
    let kept: Vec<usize> =
        (0..=HEADS.len()).filter(|k| rows.iter().any(|row| row[*k] != "-")).collect();
    let line = |cells: &dyn Fn(usize) -> String| {
        let cells: Vec<String> = kept.iter().map(|k| cells(*k)).collect();
        format!("| {} |\n", cells.join(" | "))
    };
    let mut page = line(&|k| (*HEADS.get(k).unwrap_or(&"notes")).to_owned());
    page += &line(&|k| if k < 2 || k == HEADS.len() { "---" } else { "---:" }.to_owned());
    page.extend(rows.iter().map(|row| line(&|k| row[k].clone())));
    if let more @ 1.. = moved.len() - shown.len() {
        page += &format!("\nand {more} more\n");
    }
    page
}

/// What the cheapest method takes for an error: open if one became dearer.
fn targets(comparison: &Comparison) -> String {
    let moved = &comparison.cheapest;
    let Some(first) = moved.first() else { return String::new() };
    let shown = &moved[..moved.len().min(MOST_ROWS)];
    let mut table =
        format!("| {} |\n| --- | ---: | ---: | ---: | --- |\n", TARGET_HEADS.join(" | "));
    for moved in shown {
        let [place, cells @ ..] = target(moved);
        let cells = cells.map(|cell| prose(&cell)).join(" | ");
        table += &format!("| {} | {cells} |\n", code(&place));
    }
    if let more @ 1.. = moved.len() - shown.len() {
        table += &format!("\nand {more} more\n");
    }
    let words = "Cheapest for an error";
    if first.ratio() < 1.0 {
        format!("\n<details><summary>{words}</summary>\n\n{table}\n</details>\n")
    } else {
        format!("\n**{words}**\n\n{table}")
    }
}

fn row(moved: &Moved) -> Vec<String> {
    let [name, cells @ ..] = cells(moved);
    let notes = notes(moved);
    let notes = if notes.is_empty() { "-".to_owned() } else { notes.join("; ") };
    let mut row = vec![code(&name)];
    row.extend(cells.iter().chain([&notes]).map(|text| prose(text)));
    row
}

/// A code span, in which nothing is markup but its own end, and the bar of a table.
fn code(text: &str) -> String {
    let plain = |c: char| match c {
        '`' => "'".to_owned(),
        '|' => "\\|".to_owned(),
        c if c.is_control() => "\u{fffd}".to_owned(),
        c => c.to_string(),
    };
    format!("`{}`", text.chars().map(plain).collect::<String>())
}

/// Text without any markup; the arrow of a change is one.
fn prose(text: &str) -> String {
    let plain = |c: char| match c {
        c if c.is_control() => "\u{fffd}".to_owned(),
        c if "&<>|`*_[]()~@#!\\:/".contains(c) => format!("&#{};", u32::from(c)),
        c => c.to_string(),
    };
    let arrows = text.split(" -> ").map(|part| part.chars().map(plain).collect::<String>());
    arrows.collect::<Vec<_>>().join(" → ")
}
