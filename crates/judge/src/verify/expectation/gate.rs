//! Requirements of `run --gate` on external solvers.
//!
//! The expectations of a suite bound the order of its own methods on both sides. The order of an
//! external solver has a lower bound only, because it may be superconvergent at its sample points.
//! The 95 % interval must reach this bound and exclude orders lower by 0.5, the typical effect of a
//! defect. The interval may extend below the bound, because with few levels it extends 0.1 or more
//! to each side even for a correct solver.

use crate::verify::{
    Axis, FEWEST_LEVELS, Interval, Judgement, Level, OrderHypothesis, Unmet, UnmetCode, Verdict,
    format_number, judge, rounded,
};

/// Loss of order that a typical defect causes.
const FAULT: f64 = 0.5;

/// Minimum number of levels within a bound that no `any_method` and no configuration states, if
/// coarser levels exceed the bound.
const FEWEST_WITHIN: usize = 2;

/// Maximum excess of the observed order over the required order without a remark.
const MOST_EXCESS: f64 = 1.0;

/// Treatment of an external solver's case by `run --gate`.
#[derive(Debug, Clone, PartialEq)]
pub enum Gating {
    /// The case has a requirement.
    Required(Requirement),
    /// The case runs without requirement, for this reason.
    NotGated(String),
    /// The case does not run, for this reason given by the solver's author.
    Excepted(String),
}

/// A required order, a bound on errors, or both. It is sufficient to meet one of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Requirement {
    /// Required order, from which [`OrderHypothesis::TOLERANCE`] is subtracted.
    pub order: Option<f64>,
    /// Bound at or below which errors are accepted without an order.
    pub error_below: Option<f64>,
    /// Bound on the errors of the suite's own methods, if no other bound is given. It may accept a
    /// method with too few levels for an order, but it rejects no method.
    pub own_error_below: Option<f64>,
    /// The reason, in one line.
    pub because: String,
}

/// Reason why a requirement is met.
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
    /// Returns the verdict as text: `converging` only if the judge confirms the order.
    pub(crate) fn verdict(self, judged: Verdict) -> String {
        match self {
            Self::Order if judged == Verdict::Converging => judged.to_string(),
            Self::Order => "order reached".to_owned(),
            Self::Bound => "within bounds".to_owned(),
            Self::Rounding => "at rounding".to_owned(),
        }
    }
}

/// Result of checking a requirement.
#[derive(Debug, Clone, PartialEq)]
pub struct GateResult {
    /// Reason why the requirement is met, or the unmet requirement.
    pub result: Result<Acceptance, Unmet>,
    /// Remark that a shorter time step restored the order; `None` without such a step.
    pub remark: Option<String>,
    /// Bound at or below which errors count as rounding errors, in the unit of the judged error.
    pub rounding: f64,
}

impl Requirement {
    fn lowest(&self) -> Option<f64> {
        self.order.map(|order| order - OrderHypothesis::TOLERANCE)
    }

    /// Returns the requirement in one line.
    pub fn summary(&self) -> String {
        let order = self.lowest().map(|order| format!("order at least {order:.2}"));
        let bound = self.bound().map(|bound| format!("errors at most {:e}", rounded(bound, 4)));
        let parts: Vec<String> = [order, bound].into_iter().flatten().collect();
        parts.join(", or ")
    }

    fn bound(&self) -> Option<f64> {
        self.error_below.or(self.own_error_below)
    }

    /// Returns the reason why these levels cannot test the requirement; `None` if they can. The
    /// failure of a level is never such a reason, because the gate rejects failures.
    pub(crate) fn untestable(&self, levels: &[Level]) -> Option<String> {
        let has_failed =
            levels.iter().any(|level| level.failed.is_some() || !level.error.is_finite());
        let is_within = |bound: f64| levels.iter().all(|level| level.error <= bound);
        let is_testable = levels.len() >= FEWEST_LEVELS
            || self.error_below.is_some()
            || self.own_error_below.is_some_and(|bound| has_failed || is_within(bound));
        if is_testable {
            return None;
        }
        let count = levels.len();
        let count = if count == 1 { "one level".to_owned() } else { format!("{count} levels") };
        let own = self.own_error_below.map_or(String::new(), |bound| {
            format!(
                "; only the suite's own methods must have errors at most {:e}",
                rounded(bound, 4)
            )
        });
        Some(format!("{count}, and an order needs {FEWEST_LEVELS}{own}"))
    }

