//! Plain aligned tables.

use super::prose::{WIDTH, wrap};
use crate::report::columns::TableColumn;
use crate::report::names::together;
use crate::verify::{distinct, grouped};
use std::borrow::Borrow;

/// A line of headings, and rows of cells. Cells are aligned to the right by default.
#[derive(Debug)]
pub(crate) struct Table {
    rows: Vec<Vec<String>>,
    flush_left: Vec<bool>,
}

impl Table {
    pub(crate) fn new<R>(
        columns: &[TableColumn<'_, R>],
        rows: impl IntoIterator<Item = impl Borrow<R>>,
    ) -> Self {
        let headings = columns.iter().map(|column| column.heading.to_string()).collect();
        let text = |row: &R, column: &TableColumn<'_, R>| printable(&column.cell(row).text);
        let cells = |row: &R| columns.iter().map(|column| text(row, column)).collect();
        let rows = rows.into_iter().map(|row| cells(row.borrow()));
        Self {
            rows: std::iter::once(headings).chain(rows).collect(),
            flush_left: columns.iter().map(|column| column.flush_left).collect(),
        }
    }

    /// Creates a table from headings and rows of cells. The first column is aligned to the left.
    pub(crate) fn of_cells(headings: Vec<String>, rows: Vec<Vec<String>>) -> Self {
        let flush_left = (0..headings.len()).map(|column| column == 0).collect();
        Self { rows: std::iter::once(headings).chain(rows).collect(), flush_left }
    }

    pub(crate) fn flush_left(mut self, headings: &[&str]) -> Self {
        for (flush_left, heading) in self.flush_left.iter_mut().zip(&self.rows[0]) {
            *flush_left |= headings.contains(&heading.as_str());
        }
        self
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.rows.len() == 1
    }

    /// Merges rows that are equal except for the name, which is combined or `all other cases`.
    pub(crate) fn merged(self) -> Self {
        self.merged_by(merged_blocks)
    }

    /// Merges rows like [`Table::merged`], but names every case.
    pub(crate) fn merged_by_name(self) -> Self {
        self.merged_by(|blocks| named_blocks(grouped(blocks.map(|(name, block)| (block, name)))))
    }

    fn merged_by(
        mut self,
        merge: impl FnOnce(std::vec::IntoIter<CaseRows>) -> Vec<Vec<String>>,
    ) -> Self {
        let block = |mut row: Vec<String>| {
            let cells = row.split_off(1);
            (row.pop().unwrap_or_default(), vec![cells])
        };
        let blocks: Vec<CaseRows> = self.rows.split_off(1).into_iter().map(block).collect();
        self.rows.extend(merge(blocks.into_iter()));
        self
    }

    /// Removes columns that contain only dashes below their heading.
    pub(crate) fn without_empty_columns(self) -> Self {
        self.without_columns_of("-")
    }

    pub(crate) fn without_columns_of(mut self, cell: &str) -> Self {
        let columns = self.rows[0].len();
        let kept: Vec<bool> =
            (0..columns).map(|c| self.rows[1..].iter().any(|row| row[c] != cell)).collect();
        for row in &mut self.rows {
            let mut column = kept.iter();
            row.retain(|_| *column.next().unwrap_or(&true));
        }
        let mut column = kept.iter();
        self.flush_left.retain(|_| *column.next().unwrap_or(&true));
        self
    }

    pub(crate) fn columns(&self) -> usize {
        self.rows[0].len()
    }

    /// Returns the indented lines of the table. Columns are as wide as their widest cell; those of
    /// results have a minimum width, so that a changed result changes only its own line. A table of
    /// more than 100 characters is split into blocks of columns that repeat the first column.
    pub(crate) fn lines(&self) -> Vec<String> {
        let width = |c: usize| {
            let cells = self.rows[1..].iter().map(|row| least_width(&row[c])).max();
            let listed = RESULTS.iter().find(|(heading, _)| *heading == self.rows[0][c]);
            self.widest(c).max(cells.unwrap_or(0)).max(listed.map_or(0, |(_, width)| *width))
        };
        let widths: Vec<usize> = (0..self.columns()).map(width).collect();
        let (mut lines, mut block) = (Vec::new(), vec![0]);
        let mut used = 2 + widths[0];
        for column in 1..self.columns() {
            if used + 2 + widths[column] > WIDTH && block.len() > 1 {
                lines.extend(self.aligned(&std::mem::replace(&mut block, vec![0]), &widths));
                lines.push(String::new());
                used = 2 + widths[0];
            }
            block.push(column);
            used += 2 + widths[column];
        }
        lines.extend(self.aligned(&block, &widths));
        lines
    }

    /// Returns the width of the widest cell of a column, or of the longest word of its heading.
    fn widest(&self, column: usize) -> usize {
        let cells = self.rows[1..].iter().map(|row| row[column].as_str());
        let words = self.rows[0][column].split(' ');
        cells.chain(words).map(|text| text.chars().count()).max().unwrap_or(0)
    }

    /// Aligns the cells of some columns. Wrapped headings end directly above the first row.
    fn aligned(&self, columns: &[usize], widths: &[usize]) -> Vec<String> {
        let set = |cells: Vec<&str>| {
            let cells = columns.iter().zip(cells).map(|(c, cell)| {
                let width = widths[*c];
                if self.flush_left[*c] {
                    format!("{cell:<width$}")
                } else {
                    format!("{cell:>width$}")
                }
            });
            format!("  {}", cells.collect::<Vec<_>>().join("  ")).trim_end().to_owned()
        };
        let wrapped = |(heading, width): (&String, &usize)| {
            let mut lines = Vec::new();
            wrap(&mut lines, *width, heading);
            lines
        };
        let headings: Vec<Vec<String>> = self.rows[0].iter().zip(widths).map(wrapped).collect();
        let height = columns.iter().map(|c| headings[*c].len()).max().unwrap_or(0);
        let heading = |line: usize, column: usize| {
            let lines = &headings[column];
            (line + lines.len()).checked_sub(height).map_or("", |line| lines[line].as_str())
        };
        let above =
            (0..height).map(|line| set(columns.iter().map(|c| heading(line, *c)).collect()));
        let row = |row: &Vec<String>| set(columns.iter().map(|c| row[*c].as_str()).collect());
        above.chain(self.rows[1..].iter().map(row)).collect()
    }
}

/// Minimum widths of columns with results in words.
const RESULTS: [(&str, usize); 3] = [("result", 11), ("verdict", 14), ("95 % interval", 14)];

/// Returns the width that a column with this cell has at least: all numbers of its kind fit.
fn least_width(cell: &str) -> usize {
    let number = cell.trim_matches(['(', ')']);
    match number.parse::<f64>() {
        Ok(_) if number.contains('e') => "(1.000e-06)".len(),
        Ok(_) if number.contains('.') => "-0.00".len(),
        Ok(_) if number.len() > 3 => "100000000".len(),
        _ => 0,
    }
}

/// Replaces control characters. Names may come from a file, and could change the terminal.
pub(crate) fn printable(text: &str) -> String {
    let safe = |c: char| if c.is_control() { '\u{fffd}' } else { c };
    text.chars().map(safe).collect()
}

/// Maximum length (characters) of the combined name of merged rows.
const LONGEST: usize = 44;

/// Rows of one case: its name, and the cells of each row.
type CaseRows = (String, Vec<Vec<String>>);

/// Puts the name of the block in front of its rows. Equal blocks are merged; if most are equal and
/// their combined name is too long, they are called `all (other) cases`, and stand last.
fn merged_blocks(blocks: impl Iterator<Item = CaseRows>) -> Vec<Vec<String>> {
    let mut groups = grouped(blocks.map(|(name, block)| (block, name)));
    let names: Vec<&String> = groups.iter().flat_map(|(_, names)| names).collect();
    let is_most = |names: &[String], all: usize| 2 * names.len() > all && !is_short(names);
    // A name with several different blocks would not be one of "all others".
    let others = (distinct(names.iter()).len() == names.len())
        .then(|| groups.iter().position(|(_, group)| is_most(group, names.len())))
        .flatten()
        .map(|at| groups.remove(at).0);
    let name = if groups.is_empty() { "all cases" } else { "all other cases" };
    let mut rows = named_blocks(groups);
    rows.extend(others.into_iter().flatten().map(|cells| [vec![name.to_owned()], cells].concat()));
    rows
}

/// Puts the combined name of each group in front of its rows, in parts if it is too long.
fn named_blocks(groups: Vec<(Vec<Vec<String>>, Vec<String>)>) -> Vec<Vec<String>> {
    let mut rows = Vec::new();
    for (block, names) in groups {
        let mut parts: Vec<Vec<String>> = Vec::new();
        for name in names {
            match parts.last_mut() {
                Some(part) if is_short(&[&part[..], std::slice::from_ref(&name)].concat()) => {
                    part.push(name);
                }
                _ => parts.push(vec![name]),
            }
        }
        for names in parts {
            let name = combined(&names);
            rows.extend(block.iter().map(|cells| [std::slice::from_ref(&name), cells].concat()));
        }
    }
    rows
}

fn combined(names: &[String]) -> String {
    together(&names.iter().map(String::as_str).collect::<Vec<_>>())
}

fn is_short(names: &[String]) -> bool {
    combined(names).chars().count() <= LONGEST
}

/// Lists the distinct values, each with its names in brackets unless all names have it.
pub(crate) fn shared<'a>(
    values: impl Iterator<Item = (&'a str, String)>,
) -> impl Iterator<Item = (String, String)> {
    let found = grouped(values.map(|(name, value)| (value, name)));
    let most = found.iter().map(|(_, names)| names.len()).max().unwrap_or(0);
    let single = found.len() == 1;
    // If several groups had the maximum size, "all others" would be ambiguous.
    let is_largest_alone = found.iter().filter(|(_, names)| names.len() == most).count() == 1;
    found.into_iter().map(move |(value, names)| {
        let of = match names.len() {
            _ if single => String::new(),
            count if count == most && count > 2 && is_largest_alone => {
                " (all other cases)".to_owned()
            }
            _ => match together(&names) {
                // A long name can be wrapped only at spaces.
                long if long.len() > WIDTH - 20 => format!(" ({})", long.replace(',', ", ")),
                name => format!(" ({name})"),
            },
        };
        (value, of)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_single_largest_group_is_called_all_other_cases() {
        let names_of = |values: &str| -> Vec<String> {
            let names = ["a", "b", "c", "d", "e", "f"].into_iter();
            shared(names.zip(values.chars().map(String::from))).map(|(_, names)| names).collect()
        };
        assert_eq!(names_of("xxxyyy"), [" ({a,b,c})", " ({d,e,f})"]);
        assert_eq!(names_of("xxxxyy"), [" (all other cases)", " ({e,f})"]);
        assert_eq!(names_of("xxxxxx"), [""]);
    }

    #[test]
    fn equal_rows_are_merged() {
        let merged = |rows: Vec<[String; 2]>, by_name: bool| {
            let headings = vec!["case".to_owned(), String::new()];
            let table = Table::of_cells(headings, rows.into_iter().map(Vec::from).collect());
            let table = if by_name { table.merged_by_name() } else { table.merged() };
            table.rows[1..].to_vec()
        };
        let rows = || [["a-x", "1"], ["a-y", "2"], ["a-z", "1"], ["b-x", "1"]];
        let rows = || rows().map(|row| row.map(str::to_owned)).to_vec();
        for by_name in [false, true] {
            assert_eq!(merged(rows(), by_name), [vec!["{a-x,a-z,b-x}", "1"], vec!["a-y", "2"]]);
        }
        let long = |k: usize| [format!("{}-{k}", "word".repeat(6)), String::new()];
        let many = || (0..20).map(long).collect::<Vec<_>>();
        let named = merged(many(), true);
        assert!(named.len() > 1 && named.iter().all(|row| row[0].len() <= LONGEST));
        assert_eq!(merged(many(), false), [["all cases", ""]]);
        let rest = merged([rows(), many()].concat(), false);
        assert_eq!(rest[2], ["all other cases", ""]);
        // Rows of several values of the same case cannot be called "all others".
        assert!(merged([many(), many()].concat(), false).len() > 1);
    }
}
