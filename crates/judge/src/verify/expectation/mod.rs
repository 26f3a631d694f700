//! Expectations of a suite for a case, and the check whether a case meets them.

pub(crate) mod advice;
pub(crate) mod gate;
pub(crate) mod limits;
pub(crate) mod proposal;
pub(crate) mod unmet;

use super::expectation::limits::{Limits, Measured, UnmetFigure};
use super::expectation::unmet::{Unmet, UnmetCode};
use crate::verify::{FloorCause, OrderHypothesis, Verdict};

/// Lower and upper bound. A value may equal either bound.
pub type Bounds = (f64, f64);

/// An expectation of a suite for a case. All fields that are set must hold. A case that is expected
/// to fail but passes is an error too.
#[derive(Debug, Clone, PartialEq)]
pub struct Expectation {
    /// The expected verdict; `None` for a case with limits only.
    pub verdict: Option<Verdict>,
    /// Bounds that must contain the whole confidence interval of the observed order.
    pub order: Option<Bounds>,
    /// Bounds on the order between the two finest levels.
    pub finest_pair: Option<Bounds>,
    /// `true` if particles must change their cell on the finest level, `false` if they must not.
    pub crossings: Option<bool>,
    /// Bounds on measured values.
    pub limits: Limits,
    /// Expected cause of the error floor.
    pub floor: Option<FloorCause>,
    /// The reason, in one line.
    pub because: String,
}

/// Results of a case that are compared with expectations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CaseFindings {
    /// The judge's verdict.
    pub verdict: Verdict,
    /// Confidence interval of the observed order.
    pub order: Option<Bounds>,
    /// Order between the two finest levels.
    pub finest_pair: Option<f64>,
    /// Number of times that a particle changed its cell on the finest level.
    pub crossings: Option<u64>,
    /// Measured values that limits are compared with.
    pub measured: Measured,
    /// Cause of the error floor, if it was requested and could be determined.
    pub floor: Option<FloorCause>,
}

impl Expectation {
    /// Expects convergence with order `p`, within [`OrderHypothesis::TOLERANCE`].
    pub fn of_order(p: f64, because: &str) -> Self {
        let around = (p - OrderHypothesis::TOLERANCE, p + OrderHypothesis::TOLERANCE);
        Self {
            verdict: Some(Verdict::Converging),
            order: Some(around),
            finest_pair: None,
            crossings: None,
            limits: Limits::default(),
            floor: None,
            because: because.to_owned(),
        }
    }

    /// Returns all unmet expectations.
    pub fn unmet(&self, found: &CaseFindings) -> Vec<Unmet> {
        let judged = self.unmet_judgement(found);
        // A failed run has no measured values, and its failure is already reported.
        let failed = judged.is_some() && found.verdict == Verdict::Failed;
        let figures = self.unmet_figures(found).into_iter();
        let told = figures.filter(|figure| figure.measured || !failed);
        judged.into_iter().chain(told.map(|figure| figure.unmet)).collect()
    }

    fn unmet_judgement(&self, found: &CaseFindings) -> Option<Unmet> {
        let verdict = self.verdict.filter(|verdict| found.verdict != *verdict);
        let holds = |bounds: &Bounds| {
            found.order.is_some_and(|(low, high)| within(low, *bounds) && within(high, *bounds))
        };
        let order = self.order.filter(|bounds| !holds(bounds)).map(show);
        let got = || found.order.map_or("none".to_owned(), show);
        let text = match (verdict, order) {
            (Some(verdict), Some(order)) => Some(format!(
                "expected the verdict `{verdict}` with the order within {order}, got `{}` with {}",
                found.verdict,
                got()
            )),
            (Some(verdict), None) => {
                Some(format!("expected the verdict `{verdict}`, got `{}`", found.verdict))
            }
            (None, Some(order)) => {
                Some(format!("expected the order within {order}, got {}", got()))
            }
            (None, None) => (self.verdict.is_none() && found.verdict == Verdict::Failed)
                .then(|| "expected every level to run to its end".to_owned()),
        };
        text.map(|text| Unmet::new(self.code(found), text))
    }

    fn code(&self, found: &CaseFindings) -> UnmetCode {
        let is_limit = self.verdict.is_some_and(|verdict| verdict != Verdict::Converging);
        let is_equal = self.verdict.is_none_or(|verdict| verdict == found.verdict);
        match (found.verdict, self.order.zip(found.order)) {
            (Verdict::Failed, _) => UnmetCode::RunFailed,
            (Verdict::Converging, _) if is_limit => UnmetCode::LimitGone,
            (Verdict::TooLow, _) if !is_limit => UnmetCode::OrderTooLow,
            (Verdict::TooGood, _) if !is_limit => UnmetCode::OrderTooHigh,
            (_, Some(((low, _), (least, _)))) if is_equal && least < low => UnmetCode::OrderTooLow,
            (_, Some(_)) if is_equal => UnmetCode::OrderTooHigh,
            _ => UnmetCode::VerdictDiffers,
        }
    }

