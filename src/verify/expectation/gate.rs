//! Requirements of `run --gate` on external solvers.
//!
//! The expectations of a suite describe its own methods, from both sides: an order that is too high
//! shows a defect of the suite. An external solver is held to a lower bound of the order only,
//! because superconvergence at its sample points is no fault. The 95 % interval of the order must
//! reach this bound, and must exclude orders that are lower by a half, as faults make them. The
//! interval need not be above the bound as a whole: a few levels leave a sound solver an interval
//! of 0.1 and more to each side.

use crate::verify::order::axis::Axis;
use crate::verify::order::fit::Interval;
use crate::verify::order::format_number::{format_number, rounded};
use crate::verify::order::hypothesis::OrderHypothesis;
use crate::verify::order::level::Level;
use crate::verify::order::window::FEWEST_LEVELS;
use crate::verify::verdict::judge::{Judgement, judge};
use crate::verify::verdict::name::Verdict;

/// Loss of order that a fault causes at least.
const FAULT: f64 = 0.5;

/// How `run --gate` treats a case of an external solver.
#[derive(Debug, Clone, PartialEq)]
pub enum Gating {
    /// The case must meet a requirement.
    Required(Requirement),
    /// The case runs and nothing is required, for this reason.
    NotGated(String),
    /// The case does not run, for this reason of the solver's author.
    Excepted(String),
}

/// An order or a bound on errors; either is enough.
#[derive(Debug, Clone, PartialEq)]
pub struct Requirement {
    /// Order that is required, less [`OrderHypothesis::TOLERANCE`].
    pub order: Option<f64>,
    /// Errors at or below this bound are accepted without an order.
    pub error_below: Option<f64>,
    /// The reason, in one line.
    pub because: String,
}

/// Reason for which a requirement is met.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Acceptance {
    /// The order is at least the required one.
    Order,
    /// The errors are within the bound.
    Bound,
    /// The errors are rounding errors.
    Rounding,
}

impl Acceptance {
    /// The verdict in words; an observed order keeps that of the judge.
    pub(crate) fn verdict(self, judged: Verdict) -> String {
        match self {
            Self::Order if judged == Verdict::Converging => judged.to_string(),
            Self::Order => "order reached".to_owned(),
            Self::Bound => "within bounds".to_owned(),
            Self::Rounding => "at rounding".to_owned(),
        }
    }
}

/// Result of a requirement.
#[derive(Debug, Clone, PartialEq)]
pub struct GateResult {
    /// The reason for which it is met; otherwise what was required and what was observed.
    pub result: Result<Acceptance, String>,
    /// A remark on time steps that restored the order.
    pub remark: Option<String>,
}

impl Requirement {
    /// Lowest order that is accepted.
    fn lowest(&self) -> Option<f64> {
        self.order.map(|order| order - OrderHypothesis::TOLERANCE)
    }

    /// The requirement in one line.
    pub fn summary(&self) -> String {
        let order = self.lowest().map(|order| format!("order at least {order:.2}"));
        let bound = self.error_below.map(|bound| format!("errors at most {:e}", rounded(bound, 4)));
        let parts: Vec<String> = [order, bound].into_iter().flatten().collect();
        parts.join(", or ")
    }

    /// Why so many levels cannot show what is required, if they cannot.
    pub(crate) fn untestable(&self, levels: usize) -> Option<String> {
        let is_testable = self.error_below.is_some() || levels >= FEWEST_LEVELS;
        let levels = if levels == 1 { "one level".to_owned() } else { format!("{levels} levels") };
        (!is_testable).then(|| format!("{levels}, and an order needs {FEWEST_LEVELS}"))
    }