    /// Returns the reason why the errors of `levels` meet the requirement. `judgement` is the
    /// judgement of the levels, `rounding` the error due to rounding.
    ///
    /// # Errors
    /// One line with the requirement and the measured result.
    pub fn check(
        &self,
        levels: &[Level],
        axis: Axis,
        judgement: &Judgement,
        rounding: f64,
    ) -> Result<Acceptance, Unmet> {
        let counted: Vec<&Level> = levels.iter().filter(|level| level.usable).collect();
        let is_complete = counted.iter().all(|level| level.error.is_finite());
        if judgement.verdict == Verdict::Failed || !is_complete {
            return Err(Unmet::new(UnmetCode::RunFailed, "expected every level to run to its end"));
        }
        let bound = self.bound();
        let accepted = bound.unwrap_or(0.0).max(rounding);
        let above = counted.iter().take_while(|level| !(level.error <= accepted)).count();
        let (coarse, fine) = counted.split_at(above);
        let is_stated = self.error_below.is_some_and(|bound| fine.iter().all(|l| l.error <= bound));
        let fewest = if is_stated || above == 0 { 1 } else { FEWEST_WITHIN };
        let ends_within = fine.len() >= fewest && fine.iter().all(|level| level.error <= accepted);
        let is_met = ends_within
            && match above {
                0 => true,
                // Too few coarse levels for an order may be pre-asymptotic. Without a bound, their
                // errors must decrease down to the rounding error.
                1..FEWEST_LEVELS => bound.is_some() || self.falls(coarse),
                _ => {
                    let coarse: Vec<Level> = coarse.iter().map(|level| (*level).clone()).collect();
                    self.has_order(&judge(&coarse, &self.hypothesis(axis)))
                }
            };
        if is_met {
            let is_rounding = counted.iter().all(|level| level.error <= rounding);
            return Ok(if is_rounding { Acceptance::Rounding } else { Acceptance::Bound });
        }
        let ends = counted.first().zip(counted.last());
        if ends.is_some_and(|(first, last)| last.error < first.error) && self.has_order(judgement) {
            return Ok(Acceptance::Order);
        }
        let mut unmet = self.unmet(judgement, &counted);
        let within = counted.iter().filter(|level| level.error <= rounding).count();
        if within > 0 {
            unmet += &format!("; {}", rounding_remark(rounding, within, counted.len()));
        }
        let code = match self.order {
            Some(_) => UnmetCode::OrderTooLow,
            None => UnmetCode::BoundExceeded,
        };
        Err(Unmet::new(code, unmet))
    }

    /// Whether errors decrease from level to level, in total with about the lowest accepted order.
    fn falls(&self, levels: &[&Level]) -> bool {
        let (Some(lowest), [first, .., last]) = (self.lowest_low(), levels) else {
            return levels.len() == 1;
        };
        let is_steady = levels.windows(2).all(|pair| pair[1].error < pair[0].error);
        is_steady && first.error / last.error >= libm::pow(first.h / last.h, lowest)
    }

    /// Returns a remark if the whole interval of the order is over 1 above the required order.
    pub(crate) fn excess(&self, judgement: &Judgement) -> Option<String> {
        let (required, order) = (self.order?, judgement.order?);
        let is_far = order.low > required + MOST_EXCESS;
        let required = format_number(required);
        is_far.then(|| {
            format!(
                "the observed order is more than {MOST_EXCESS} above the required order {required}; \
                 the gate accepts this, but it is no evidence of that order"
            )
        })
    }

