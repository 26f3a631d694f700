//! Judges measured quantities, relative to their expected values, by a table of rules.

use super::course::shown;
use super::finding::SolverFinding;
use super::patient::Examined;

/// Measured quantities of one place or run; `None` for a quantity that was not measured.
pub(super) type Row<const N: usize> = (String, [Option<f64>; N]);

/// Values that identify a finding; [`ANY`] for a quantity that may have any value.
pub(super) type Pattern<const N: usize> = [f64; N];

pub(super) const ANY: f64 = f64::NAN;

/// Expected values of `N` quantities, and the findings if other values are measured.
pub(super) struct Rules<const N: usize> {
    /// Name, expected value and accepted error of each quantity.
    pub(super) quantities: [(&'static str, f64, f64); N],
    /// Name, pattern and cause of each finding, by priority. The last one accepts any values.
    pub(super) findings: &'static [(&'static str, Pattern<N>, &'static str)],
    pub(super) look_at: &'static str,
}

impl<const N: usize> Rules<N> {
    /// Reports the first finding that fits the first wrong row, with all wrong rows that it fits.
    pub(super) fn judge(&self, rows: &[Row<N>]) -> Examined {
        let agrees = |(_, values): &Row<N>, pattern: &Pattern<N>| {
            values.iter().zip(pattern).zip(&self.quantities).all(|((value, wanted), quantity)| {
                let near = quantity.2 * wanted.abs().max(1.0);
                value.is_none_or(|value| wanted.is_nan() || (value - wanted).abs() <= near)
            })
        };
        // A pattern without any measured quantity identifies nothing, except the last one.
        let fits = |row: &Row<N>, pattern: &Pattern<N>| {
            let mut pairs = row.1.iter().zip(pattern);
            let is_last = pattern.iter().all(|wanted| wanted.is_nan());
            agrees(row, pattern) && (is_last || pairs.any(|(a, b)| a.is_some() && !b.is_nan()))
        };
        let expected = self.quantities.map(|(_, expected, _)| expected);
        let wrong: Vec<&Row<N>> = rows.iter().filter(|row| !agrees(row, &expected)).collect();
        let finding = wrong.first().and_then(|first| {
            let mut findings = self.findings.iter();
            let (name, pattern, cause) = findings.find(|(_, pattern, _)| fits(first, pattern))?;
            let alike = wrong.iter().filter(|row| fits(row, pattern)).map(|row| self.text(row));
            let seen = alike.collect::<Vec<_>>().join("; ");
            Some(SolverFinding::defect(name, seen, cause, self.look_at))
        });
        let expected: Vec<String> = self
            .quantities
            .iter()
            .zip(0..)
            .filter(|(_, k)| rows.iter().any(|(_, values)| values[*k].is_some()))
            .map(|((name, expected, _), _)| format!("{name} {expected}"))
            .collect();
        let rows = rows.iter().map(|row| self.text(row)).collect::<Vec<_>>().join("; ");
        let measured = format!("{rows}. Expected: {}", expected.join(", "));
        Examined::new(measured, finding)
    }

    fn text(&self, (place, values): &Row<N>) -> String {
        let values = self.quantities.iter().zip(values).filter_map(|((name, ..), value)| {
            value.map(|value| format!("{name} {}", shown(value)))
        });
        format!("{place}: {}", values.collect::<Vec<_>>().join(", "))
    }
}
