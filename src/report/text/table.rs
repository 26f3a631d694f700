//! Plain aligned tables.

use super::merged::merged;
use crate::report::columns::TableColumn;
use std::borrow::Borrow;

/// A line of headings and rows of cells, set flush right unless their column says otherwise.
#[derive(Debug)]
pub(crate) struct Table {
    rows: Vec<Vec<String>>,
    flush_left: Vec<bool>,
}

impl Table {
    /// The values of `columns` in `rows`.
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

    /// Rows of cells under headings, the first column flush left.
    pub(crate) fn of_cells(headings: Vec<String>, rows: Vec<Vec<String>>) -> Self {
        let flush_left = (0..headings.len()).map(|column| column == 0).collect();
        Self { rows: std::iter::once(headings).chain(rows).collect(), flush_left }
    }

    /// The same with columns flush left that have these headings.
    pub(crate) fn flush_left(mut self, headings: &[&str]) -> Self {
        for (flush_left, heading) in self.flush_left.iter_mut().zip(&self.rows[0]) {
            *flush_left |= headings.contains(&heading.as_str());
        }
        self
    }

    /// Whether there is no row but the headings.
    pub(crate) fn is_empty(&self) -> bool {
        self.rows.len() == 1
    }

    /// Rows that show the same as one, whose first cell has the names of all.
    pub(crate) fn merged(mut self) -> Self {
        let rows = self.rows.split_off(1);
        self.rows.extend(merged(rows));
        self
    }

    /// Drops every column with dashes in all rows but the headings.
    pub(crate) fn without_empty_columns(self) -> Self {
        self.without_columns_of("-")
    }

    /// Drops every column that has but this cell below its heading.
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

    /// Number of columns.
    pub(crate) fn columns(&self) -> usize {
        self.rows[0].len()
    }

    /// The lines, each indented by two spaces, with columns as wide as their widest cells.
    pub(crate) fn lines(&self) -> Vec<String> {
        let columns = self.rows[0].len();
        let width =
            |c: usize| self.rows.iter().map(|row| row[c].chars().count()).max().unwrap_or(0);
        self.aligned(&(0..columns).map(width).collect::<Vec<_>>())
    }

    /// The lines with columns of fixed widths by heading: a wider cell moves the rest of its own
    /// line, and no other line. Columns that `widths` does not list are as wide as their headings.
    pub(crate) fn lines_of_widths(&self, widths: &[(&str, usize)]) -> Vec<String> {
        let width = |heading: &String| {
            let listed = widths.iter().find(|(known, _)| known == heading);
            listed.map_or(heading.chars().count(), |(_, width)| *width)
        };
        self.aligned(&self.rows[0].iter().map(width).collect::<Vec<_>>())
    }

    fn aligned(&self, widths: &[usize]) -> Vec<String> {
        let set = |row: &Vec<String>| {
            let cells = row.iter().zip(widths).zip(&self.flush_left);
            let cells = cells.map(|((cell, width), flush_left)| match flush_left {
                true => format!("{cell:<width$}"),
                false => format!("{cell:>width$}"),
            });
            format!("  {}", cells.collect::<Vec<_>>().join("  ")).trim_end().to_owned()
        };
        self.rows.iter().map(set).collect()
    }
}

/// Names may come from a file: none of their characters may steer a terminal.
pub(crate) fn printable(text: &str) -> String {
    let safe = |c: char| if c.is_control() { '\u{fffd}' } else { c };
    text.chars().map(safe).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_aligned_and_empty_ones_left_out() {
        let columns = [
            TableColumn::text("cells", "", |row: &[&'static str; 2]| row[0]),
            TableColumn::text("ppc", "", |_: &[&'static str; 2]| None::<u64>),
            TableColumn::text("rms", "", |row: &[&'static str; 2]| row[1]),
        ];
        let table = Table::new(&columns, [["5", "1.0"], ["160", "0.25"]]);
        let lines = table.without_empty_columns().lines();
        assert_eq!(lines, ["  cells   rms", "      5   1.0", "    160  0.25"]);
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
}
