//! Plain aligned tables.

/// Rows of cells, set flush right under their heads unless asked otherwise.
#[derive(Debug, Default)]
pub(crate) struct Table {
    rows: Vec<Vec<String>>,
    flush_left: Vec<usize>,
}

impl Table {
    /// A table with a line of heads.
    pub(crate) fn new(heads: &[&str]) -> Self {
        Self { rows: vec![heads.iter().map(ToString::to_string).collect()], flush_left: Vec::new() }
    }

    /// Adds a row; it has as many cells as there are heads.
    pub(crate) fn row(&mut self, cells: Vec<String>) {
        self.rows.push(cells);
    }

    /// Drops every column in which no row but the head has more than a dash.
    pub(crate) fn without_empty_columns(mut self) -> Self {
        let columns = self.rows[0].len();
        let kept: Vec<bool> =
            (0..columns).map(|c| self.rows[1..].iter().any(|row| row[c] != "-")).collect();
        for row in &mut self.rows {
            let mut column = kept.iter();
            row.retain(|_| *column.next().unwrap_or(&true));
        }
        self
    }

    /// Sets the given columns flush left.
    pub(crate) fn flush_left(mut self, columns: &[usize]) -> Self {
        self.flush_left = columns.to_vec();
        self
    }

    /// The lines, each indented by two spaces.
    pub(crate) fn lines(&self) -> Vec<String> {
        let columns = self.rows[0].len();
        let width =
            |c: usize| self.rows.iter().map(|row| row[c].chars().count()).max().unwrap_or(0);
        let widths: Vec<usize> = (0..columns).map(width).collect();
        let set = |row: &Vec<String>| {
            let cells = row.iter().zip(&widths).enumerate().map(|(column, (cell, width))| {
                if self.flush_left.contains(&column) {
                    format!("{cell:<width$}")
                } else {
                    format!("{cell:>width$}")
                }
            });
            format!("  {}", cells.collect::<Vec<_>>().join("  ")).trim_end().to_owned()
        };
        self.rows.iter().map(set).collect()
    }
}

/// A cell for something that may not exist.
pub(crate) fn optional<T: ToString>(value: Option<T>) -> String {
    value.map_or_else(|| "-".to_owned(), |value| value.to_string())
}

/// An error or a length: four significant digits, exponent of two digits.
pub(crate) fn scientific(value: f64) -> String {
    if !value.is_finite() {
        return if value.is_nan() { "nan".to_owned() } else { "inf".to_owned() };
    }
    // No minus before a zero.
    let text = format!("{:.3e}", value + 0.0);
    let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let (sign, digits) = exponent.strip_prefix('-').map_or(("+", exponent), |digits| ("-", digits));
    format!("{mantissa}e{sign}{digits:0>2}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[rstest]
    #[case(1.23456e-5, "1.235e-05")]
    #[case(0.0, "0.000e+00")]
    #[case(-0.0, "0.000e+00")]
    #[case(-2.5e12, "-2.500e+12")]
    #[case(1e-300, "1.000e-300")]
    #[case(f64::NAN, "nan")]
    #[case(f64::INFINITY, "inf")]
    fn numbers(#[case] value: f64, #[case] text: &str) {
        assert_eq!(scientific(value), text);
    }

    #[test]
    fn columns_are_aligned_and_empty_ones_left_out() {
        let mut table = Table::new(&["cells", "ppc", "rms"]);
        table.row(vec!["5".into(), "-".into(), "1.0".into()]);
        table.row(vec!["160".into(), "-".into(), "0.25".into()]);
        let lines = table.without_empty_columns().lines();
        assert_eq!(lines, ["  cells   rms", "      5   1.0", "    160  0.25"]);
    }
}