    fn unmet_figures(&self, found: &CaseFindings) -> Vec<UnmetFigure> {
        let mut unmet = Vec::new();
        if let Some(bounds) = self.finest_pair
            && !found.finest_pair.is_some_and(|order| within(order, bounds))
        {
            let got = found.finest_pair.map_or("none".to_owned(), |order| format!("{order:.2}"));
            let wanted = show(bounds);
            let line = format!("expected the finest pair's order within {wanted}, got {got}");
            let measured = found.finest_pair.is_some_and(|order| !order.is_nan());
            let is_high = found.finest_pair.is_some_and(|order| order > bounds.1);
            let code = if is_high { UnmetCode::OrderTooHigh } else { UnmetCode::OrderTooLow };
            unmet.push(UnmetFigure::new(code, line, measured));
        }
        if let Some(some) = self.crossings
            && found.crossings.map(|n| n > 0) != Some(some)
        {
            let wanted = if some { "some" } else { "no" };
            let got = found.crossings.map_or("none counted".to_owned(), |n| n.to_string());
            let line = format!("expected {wanted} crossings on the finest level, got {got}");
            let measured = found.crossings.is_some();
            unmet.push(UnmetFigure::new(UnmetCode::CrossingsDiffer, line, measured));
        }
        unmet.extend(self.limits.unmet(&found.measured));
        if let Some(cause) = self.floor
            && found.floor != Some(cause)
        {
            let got = found.floor.map_or("not determined", FloorCause::name);
            let line = format!("expected the floor of `{}`, got `{got}`", cause.name());
            let measured = found.floor.is_some();
            unmet.push(UnmetFigure::new(UnmetCode::FloorDiffers, line, measured));
        }
        unmet
    }

    /// Returns the expectation in one line, for reports.
    pub fn summary(&self) -> String {
        let verdict = |verdict: &Verdict| match verdict {
            Verdict::TooLow => "too low (below the theoretical order)".to_owned(),
            other => other.to_string(),
        };
        let mut parts: Vec<String> = self.verdict.iter().map(verdict).collect();
        parts.extend(self.order.map(|b| format!("order within {}", show(b))));
        parts.extend(
            self.finest_pair
                .map(|b| format!("order between the two finest levels within {}", show(b))),
        );
        parts.extend(self.crossings.map(|some| {
            format!("{} crossings on the finest level", if some { "some" } else { "no" })
        }));
        parts.extend(self.limits.summary());
        parts.extend(self.floor.map(|cause| match cause {
            FloorCause::Nothing => "floor that no single refinement lowers".to_owned(),
            _ => format!("floor caused by {}", cause.name()),
        }));
        parts.join(", ")
    }
}

/// Whether `value` is within bounds; false for NaN.
fn within(value: f64, (low, high): Bounds) -> bool {
    low <= value && value <= high
}

