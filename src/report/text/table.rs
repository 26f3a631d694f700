//! Plain aligned tables.

use super::prose::WIDTH;
use crate::report::columns::TableColumn;
use crate::report::names::together;
use crate::verify::grouped;
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

    /// Whether there are no rows except the headings.
    pub(crate) fn is_empty(&self) -> bool {
        self.rows.len() == 1
    }

    /// Merges rows that are equal except for the first cell, the name. The name of a merged row
    /// combines all names.
    pub(crate) fn merged(mut self) -> Self {
        let rows = self.rows.split_off(1);
        self.rows.extend(merged(rows));
        self
    }

    /// Removes columns that contain only dashes below their heading.
    pub(crate) fn without_empty_columns(self) -> Self {
        self.without_columns_of("-")
    }

    /// Removes columns that contain only `cell` below their heading.
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

    /// Returns the lines of the table, indented by two spaces. Each column is as wide as its widest
    /// cell; columns of results also have a minimum width, so that a changed result changes only
    /// its own line. A table of more than 100 characters is split into blocks of columns, which
    /// repeat the first column.
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

    /// Returns the width of the widest cell of a column.
    fn widest(&self, column: usize) -> usize {
        self.rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0)
    }

    /// Returns the lines of the table, with the column widths that `widths` lists by heading. A
    /// wider cell shifts only the rest of its line. Other columns are as wide as their headings.
    pub(crate) fn lines_of_widths(&self, widths: &[(&str, usize)]) -> Vec<String> {
        let width = |heading: &String| {
            let listed = widths.iter().find(|(known, _)| known == heading);
            listed.map_or(heading.chars().count(), |(_, width)| *width)
        };
        let columns: Vec<usize> = (0..self.columns()).collect();
        self.aligned(&columns, &self.rows[0].iter().map(width).collect::<Vec<_>>())
    }

    fn aligned(&self, columns: &[usize], widths: &[usize]) -> Vec<String> {
        let set = |row: &Vec<String>| {
            let cells = columns.iter().map(|c| match (&row[*c], widths[*c], self.flush_left[*c]) {
                (cell, width, true) => format!("{cell:<width$}"),
                (cell, width, false) => format!("{cell:>width$}"),
            });
            format!("  {}", cells.collect::<Vec<_>>().join("  ")).trim_end().to_owned()
        };
        self.rows.iter().map(set).collect()
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

/// Replaces control characters. Names may come from a file, and control characters could change the
/// terminal.
pub(crate) fn printable(text: &str) -> String {
    let safe = |c: char| if c.is_control() { '\u{fffd}' } else { c };
    text.chars().map(safe).collect()
}

/// Maximum length (characters) of the combined name of merged rows.
const LONGEST: usize = 44;

/// Merges rows whose cells after the name are equal. The combined row has all names.
fn merged(rows: Vec<Vec<String>>) -> Vec<Vec<String>> {
    let block = |mut row: Vec<String>| {
        let cells = row.split_off(1);
        (row.pop().unwrap_or_default(), vec![cells])
    };
    merged_blocks(rows.into_iter().map(block))
}

/// Puts the name of the block in front of each of its rows. Equal blocks are merged and get a
/// combined name.
pub(crate) fn merged_blocks(
    blocks: impl Iterator<Item = (String, Vec<Vec<String>>)>,
) -> Vec<Vec<String>> {
    let mut kept: Vec<(Vec<String>, Vec<Vec<String>>)> = Vec::new();
    for (name, block) in blocks {
        let fits = |names: &[String]| {
            let names: Vec<&str> = names.iter().chain([&name]).map(String::as_str).collect();
            together(&names).chars().count() <= LONGEST
        };
        match kept.iter_mut().rev().find(|(names, shown)| *shown == block && fits(names)) {
            Some((names, _)) => names.push(name),
            None => kept.push((vec![name], block)),
        }
    }
    let rows = |(names, block): (Vec<String>, Vec<Vec<String>>)| {
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let name = together(&names);
        block.into_iter().map(move |cells| std::iter::once(name.clone()).chain(cells).collect())
    };
    kept.into_iter().flat_map(rows).collect()
}

/// Lists the distinct values, each with its names in brackets. The brackets are omitted if all
/// names have the same value.
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
            _ => format!(" ({})", together(&names)),
        };
        (value, of)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_aligned_and_empty_ones_omitted() {
        let columns = [
            TableColumn::text("cells", "", |row: &[&'static str; 2]| row[0]),
            TableColumn::text("ppc", "", |_: &[&'static str; 2]| None::<u64>),
            TableColumn::text("rms", "", |row: &[&'static str; 2]| row[1]),
        ];
        let table = Table::new(&columns, [["5", "1.0"], ["160", "0.25"]]);
        let lines = table.without_empty_columns().lines();
        assert_eq!(lines, ["  cells    rms", "      5    1.0", "    160   0.25"]);
    }

    #[test]
    fn a_wide_cell_moves_only_its_own_line_between_fixed_widths() {
        let rows = |name: &str| {
            vec![vec![name.to_owned(), "1".to_owned()], vec!["b".to_owned(), "2".to_owned()]]
        };
        let lines = |name: &str| {
            let table = Table::of_cells(vec!["case".to_owned(), "order".to_owned()], rows(name));
            table.lines_of_widths(&[("case", 6)])
        };
        assert_eq!(lines("a"), ["  case    order", "  a           1", "  b           2"]);
        assert_eq!(
            lines("a long name"),
            ["  case    order", "  a long name      1", "  b           2"]
        );
    }

    #[test]
    fn equal_rows_are_merged() {
        let rows = [["a-x", "1"], ["a-y", "2"], ["a-z", "1"], ["b-x", "1"]];
        let rows = rows.map(|row| row.map(str::to_owned).to_vec()).to_vec();
        assert_eq!(merged(rows), [vec!["{a-x,a-z,b-x}", "1"], vec!["a-y", "2"]]);
        let long = |k: usize| vec![format!("{}-{k}", "word".repeat(6)), String::new()];
        let rows = merged((0..20).map(long).collect());
        assert!(rows.len() > 1 && rows.iter().all(|row| row[0].len() <= LONGEST));
    }
}
