//! Prints a comparison as aligned text, Markdown and JSON.

use super::changes::{CheapestMove, ErrorMove, Moved, ProblemMove, Rank, ReportComparison};
use crate::report::columns::{TableColumn, number};
use crate::report::text::table::{Table, printable};
use serde_json::{Value, json};

/// Writes a comparison as aligned text: a summary line, and a table for each kind of change.
pub fn text(comparison: &ReportComparison) -> String {
    let head = if comparison.is_worse() { "worse" } else { "nothing worse" };
    let mut lines = vec![format!("{head}: {}", comparison.headline())];
    lines.extend(comparison.in_common().map(|line| printable(&line)));
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
    lines.extend([String::new(), equality(share)]);
    lines.join("\n") + "\n"
}

/// Maximum number of rows of a Markdown table. Comments on pull requests are limited to 65536
/// characters.
const MAX_ROWS: usize = 40;

/// Writes a comparison as Markdown, for a comment on a pull request.
///
/// The first line is a summary. Tables of worse results are unfolded, and all other tables are
/// folded. All text from files is escaped, so that it cannot contain markup, mention a user or end
/// a table.
pub fn markdown(comparison: &ReportComparison) -> String {
    let head = if comparison.is_worse() { "Worse" } else { "Nothing worse" };
    let mut page = format!("**mpm-verify: {head}**: {}\n", comparison.headline());
    if let Some(line) = comparison.in_common() {
        page += &format!("\n{}\n", prose(&line));
    }
    if !comparison.problems.is_empty() {
        page += "\n**Changed problem: errors and orders are not compared**\n\n";
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
        "\n<sub>{} Work is the number of transfers between particles and nodes.</sub>\n",
        equality(share)
    )
}

fn equality(tolerance: f64) -> String {
    format!("Values count as equal within a relative difference of {tolerance}.")
}

/// Creates the table of changed cases, without columns that contain only dashes.
fn changes(moved: &[&Moved]) -> String {
    let mut columns: Vec<_> = cases().into();
    let joined = |moved: &Moved| Some(notes(moved).join("; ")).filter(|notes| !notes.is_empty());
    columns.push(TableColumn::text("notes", "notes", joined).flush_left());
    let is_kept = |column: &TableColumn<'_, Moved>| {
        moved.iter().take(MAX_ROWS).any(|moved| column.cell(moved).text != "-")
    };
    columns.retain(is_kept);
    table(&columns, moved)
}

/// Creates the table of the minimum work for target errors. The table is unfolded if an error
/// requires more work than before.
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

/// Creates a Markdown table whose first column is formatted as code.
fn table<R>(columns: &[TableColumn<'_, R>], rows: &[&R]) -> String {
    let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
    let rule =
        |column: &TableColumn<'_, R>| if column.flush_left { "---" } else { "---:" }.to_owned();
    let mut table = line(columns.iter().map(|column| column.heading.to_string()).collect());
    table += &line(columns.iter().map(rule).collect());
    for row in rows.iter().take(MAX_ROWS) {
        let texts = columns.iter().map(|column| column.cell(row).text).enumerate();
        let cells = texts.map(|(k, text)| if k == 0 { code(&text) } else { prose(&text) });
        table += &line(cells.collect());
    }
    if let more @ 1.. = rows.len().saturating_sub(MAX_ROWS) {
        table += &format!("\nand {more} more\n");
    }
    table
}

/// Converts a comparison to one JSON document: suites with a changed problem; changed cases, the
/// most important first; and target errors with a changed minimum work.
pub fn json(comparison: &ReportComparison) -> String {
    let document = json!({
        "worse": comparison.is_worse(),
        "problems": comparison.problems.iter().map(problem_json).collect::<Vec<_>>(),
        "moved": comparison.moved.iter().map(moved_json).collect::<Vec<_>>(),
        "cheapest": comparison.cheapest.iter().map(cheapest_json).collect::<Vec<_>>(),
        "unchanged": comparison.unchanged,
        "tolerance": number(comparison.tolerance),
    });
    format!("{document:#}\n")
}

fn problem_json(problem: &ProblemMove) -> Value {
    json!({"suite": problem.suite, "rows": problem.rows})
}

fn moved_json(moved: &Moved) -> Value {
    json!({
        "case": moved.name,
        "rank": moved.rank.words(),
        "worse": moved.rank.is_worse(),
        "verdict": moved.verdict,
        "order": moved.order.map(|order| order.map(number)),
        "error": moved.error.as_ref().map(error_json),
        "transfers": moved.work.map(number),
        "same_error": moved.equal.map(|equal| {
            json!({"ratio": number(equal.ratio), "error": number(equal.target)})
        }),
        "notes": moved.notes,
    })
}

fn error_json(error: &ErrorMove) -> Value {
    let ErrorMove { old, new, worse, level } = error;
    json!({"old": old.map(number), "new": new.map(number), "worse": worse, "level": level})
}

fn cheapest_json(target: &CheapestMove) -> Value {
    let one = |least: &Option<(f64, String)>| {
        least.as_ref().map(|(work, case)| json!({"work": number(*work), "case": case}))
    };
    json!({
        "problem": target.place,
        "error": number(target.target),
        "old": one(&target.old),
        "new": one(&target.new),
    })
}

/// Maximum number of printed notes of a case. The other notes are only counted.
const MAX_NOTES: usize = 3;

/// Returns the columns for changes of a case, with dashes if there is no change or value.
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

/// Returns the first notes of a case, and the number of the other notes.
pub(super) fn notes(moved: &Moved) -> Vec<String> {
    let mut notes: Vec<String> = moved.notes.iter().take(MAX_NOTES).cloned().collect();
    if let more @ 1.. = moved.notes.len().saturating_sub(MAX_NOTES) {
        notes.push(format!("and {more} more"));
    }
    notes
}

/// Formats a change as `old -> new`. A value is printed alone if it did not change or is in only
/// one run.
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

/// Creates a code span. Only backticks, table bars and control characters need replacement.
pub(super) fn code(text: &str) -> String {
    let plain = |c: char| match c {
        '`' => "'".to_owned(),
        '|' => "\\|".to_owned(),
        c if c.is_control() => "\u{fffd}".to_owned(),
        c => c.to_string(),
    };
    format!("`{}`", text.chars().map(plain).collect::<String>())
}

/// Escapes all markup, so the result is also valid in an HTML attribute. ` -> ` becomes an arrow.
pub(super) fn prose(text: &str) -> String {
    let plain = |c: char| match c {
        c if c.is_control() => "\u{fffd}".to_owned(),
        c if "&<>|`*_[]()~@#!\\:/\"".contains(c) => format!("&#{};", u32::from(c)),
        c => c.to_string(),
    };
    let arrows = text.split(" -> ").map(|part| part.chars().map(plain).collect::<String>());
    arrows.collect::<Vec<_>>().join(" → ")
}