fn show((low, high): Bounds) -> String {
    format!("[{low:.2}, {high:.2}]")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::CaseFigure;
    use rstest::rstest;

    const SEEN: CaseFindings = CaseFindings {
        verdict: Verdict::Converging,
        order: Some((1.95, 2.05)),
        finest_pair: Some(1.99),
        crossings: Some(0),
        measured: Measured { figures: [Some(1e-3), Some(1e-6), None, None], ..Measured::NONE },
        floor: Some(FloorCause::Time),
    };

    fn expectation() -> Expectation {
        Expectation {
            verdict: Some(Verdict::Converging),
            order: Some((1.9, 2.1)),
            finest_pair: Some((1.9, 2.1)),
            crossings: Some(false),
            limits: Limits { bounds: vec![(CaseFigure::ErrorBelow, 1e-2)], ..Limits::default() },
            floor: Some(FloorCause::Time),
            because: "second-order scheme".to_owned(),
        }
    }

    #[rstest]
    #[case::all_met(SEEN, None)]
    #[case::verdict(CaseFindings { verdict: Verdict::Divergent, ..SEEN }, Some(UnmetCode::VerdictDiffers))]
    #[case::failed(CaseFindings { verdict: Verdict::Failed, ..SEEN }, Some(UnmetCode::RunFailed))]
    #[case::too_low(CaseFindings { verdict: Verdict::TooLow, ..SEEN }, Some(UnmetCode::OrderTooLow))]
    #[case::too_good(CaseFindings { verdict: Verdict::TooGood, ..SEEN }, Some(UnmetCode::OrderTooHigh))]
    #[case::interval_sticks_out_below(CaseFindings { order: Some((1.89, 2.05)), ..SEEN }, Some(UnmetCode::OrderTooLow))]
    #[case::interval_sticks_out_above(CaseFindings { order: Some((1.95, 2.11)), ..SEEN }, Some(UnmetCode::OrderTooHigh))]
    #[case::no_order(CaseFindings { order: None, ..SEEN }, Some(UnmetCode::VerdictDiffers))]
    #[case::nan_order(CaseFindings { order: Some((f64::NAN, f64::NAN)), ..SEEN }, Some(UnmetCode::OrderTooHigh))]
    #[case::nan_pair(CaseFindings { finest_pair: Some(f64::NAN), ..SEEN }, Some(UnmetCode::OrderTooLow))]
    #[case::low_pair(CaseFindings { finest_pair: Some(1.89), ..SEEN }, Some(UnmetCode::OrderTooLow))]
    #[case::high_pair(CaseFindings { finest_pair: Some(2.11), ..SEEN }, Some(UnmetCode::OrderTooHigh))]
    #[case::crossings(CaseFindings { crossings: Some(3), ..SEEN }, Some(UnmetCode::CrossingsDiffer))]
    #[case::crossings_not_counted(CaseFindings { crossings: None, ..SEEN }, Some(UnmetCode::CrossingsDiffer))]
    #[case::limit(CaseFindings { measured: Measured::NONE, ..SEEN }, Some(UnmetCode::BoundExceeded))]
    #[case::floor(CaseFindings { floor: Some(FloorCause::Nothing), ..SEEN }, Some(UnmetCode::FloorDiffers))]
    #[case::floor_not_determined(CaseFindings { floor: None, ..SEEN }, Some(UnmetCode::FloorDiffers))]
    fn every_part_must_hold(#[case] found: CaseFindings, #[case] code: Option<UnmetCode>) {
        let unmet = expectation().unmet(&found);
        let codes: Vec<UnmetCode> = unmet.iter().map(|unmet| unmet.code).collect();
        assert_eq!(codes, code.into_iter().collect::<Vec<_>>(), "{unmet:?}");
        // A limit of a method that is gone is reported as such.
        let limited = Expectation { verdict: Some(Verdict::TooLow), ..expectation() };
        let gone = limited.unmet(&found).iter().any(|unmet| unmet.code == UnmetCode::LimitGone);
        assert_eq!(gone, found.verdict == Verdict::Converging);
    }

    #[test]
    fn verdict_and_order_are_reported_in_one_line() {
        let low = CaseFindings { verdict: Verdict::TooLow, order: Some((1.5, 1.6)), ..SEEN };
        let line = "expected the verdict `converging` with the order within [1.90, 2.10], \
                    got `too low` with [1.50, 1.60]";
        assert_eq!(expectation().unmet(&low), [Unmet::new(UnmetCode::OrderTooLow, line)]);
        let none = CaseFindings { verdict: Verdict::Oscillatory, order: None, ..SEEN };
        let [line] = &expectation().unmet(&none)[..] else { panic!("several lines") };
        assert!(line.text.ends_with("got `oscillatory` with none"), "{line}");
        assert_eq!(line.code, UnmetCode::VerdictDiffers);
    }

    #[test]
    fn failure_is_reported_only_once() {
        let failed = CaseFindings {
            verdict: Verdict::Failed,
            order: None,
            finest_pair: None,
            crossings: None,
            measured: Measured::NONE,
            floor: None,
        };
        assert_eq!(expectation().unmet(&failed).len(), 1);
        let bounded = Expectation { verdict: None, order: None, ..expectation() };
        let text = "expected every level to run to its end";
        assert_eq!(bounded.unmet(&failed), [Unmet::new(UnmetCode::RunFailed, text)]);
        let wanted = Expectation { verdict: Some(Verdict::Failed), order: None, ..expectation() };
        assert_eq!(wanted.unmet(&failed).len(), 4);
        let crossed = CaseFindings { crossings: Some(3), ..failed };
        assert_eq!(expectation().unmet(&crossed).len(), 2);
    }

    #[test]
    fn without_an_expected_verdict_only_failure_is_unmet() {
        let bounded =
            Expectation { verdict: None, order: None, finest_pair: None, ..expectation() };
        assert!(bounded.unmet(&CaseFindings { verdict: Verdict::TooFewLevels, ..SEEN }).is_empty());
        assert_eq!(bounded.unmet(&CaseFindings { verdict: Verdict::Failed, ..SEEN }).len(), 1);
        let summary =
            "no crossings on the finest level, largest error at most 1e-2, floor caused by time";
        assert_eq!(bounded.summary(), summary);
    }
}