    pub(crate) fn hypothesis(&self, axis: Axis) -> OrderHypothesis {
        OrderHypothesis::formal(self.order.unwrap_or(2.0)).over(axis)
    }

    /// Whether the 95 % interval of the order reaches the lowest accepted order, and excludes
    /// orders that are lower by 0.5 or by half.
    fn has_order(&self, judgement: &Judgement) -> bool {
        use Verdict::{Converging, PreAsymptotic, TooGood, TooLow};
        let (Some(lowest), Some(order)) = (self.lowest(), judgement.order) else { return false };
        let falls = matches!(judgement.verdict, Converging | TooGood | PreAsymptotic | TooLow);
        falls && order.high >= lowest && self.lowest_low().is_some_and(|low| order.low >= low)
    }

    /// Returns the minimum of the lower end of the interval of the order.
    fn lowest_low(&self) -> Option<f64> {
        self.lowest().map(|lowest| (lowest - FAULT).max(0.5 * lowest))
    }

    fn unmet(&self, judgement: &Judgement, counted: &[&Level]) -> String {
        let largest = counted.iter().map(|level| level.error).reduce(crate::verify::larger);
        let largest = largest.map_or("none".to_owned(), format_number);
        let order = judgement.order.map_or("none".to_owned(), |order: Interval| order.shown());
        let verdict = judgement.verdict;
        let observed = match (self.order, self.bound()) {
            (Some(_), None) => format!("`{verdict}` with the order {order}"),
            (None, _) => format!("a largest error of {largest}"),
            _ => format!("`{verdict}` with the order {order} and a largest error of {largest}"),
        };
        format!("expected {}, got {observed}", self.summary())
    }
}

