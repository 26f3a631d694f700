//! The hypothesis that is tested on a series of errors.

use crate::verify::{Axis, format_number};

/// A theoretical order, and the range in which the observed order must lie.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrderHypothesis {
    /// Theoretical order of the method.
    pub formal_order: f64,
    /// Range for the observed order; `None` for `formal_order` -+ [`OrderHypothesis::TOLERANCE`].
    pub expected: Option<(f64, f64)>,
    /// Axis of refinement. The axis determines only the name of the spacing in texts.
    pub axis: Axis,
}

impl OrderHypothesis {
    /// Maximum distance of the observed order from the formal one if no range is given: a fifth of
    /// 0.5, the typical distance between the orders of two methods.
    pub const TOLERANCE: f64 = 0.1;

    /// Maximum width of a range. A wider range could not distinguish neighbouring integer orders.
    pub const WIDEST: f64 = 1.0;

    /// Creates the hypothesis of a formal order with the default tolerance.
    pub const fn formal(order: f64) -> Self {
        Self { formal_order: order, expected: None, axis: Axis::Space }
    }

    /// Creates the hypothesis of a formal order with the range from `low` to `high`.
    pub const fn within(order: f64, low: f64, high: f64) -> Self {
        Self { formal_order: order, expected: Some((low, high)), axis: Axis::Space }
    }

    /// Replaces the axis of refinement.
    #[must_use]
    pub const fn over(self, axis: Axis) -> Self {
        Self { axis, ..self }
    }

    /// Returns the range in which the observed order must lie.
    pub fn range(&self) -> (f64, f64) {
        let formal = self.formal_order;
        let usual = (formal - Self::TOLERANCE, formal + Self::TOLERANCE);
        self.expected.unwrap_or(usual)
    }

    /// Returns the reason why this hypothesis cannot be tested: an invalid or very wide range.
    pub fn diagnostic(&self) -> Option<String> {
        let (low, high) = self.range();
        let orders = [self.formal_order, low, high];
        let positive = orders.iter().all(|p| p.is_finite() && *p > 0.0);
        let (from, to) = (format_number(low), format_number(high));
        if !(positive && low <= high) {
            return Some(format!("[{from}, {to}] is not a range of orders"));
        }
        let telling = high - low <= Self::WIDEST * (1.0 + f64::EPSILON);
        (!telling)
            .then(|| format!("the expected range [{from}, {to}] is too wide to test anything"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    #[rstest]
    #[case(OrderHypothesis::formal(2.0))]
    #[case(OrderHypothesis::within(2.0, 1.6, 2.6))]
    #[case(OrderHypothesis::within(2.0, 2.0, 2.0))]
    #[case::as_wide_as_may_be(OrderHypothesis::within(2.0, 1.5, 2.5))]
    fn testable(#[case] hypothesis: OrderHypothesis) {
        assert_eq!(hypothesis.diagnostic(), None);
    }

    #[rstest]
    #[case(OrderHypothesis::formal(f64::NAN), "[NaN, NaN] is not a range of orders")]
    #[case(OrderHypothesis::formal(0.0), "[-0.1, 0.1] is not a range of orders")]
    #[case(OrderHypothesis::within(2.0, 2.1, 1.9), "[2.1, 1.9] is not a range of orders")]
    #[case(OrderHypothesis::within(2.0, 1.0, f64::INFINITY), "[1, inf] is not a range of orders")]
    #[case(OrderHypothesis::within(60.0, 10.0, 110.0), "too wide to test anything")]
    #[case(OrderHypothesis::within(2.0, 1.4, 2.5), "too wide to test anything")]
    fn not_testable(#[case] hypothesis: OrderHypothesis, #[case] expected: &str) {
        let diagnostic = hypothesis.diagnostic().unwrap();
        assert!(diagnostic.contains(expected), "{diagnostic}");
    }
}
