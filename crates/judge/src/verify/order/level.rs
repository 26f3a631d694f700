//! Refinement levels: axes, errors, and the order between two levels.

use super::format_number::format_number;
use mpm_subject::named;
use std::cmp::Ordering;

named! {
    /// Axis of refinement. The errors of all axes add up, so refining a single axis cannot reduce
    /// the error below that of the other axes.
    pub enum Axis {
        /// Cells. The time step may be a formula of h.
        Space = "space",
        /// Time steps, on one grid.
        Time = "time",
        /// Particles per cell, on one grid. The particle spacing along an axis is h/ppc^(1/D).
        Particles = "particles",
    }
}

impl Axis {
    /// Returns the symbol of the refined spacing, for texts and tables.
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Space => "h",
            Self::Time => "dt",
            Self::Particles => "particle spacing",
        }
    }

    /// Returns the name of the refined spacing.
    pub fn noun(self) -> &'static str {
        match self {
            Self::Space => "cell size",
            Self::Time => "time step",
            Self::Particles => "particle spacing",
        }
    }
}

/// One refinement level: a spacing and the error measured with it.
#[derive(Clone, Debug, PartialEq)]
pub struct Level {
    /// Cell size, time step or particle spacing, whichever is refined; not a number of cells.
    pub h: f64,
    /// Norm of the error on the level.
    pub error: f64,
    /// False for a level that is reported but does not count, such as a level on which particles
    /// change their cell, if the theory does not cover this.
    pub usable: bool,
    /// Reason for the failure of the run, if it failed.
    pub failed: Option<String>,
}

impl Level {
    /// Creates a level that counts.
    pub fn new(h: f64, error: f64) -> Self {
        Self { h, error, usable: true, failed: None }
    }

    /// Marks the level as reported but not counted.
    #[must_use]
    pub fn unusable(self) -> Self {
        Self { usable: false, ..self }
    }

    /// Marks the level as failed for `reason`.
    #[must_use]
    pub fn failing(self, reason: impl Into<String>) -> Self {
        Self { failed: Some(reason.into()), ..self }
    }

    /// Returns the defect that makes the level invalid, even if the level does not count.
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

/// Sorts levels from coarse to fine and merges identical ones. A merged level counts only if all
/// the identical levels count. The diagnostic names the first defect that makes the series invalid.
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

/// Computes the observed order between two levels, with its sign and with the actual ratio of `h`:
///
/// ```text
/// p = ln(error_coarse / error_fine) / ln(h_coarse / h_fine)
/// ```
///
/// The order is negative if the error grows under refinement. `None` if a number is zero, negative
/// or not finite, or if the spacings are equal.
pub fn observed_order(coarse: &Level, fine: &Level) -> Option<f64> {
    let fall = logarithm(coarse.error)? - logarithm(fine.error)?;
    let ratio = logarithm(coarse.h)? - logarithm(fine.h)?;
    let order = fall / ratio;
    order.is_finite().then_some(order)
}

/// Computes the order between each level and the previous one; `None` for the first level.
pub(crate) fn pairwise(levels: &[Level]) -> Vec<Option<f64>> {
    let pairs = levels.windows(2);
    let orders = pairs.map(|pair| observed_order(&pair[0], &pair[1]));
    levels.first().map(|_| None).into_iter().chain(orders).collect()
}

fn logarithm(x: f64) -> Option<f64> {
    (x > 0.0 && x.is_finite()).then(|| libm::log(x))
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
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

    #[rstest]
    #[case::halved((2.0, 4.0), (1.0, 1.0), 2.0)]
    #[case::growing_keeps_its_sign((2.0, 1.0), (1.0, 4.0), -2.0)]
    #[case::true_ratio((3.0, 9.0), (2.0, 4.0), 2.0)]
    #[case::flat((2.0, 1.0), (1.0, 1.0), 0.0)]
    fn orders(#[case] coarse: (f64, f64), #[case] fine: (f64, f64), #[case] expected: f64) {
        let levels = [coarse, fine].map(|(h, error)| Level::new(h, error));
        let orders = pairwise(&levels);
        assert_eq!(orders[0], None);
        assert_relative_eq!(orders[1].unwrap(), expected, max_relative = 1e-14);
    }

    #[test]
    fn no_order_without_a_positive_figure() {
        let level = Level::new(2.0, 1.0);
        for figure in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(observed_order(&level, &Level::new(1.0, figure)), None, "{figure}");
            assert_eq!(observed_order(&level, &Level::new(figure, 1.0)), None, "{figure}");
        }
        assert_eq!(observed_order(&level, &level), None);
        assert!(pairwise(&[]).is_empty());
    }
}