    /// How the requirement is met by the errors of `levels`, given the judgement of them and the
    /// error that rounding explains.
    ///
    /// # Errors
    /// One line that says what was required and what was observed.
    pub fn check(
        &self,
        levels: &[Level],
        axis: Axis,
        judgement: &Judgement,
        rounding: f64,
    ) -> Result<Acceptance, String> {
        if judgement.verdict == Verdict::Failed {
            return Err("expected every level to run to its end".to_owned());
        }
        let counted: Vec<&Level> = levels.iter().filter(|level| level.usable).collect();
        let accepted = self.error_below.unwrap_or(0.0).max(rounding);
        let above = counted.iter().take_while(|level| !(level.error <= accepted)).count();
        let (coarse, fine) = counted.split_at(above);
        let ends_within = !fine.is_empty() && fine.iter().all(|level| level.error <= accepted);
        let is_met = ends_within
            && match above {
                0 => true,
                // Too few for an order: the errors must fall until they are within the bound.
                1..FEWEST_LEVELS => coarse.windows(2).all(|pair| pair[1].error <= pair[0].error),
                _ => {
                    let coarse: Vec<Level> = coarse.iter().map(|level| (*level).clone()).collect();
                    self.has_order(&judge(&coarse, &self.hypothesis(axis)))
                }
            };
        if is_met {
            let is_rounding = counted.iter().all(|level| level.error <= rounding);
            return Ok(if is_rounding { Acceptance::Rounding } else { Acceptance::Bound });
        }
        if self.has_order(judgement) {
            return Ok(Acceptance::Order);
        }
        Err(self.unmet(judgement, &counted))
    }

    /// The hypothesis that the judge tests.
    pub(crate) fn hypothesis(&self, axis: Axis) -> OrderHypothesis {
        OrderHypothesis::formal(self.order.unwrap_or(2.0)).over(axis)
    }

    /// Whether the 95 % interval of the order reaches the lowest order that is accepted, and
    /// excludes orders that are lower by a half, and zero.
    fn has_order(&self, judgement: &Judgement) -> bool {
        use Verdict::{Converging, PreAsymptotic, TooGood, TooLow};
        let (Some(lowest), Some(order)) = (self.lowest(), judgement.order) else { return false };
        let falls = matches!(judgement.verdict, Converging | TooGood | PreAsymptotic | TooLow);
        falls && order.high >= lowest && order.low >= (lowest - FAULT).max(0.5 * lowest)
    }

