//! Expectations of a stability study, one for each row.

use crate::verify::{
    Critical, RunFigure, Stability, StabilityLimit, StabilityRow, Trial, format_number,
};

/// Expectation of one row.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StabilityExpectation {
    /// Expected verdict on the run.
    pub verdict: Option<Stability>,
    /// Bounds on the stability limit.
    pub critical: Option<FigureBounds>,
    /// Bounds on measured values of the run.
    pub figures: Vec<(RunFigure, FigureBounds)>,
}

/// Bounds on a measured value; all stated bounds must hold.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct FigureBounds {
    /// Expected value, and the maximum difference, relative unless the expected value is zero.
    pub is: Option<(f64, f64)>,
    /// Minimum measured value.
    pub above: Option<f64>,
    /// Maximum measured value.
    pub below: Option<f64>,
}

impl FigureBounds {
    /// Describes the bounds that do not hold. NaN meets no bound.
    fn unmet(&self, name: &str, got: f64) -> Vec<String> {
        let mut unmet = Vec::new();
        if let Some((value, within)) = self.is {
            let scale = if value == 0.0 { 1.0 } else { value.abs() };
            let error = (got - value).abs() / scale;
            if !(error <= within) {
                unmet.push(format!(
                    "expected {name} {} within {within:e}, got {} (off by {error:.1e})",
                    format_number(value),
                    format_number(got)
                ));
            }
        }
        if let Some(least) = self.above.filter(|least| !(got >= *least)) {
            unmet.push(format!("expected {name} at least {least:e}, got {}", format_number(got)));
        }
        if let Some(most) = self.below.filter(|most| !(got <= *most)) {
            unmet.push(format!("expected {name} at most {most:e}, got {}", format_number(got)));
        }
        unmet
    }

    /// Describes the unmet bounds on a stability limit, which may lie outside the searched range.
    fn unmet_by_limit(&self, limit: StabilityLimit) -> Vec<String> {
        let beyond = |known: f64, holds: bool, side: &str| {
            if holds {
                Vec::new()
            } else {
                vec![format!("the limit is {side} {}", format_number(known))]
            }
        };
        match limit {
            StabilityLimit::At(value) => self.unmet("the limit", value),
            StabilityLimit::Above(high) => {
                let holds = self.is.is_none() && self.below.is_none();
                beyond(high, holds && self.above.is_some_and(|least| high >= least), "above")
            }
            StabilityLimit::Below(low) => {
                let holds = self.is.is_none() && self.above.is_none();
                beyond(low, holds && self.below.is_some_and(|most| low <= most), "below")
            }
        }
    }
}

impl StabilityExpectation {
    /// Lists the expectations that a row does not meet.
    pub fn unmet(&self, row: &StabilityRow) -> Vec<String> {
        if let Some(reason) = &row.refused {
            return vec![format!("the run could not be set up: {reason}")];
        }
        let mut unmet = Vec::new();
        if let Some(trial) = &row.trial {
            unmet.extend(self.verdict.and_then(|wanted| other_verdict(wanted, trial)));
            for (figure, wanted) in &self.figures {
                unmet.extend(wanted.unmet(figure.head(), figure.of(trial)));
            }
        }
        if let Some(critical) = &row.critical {
            unmet.extend(unconfirmed(critical));
            if let Some(wanted) = self.critical {
                match critical.limit() {
                    Some(limit) => unmet.extend(wanted.unmet_by_limit(limit)),
                    None => unmet.push("no limit was found".to_owned()),
                }
            }
        }
        unmet
    }
}

fn other_verdict(wanted: Stability, trial: &Trial) -> Option<String> {
    let why = trial.why.as_ref().map(|why| format!(": {why}")).unwrap_or_default();
    let (wanted, got) = (wanted.words(), trial.verdict.words());
    (wanted != got).then(|| format!("expected {wanted}, got {got}{why}"))
}

fn unconfirmed(critical: &Critical) -> Vec<String> {
    let Some(prediction) = &critical.predicted else { return Vec::new() };
    let disagrees = |(share, trial): &(f64, Trial)| {
        let should_hold = *share <= 1.0 && !matches!(prediction.limit, StabilityLimit::Below(_));
        let agrees = match trial.verdict {
            Stability::Stable => should_hold,
            Stability::BoundedGrowth => false,
            Stability::Unstable | Stability::Failed => !should_hold,
        };
        (!agrees).then(|| {
            let word = trial.verdict.words();
            format!("a run at {share} of the predicted limit is {word} after {} steps", trial.steps)
        })
    };
    critical.confirmed.iter().filter_map(disagrees).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    fn bounds(above: Option<f64>, below: Option<f64>, is: Option<(f64, f64)>) -> FigureBounds {
        FigureBounds { is, above, below }
    }

    /// For a limit outside the searched range, only a lower or upper bound is known.
    #[rstest]
    #[case::far_enough(bounds(Some(9.0), None, None), true)]
    #[case::not_far_enough(bounds(Some(11.0), None, None), false)]
    #[case::bounded(bounds(Some(9.0), Some(99.0), None), false)]
    #[case::a_value(bounds(Some(9.0), None, Some((9.0, 0.5))), false)]
    #[case::anything(FigureBounds::default(), false)]
    fn a_limit_above_the_range(#[case] bounds: FigureBounds, #[case] holds: bool) {
        let unmet = bounds.unmet_by_limit(StabilityLimit::Above(10.0));
        assert_eq!(unmet, if holds { vec![] } else { vec!["the limit is above 10"] });
        // A limit below a range that begins at 1/10 obeys these relations in reverse.
        let inverse = FigureBounds {
            above: bounds.below.map(f64::recip),
            below: bounds.above.map(f64::recip),
            ..bounds
        };
        let unmet = inverse.unmet_by_limit(StabilityLimit::Below(0.1));
        assert_eq!(unmet, if holds { vec![] } else { vec!["the limit is below 0.1"] });
    }

    #[test]
    fn bounds_on_a_limit_in_the_range_are_reported_with_both_values() {
        let all = bounds(Some(3e-6), Some(1e-6), Some((4e-6, 0.25)));
        assert_eq!(
            all.unmet_by_limit(StabilityLimit::At(2e-6)),
            [
                "expected the limit 4e-6 within 2.5e-1, got 2e-6 (off by 5.0e-1)",
                "expected the limit at least 3e-6, got 2e-6",
                "expected the limit at most 1e-6, got 2e-6",
            ]
        );
        assert!(bounds(Some(2e-6), Some(2e-6), None).unmet("", 2e-6).is_empty());
    }

    /// A deviation of 13 % from a small value does not meet a relative bound of 0.1 %.
    #[rstest]
    #[case(0.007, 0.0079, false)]
    #[case(0.007, 0.007_000_5, true)]
    #[case(7e6, 7.9e6, false)]
    #[case(-0.007, -0.007_000_5, true)]
    #[case(0.0, 0.0005, true)]
    #[case(0.0, 0.002, false)]
    #[case(0.007, f64::NAN, false)]
    #[case(f64::NAN, 0.007, false)]
    fn a_deviation_is_relative(#[case] value: f64, #[case] got: f64, #[case] holds: bool) {
        let bounds = FigureBounds { is: Some((value, 1e-3)), ..FigureBounds::default() };
        assert_eq!(bounds.unmet("value", got).is_empty(), holds);
    }
}