pub(crate) fn rounding_remark(bound: f64, within: usize, levels: usize) -> String {
    let bound = rounded(bound, 2);
    format!("errors at most {bound:e} count as rounding: {within} of {levels} levels")
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    fn levels(errors: &[f64]) -> Vec<Level> {
        let h = |k: usize| libm::exp2(-(k as f64));
        errors.iter().enumerate().map(|(k, error)| Level::new(h(k), *error)).collect()
    }

    fn requirement(order: Option<f64>, error_below: Option<f64>) -> Requirement {
        Requirement { order, error_below, own_error_below: None, because: String::new() }
    }

    fn check(order: Option<f64>, bound: Option<f64>, errors: &[f64]) -> Result<Acceptance, Unmet> {
        let requirement = requirement(order, bound);
        let levels = levels(errors);
        let judgement = judge(&levels, &requirement.hypothesis(Axis::Space));
        requirement.check(&levels, Axis::Space, &judgement, 1e-14)
    }

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

    /// For the required order 2 the interval must reach 1.9 and exclude 1.4. For the required order
    /// 0.8 it must reach 0.7 and exclude 0.35.
    #[rstest]
    #[case::just_inside(2.0, Verdict::TooLow, (1.41, 1.91), true, false)]
    #[case::below_the_lowest(2.0, Verdict::TooLow, (1.5, 1.89), false, false)]
    #[case::half_an_order_lower(2.0, Verdict::Converging, (1.39, 2.3), false, false)]
    #[case::low_order(0.8, Verdict::PreAsymptotic, (0.36, 0.71), true, false)]
    #[case::half_of_a_low_order(0.8, Verdict::PreAsymptotic, (0.34, 0.71), false, false)]
    #[case::at_a_floor(2.0, Verdict::AtFloor, (1.95, 2.05), false, false)]
    #[case::one_above(2.0, Verdict::TooGood, (2.99, 3.2), true, false)]
    #[case::more_than_one_above(2.0, Verdict::TooGood, (3.01, 3.2), true, true)]
    fn an_interval_reaches_the_order_and_excludes_half_an_order_less(
        #[case] order: f64,
        #[case] verdict: Verdict,
        #[case] (low, high): (f64, f64),
        #[case] is_met: bool,
        #[case] is_excess: bool,
    ) {
        let (required, levels) = (requirement(Some(order), None), levels(&of_order(1.0, 5)));
        let judgement = judge(&levels, &required.hypothesis(Axis::Space));
        let order = Some(Interval { value: 0.5 * (low + high), low, high });
        let judgement = Judgement { verdict, order, ..judgement };
        let met = required.check(&levels, Axis::Space, &judgement, 1e-14);
        assert_eq!(met.is_ok(), is_met, "{met:?}");
        assert_eq!(required.excess(&judgement).is_some(), is_excess);
    }

    #[rstest]
    #[case::rounding(&[1e-15, 3e-15, 9e-15, 1e-14], Some(Acceptance::Rounding))]
    #[case::rounding_that_grows_above(&[1e-15, 3e-15, 9e-15, 1e-12], None)]
    #[case::exact(&[0.0, 0.0, 0.0, 0.0], Some(Acceptance::Rounding))]
    #[case::rounding_on_the_last_level(&[0.9, 0.8, 0.7, 1e-15], None)]
    #[case::zero_on_the_last_level(&[0.9, 0.8, 0.7, 0.0], None)]
    #[case::coarse_levels_without_an_order(&[0.9, 0.8, 1e-15, 1e-15], None)]
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
    #[case::a_rise_on_coarse_levels(&[1.7e-3, 2.4e-3, 1.3e-3, 8.1e-4], Some(Acceptance::Bound))]
    #[case::a_rise_above_the_bound(&[1e-4, 2e-3], None)]
    #[case::a_floor_behind_a_lower_order(&[0.016, 0.008, 0.004, 0.002, 1e-3, 9e-4, 9e-4], None)]
    fn a_bound_needs_no_order(#[case] errors: &[f64], #[case] met: Option<Acceptance>) {
        assert_eq!(check(Some(2.0), Some(1e-3), errors).ok(), met);
    }

    #[test]
    fn a_bound_alone_is_not_met_by_an_order() {
        let message = check(None, Some(1e-3), &of_order(2.0, 4)).unwrap_err().to_string();
        assert_eq!(message, "expected errors at most 1e-3, got a largest error of 1");
    }

    #[test]
    fn message_contains_requirement_and_observation() {
        let message = check(Some(2.0), Some(1e-9), &of_order(1.0, 5)).unwrap_err().to_string();
        let expected = "expected order at least 1.90, or errors at most 1e-9, got `too low` with \
                        the order 1.00 [1.00, 1.00] and a largest error of 1";
        assert_eq!(message, expected);
    }

    #[test]
    fn an_order_needs_four_levels() {
        let of_order_2 = requirement(Some(2.0), None);
        let untestable = |required: &Requirement, errors: &[f64]| {
            required.untestable(&levels(errors)).unwrap_or_default()
        };
        assert_eq!(untestable(&of_order_2, &[1.0]), "one level, and an order needs 4");
        assert_eq!(untestable(&of_order_2, &[1.0; 3]), "3 levels, and an order needs 4");
        assert_eq!(untestable(&of_order_2, &[1.0; 4]), "");
        assert_eq!(untestable(&requirement(Some(2.0), Some(1e-3)), &[1.0]), "");
    }

    /// Other methods need not satisfy a bound on the suite's own methods.
    #[rstest]
    #[case::within(&[1e-13], "")]
    #[case::above(&[0.2], "one level, and an order needs 4; only the suite's own methods must have errors at most 1e-12")]
    #[case::not_a_number(&[f64::NAN], "")]
    #[case::enough_levels(&[0.2; 4], "")]
    fn bound_on_own_methods_never_rejects(#[case] errors: &[f64], #[case] reason: &str) {
        let required = Requirement { own_error_below: Some(1e-12), ..requirement(Some(2.0), None) };
        assert_eq!(required.untestable(&levels(errors)).unwrap_or_default(), reason);
    }
}