    fn unmet(&self, judgement: &Judgement, counted: &[&Level]) -> String {
        let largest = counted.iter().map(|level| level.error).reduce(crate::verify::larger);
        let largest = largest.map_or("none".to_owned(), format_number);
        let order = judgement.order.map_or("none".to_owned(), |order: Interval| order.shown());
        let verdict = judgement.verdict;
        let observed = match (self.order, self.error_below) {
            (Some(_), None) => format!("`{verdict}` with the order {order}"),
            (None, _) => format!("a largest error of {largest}"),
            _ => format!("`{verdict}` with the order {order} and a largest error of {largest}"),
        };
        format!("expected {}, got {observed}", self.summary())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    fn levels(errors: &[f64]) -> Vec<Level> {
        let h = |k: usize| libm::exp2(-(k as f64));
        errors.iter().enumerate().map(|(k, error)| Level::new(h(k), *error)).collect()
    }

    fn check(order: Option<f64>, bound: Option<f64>, errors: &[f64]) -> Result<Acceptance, String> {
        let requirement = Requirement { order, error_below: bound, because: String::new() };
        let levels = levels(errors);
        let judgement = judge(&levels, &requirement.hypothesis(Axis::Space));
        requirement.check(&levels, Axis::Space, &judgement, 1e-14)
    }

    /// Errors of the order `p`, on so many levels.
    fn of_order(p: f64, count: i32) -> Vec<f64> {
        (0..count).map(|k| libm::exp2(-p * f64::from(k))).collect()
    }

    #[rstest]
    #[case::the_order(2.0, Some(Acceptance::Order))]
    #[case::a_better_order(4.0, Some(Acceptance::Order))]
    #[case::nearly_the_order(1.91, Some(Acceptance::Order))]
    #[case::a_lower_order(1.89, None)]
    #[case::no_order(0.0, None)]
    #[case::growing_errors(-1.0, None)]
    fn the_order_has_a_lower_bound_only(#[case] order: f64, #[case] met: Option<Acceptance>) {
        assert_eq!(check(Some(2.0), None, &of_order(order, 5)).ok(), met);
    }

    /// An order of 2 on five levels, with an error that is off by a factor on the finest.
    #[rstest]
    #[case::a_little_noise(1.2, Some(Acceptance::Order))]
    #[case::noise_that_hides_the_order(2.5, None)]
    fn an_uncertain_order_must_exclude_a_lost_half(
        #[case] factor: f64,
        #[case] met: Option<Acceptance>,
    ) {
        let mut errors = of_order(2.0, 5);
        errors[4] *= factor;
        errors[1] /= factor;
        assert_eq!(check(Some(2.0), None, &errors).ok(), met);
    }

    #[rstest]
    #[case::rounding(&[1e-15, 3e-15, 9e-15, 1e-14], Some(Acceptance::Rounding))]
    #[case::rounding_that_grows_above(&[1e-15, 3e-15, 9e-15, 1e-12], None)]
    #[case::exact(&[0.0, 0.0, 0.0, 0.0], Some(Acceptance::Rounding))]
    #[case::rounding_on_fine_levels(&[1e-12, 1e-13, 1e-14, 5e-15], Some(Acceptance::Bound))]
    #[case::a_rise_before_it(&[1e-12, 1e-9, 1e-14, 5e-15], None)]
    #[case::not_a_number(&[1e-15, f64::NAN, 1e-15, 1e-15], None)]
    fn rounding_needs_no_order(#[case] errors: &[f64], #[case] met: Option<Acceptance>) {
        assert_eq!(check(Some(2.0), None, errors).ok(), met);
    }

    #[rstest]
    #[case::one_level(&[1e-4], Some(Acceptance::Bound))]
    #[case::one_level_above(&[1.1e-3], None)]
    #[case::all_levels(&[1e-4, 2e-4, 1e-4, 3e-4], Some(Acceptance::Bound))]
    #[case::a_floor_behind_the_order(&[0.256, 0.064, 0.016, 0.004, 1e-3, 9e-4, 9e-4], Some(Acceptance::Bound))]
    #[case::a_floor_behind_a_lower_order(&[0.016, 0.008, 0.004, 0.002, 1e-3, 9e-4, 9e-4], None)]
    fn a_bound_needs_no_order(#[case] errors: &[f64], #[case] met: Option<Acceptance>) {
        assert_eq!(check(Some(2.0), Some(1e-3), errors).ok(), met);
    }

    #[test]
    fn a_bound_alone_is_not_met_by_an_order() {
        let message = check(None, Some(1e-3), &of_order(2.0, 4)).unwrap_err();
        assert_eq!(message, "expected errors at most 1e-3, got a largest error of 1");
    }

    #[test]
    fn the_message_has_the_requirement_and_the_observation() {
        let message = check(Some(2.0), Some(1e-9), &of_order(1.0, 5)).unwrap_err();
        let expected = "expected order at least 1.90, or errors at most 1e-9, got `too low` with \
                        the order 1.00 [1.00, 1.00] and a largest error of 1";
        assert_eq!(message, expected);
    }

    #[test]
    fn an_order_needs_four_levels() {
        let requirement =
            Requirement { order: Some(2.0), error_below: None, because: String::new() };
        assert_eq!(requirement.untestable(1).as_deref(), Some("one level, and an order needs 4"));
        assert_eq!(requirement.untestable(3).as_deref(), Some("3 levels, and an order needs 4"));
        assert_eq!(requirement.untestable(4), None);
        assert_eq!(Requirement { error_below: Some(1.0), ..requirement }.untestable(1), None);
    }
}
