//! Levels of a refinement study, put in order and checked.

use std::cmp::Ordering;

use super::axis::Axis;
use super::format_number::format_number;

/// One level of refinement: a spacing and the error measured there.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// The spacing that was refined: of the grid, of time or of particles. Not a number of cells.
    pub h: f64,
    /// A norm of the error.
    pub error: f64,
    /// False for a level that is shown but must not count, for instance because particles
    /// crossed cells there and the theory does not cover that.
    pub usable: bool,
    /// Why the run of this level failed, if it did.
    pub failed: Option<String>,
}

impl Level {
    /// A level that counts.
    pub fn new(h: f64, error: f64) -> Self {
        Self { h, error, usable: true, failed: None }
    }

    /// The same level, shown but not counted.
    #[must_use]
    pub fn unusable(self) -> Self {
        Self { usable: false, ..self }
    }

    /// The same level as the place of a failure.
    #[must_use]
    pub fn failing(self, reason: impl Into<String>) -> Self {
        Self { failed: Some(reason.into()), ..self }
    }

    /// Defect that makes this level worthless, usable or not.
    fn diagnostic(&self, axis: Axis) -> Option<String> {
        let (name, h) = (axis.symbol(), format_number(self.h));
        if let Some(reason) = &self.failed {
            return Some(format!("{name} = {h}: {reason}"));
        }
        if !(self.h.is_finite() && self.h > 0.0) {
            return Some(format!("{name} = {h} is not a spacing"));
        }
        if !(self.error.is_finite() && self.error >= 0.0) {
            let error = format_number(self.error);
            return Some(format!("{name} = {h}: {error} is not an error"));
        }
        None
    }
}

/// Sorts from coarse to fine and merges identical levels; one that counts and one that does not
/// merge into one that does not. The diagnostic names the first thing that makes the series void.
pub(crate) fn arrange(levels: &[Level], axis: Axis) -> (Vec<Level>, Option<String>) {
    let mut sorted = levels.to_vec();
    sorted.sort_by(|a, b| b.h.total_cmp(&a.h).then(a.error.total_cmp(&b.error)));
    sorted.dedup_by(|next, kept| {
        let same =
            same(next.h, kept.h) && same(next.error, kept.error) && next.failed == kept.failed;
        if same {
            kept.usable &= next.usable;
        }
        same
    });
    let diagnostic = sorted
        .iter()
        .find_map(|level| level.diagnostic(axis))
        .or_else(|| sorted.windows(2).find_map(|pair| contradiction(pair, axis)));
    (sorted, diagnostic)
}

fn contradiction(pair: &[Level], axis: Axis) -> Option<String> {
    let [a, b] = pair else { return None };
    same(a.h, b.h).then(|| {
        let (h, first, second) =
            (format_number(a.h), format_number(a.error), format_number(b.error));
        format!("{} = {h} appears twice, with errors {first} and {second}", axis.symbol())
    })
}

fn same(a: f64, b: f64) -> bool {
    a.partial_cmp(&b) == Some(Ordering::Equal)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[test]
    fn coarse_comes_first_and_identical_levels_merge() {
        let given = [
            Level::new(1.0, 0.1),
            Level::new(4.0, 1.0),
            Level::new(1.0, 0.1).unusable(),
            Level::new(2.0, 0.3),
        ];
        let (levels, diagnostic) = arrange(&given, Axis::Space);
        let expected = [given[1].clone(), given[3].clone(), given[2].clone()];
        assert_eq!(levels, expected);
        assert_eq!(diagnostic, None);
    }

    #[rstest]
    #[case(Level::new(f64::NAN, 1.0), "h = NaN is not a spacing")]
    #[case(Level::new(0.0, 1.0), "h = 0 is not a spacing")]
    #[case(Level::new(-1.0, 1.0), "h = -1 is not a spacing")]
    #[case(Level::new(2.0, f64::NAN), "h = 2: NaN is not an error")]
    #[case(Level::new(2.0, f64::INFINITY).unusable(), "h = 2: inf is not an error")]
    #[case(Level::new(2.0, -1.0), "h = 2: -1 is not an error")]
    #[case(Level::new(2.0, 1.0).failing("particle 7 inverted"), "h = 2: particle 7 inverted")]
    #[case(Level::new(1.0, 0.25), "h = 1 appears twice, with errors 0.25 and 0.5")]
    fn diagnostics(#[case] level: Level, #[case] expected: &str) {
        let (_, diagnostic) = arrange(&[Level::new(1.0, 0.5), level], Axis::Space);
        assert_eq!(diagnostic.as_deref(), Some(expected));
    }
}
