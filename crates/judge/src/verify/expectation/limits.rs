//! Bounds on measured values. Without an expected order, one level is sufficient.

use crate::verify::{
    BoundKind, CaseFigure, ConservationError, Conserved, Unmet, UnmetCode, format_number, grouped,
    rounded,
};

/// Bounds on measured values, drifts and rates. A value may equal its bound. All bounds must hold.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Limits {
    /// Bounds on measured values, in the order of [`CaseFigure::ALL`].
    pub bounds: Vec<(CaseFigure, f64)>,
    /// Maximum relative drifts on the levels that count.
    pub drift: Vec<(Conserved, f64)>,
    /// Range of the energy rate (1/s) that must contain the whole interval on every counted level.
    pub energy_rate: Option<(f64, f64)>,
}

/// Measured values that bounds are compared with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Measured {
    /// Values of [`CaseFigure::ALL`]; `None` for a value that the levels do not have.
    pub figures: [Option<f64>; CaseFigure::ALL.len()],
    /// Largest drifts of the levels that count; `None` if the solver reports no sums over the body.
    pub drift: Option<ConservationError>,
    /// Union of the intervals of the energy rate (1/s) on the levels that count, if all have one.
    pub energy_rate: Option<(f64, f64)>,
}

impl Measured {
    /// No measured values, drifts or rates.
    pub const NONE: Self =
        Self { figures: [None; CaseFigure::ALL.len()], drift: None, energy_rate: None };

    /// Returns the measured value of `figure`.
    pub fn figure(&self, figure: CaseFigure) -> Option<f64> {
        self.figures[figure as usize]
    }
}

#[derive(Debug)]
pub(crate) struct UnmetFigure {
    pub(crate) unmet: Unmet,
    /// Whether the value was measured.
    pub(crate) measured: bool,
}

impl UnmetFigure {
    pub(crate) fn new(code: UnmetCode, text: String, measured: bool) -> Self {
        Self { unmet: Unmet::new(code, text), measured }
    }
}

struct Check {
    figure: CaseFigure,
    limit: f64,
    got: Option<f64>,
}

impl Check {
    /// Whether the bound holds; false for NaN.
    fn holds(&self) -> bool {
        self.got.is_some_and(|got| match self.figure.bound_kind() {
            BoundKind::Minimum => got >= self.limit,
            BoundKind::Maximum => got <= self.limit,
        })
    }

    fn bound(&self) -> String {
        let side = match self.figure.bound_kind() {
            BoundKind::Minimum => "at least",
            BoundKind::Maximum => "at most",
        };
        format!("{} {side} {:e}", self.figure.text(), rounded(self.limit, DIGITS))
    }

    fn got(&self) -> String {
        self.got.map_or("none".to_owned(), format_number)
    }
}

const DIGITS: usize = 4;

impl Limits {
    /// Whether there are no bounds.
    pub fn is_empty(&self) -> bool {
        *self == Self::default()
    }

    /// Returns the bound on the measured value `figure`.
    pub fn bound(&self, figure: CaseFigure) -> Option<f64> {
        self.bounds.iter().find(|(bounded, _)| *bounded == figure).map(|(_, limit)| *limit)
    }

    /// Returns the sums with a bound on their drift.
    pub fn drifts(&self) -> Vec<Conserved> {
        self.drift.iter().map(|(sum, _)| *sum).collect()
    }

    pub(crate) fn unmet(&self, measured: &Measured) -> Vec<UnmetFigure> {
        let broken = self.checks(Some(measured)).into_iter().filter(|check| !check.holds());
        let told = |check: Check| {
            let line = format!("expected {}, got {}", check.bound(), check.got());
            let measured = check.got.is_some_and(|got| !got.is_nan());
            UnmetFigure::new(UnmetCode::BoundExceeded, line, measured)
        };
        let mut unmet: Vec<UnmetFigure> = broken.map(told).collect();
        for (sum, limit) in &self.drift {
            let drift = measured.drift.map(|drift| drift.of(*sum));
            if !drift.is_some_and(|drift| drift <= *limit) {
                let (sum, got) = (sum.words(), drift.map_or("none".to_owned(), rounding));
                let line = format!(
                    "expected drift of {sum} at most {:e}, got {got}",
                    rounded(*limit, DIGITS)
                );
                let measured = drift.is_some_and(|drift| !drift.is_nan());
                unmet.push(UnmetFigure::new(UnmetCode::NotConserved, line, measured));
            }
        }
        if let Some((low, high)) = self.energy_rate {
            let got = measured.energy_rate;
            if !got.is_some_and(|(least, most)| low <= least && most <= high) {
                let measured = got.is_some_and(|(least, most)| !least.is_nan() && !most.is_nan());
                let got = got.map_or("none".to_owned(), rates);
                let line = format!("expected {}, got {got}", rate_within((low, high)));
                unmet.push(UnmetFigure::new(UnmetCode::NotConserved, line, measured));
            }
        }
        unmet
    }

    pub(crate) fn summary(&self) -> Vec<String> {
        let mut parts: Vec<String> = self.checks(None).iter().map(Check::bound).collect();
        let drifts = grouped(self.drift.iter().map(|(sum, limit)| (*limit, sum.words())));
        parts.extend(drifts.into_iter().map(|(limit, sums)| {
            format!("drift of {} at most {:e}", sums.join(", "), rounded(limit, DIGITS))
        }));
        parts.extend(self.energy_rate.map(rate_within));
        parts
    }

    /// Describes the measured values; empty without bounds.
    pub fn found(&self, measured: &Measured) -> String {
        let said = |check: &Check| format!("{} {}", check.figure.text(), check.got());
        let mut parts: Vec<String> = self.checks(Some(measured)).iter().map(said).collect();
        let drift = |sum: &Conserved| measured.drift.map_or(f64::NAN, |drift| drift.of(*sum));
        let said =
            |(sum, _): &(Conserved, f64)| format!("{} {}", sum.words(), rounding(drift(sum)));
        let drifts: Vec<String> = self.drift.iter().map(said).collect();
        if !drifts.is_empty() {
            parts.push(format!("drift of {}", drifts.join(", ")));
        }
        if self.energy_rate.is_some() {
            let got = measured.energy_rate.map_or("none".to_owned(), rates);
            parts.push(format!("rate of energy {got} 1/s"));
        }
        parts.join("; ")
    }

    fn checks(&self, measured: Option<&Measured>) -> Vec<Check> {
        let check = |&(figure, limit): &(CaseFigure, f64)| Check {
            figure,
            limit,
            got: measured.and_then(|measured| measured.figure(figure)),
        };
        self.bounds.iter().map(check).collect()
    }
}

fn rate_within(bounds: (f64, f64)) -> String {
    format!("rate of energy within {} 1/s", rates(bounds))
}

fn rates(interval: (f64, f64)) -> String {
    let (low, high) = interval;
    format!("[{}, {}]", format_number(low), format_number(high))
}

fn rounding(drift: f64) -> String {
    format!("{drift:.0e}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::conservation::Balance;
    use mpm_subject::Totals;
    use rstest::rstest;

    const NAN: f64 = f64::NAN;

    fn measured() -> Measured {
        let still = Balance::start(Totals::default()).drift();
        Measured {
            figures: [Some(1e-2), Some(1e-3), Some(1e-4), Some(1e-7)],
            drift: Some(still),
            energy_rate: Some((-2e-5, 1e-5)),
        }
    }

    fn with(figure: CaseFigure, value: Option<f64>) -> Measured {
        let mut measured = measured();
        measured.figures[figure as usize] = value;
        measured
    }

    fn errors(least: f64, most: f64) -> Measured {
        let mut measured = with(CaseFigure::ErrorBelow, Some(most));
        measured.figures[CaseFigure::ErrorAbove as usize] = Some(least);
        measured
    }

    fn limits() -> Limits {
        Limits {
            bounds: vec![
                (CaseFigure::ErrorBelow, 1e-2),
                (CaseFigure::ErrorAbove, 1e-3),
                (CaseFigure::ObservedWithin, 1e-3),
                (CaseFigure::RestBelow, 1e-6),
            ],
            drift: vec![(Conserved::Mass, 1e-13), (Conserved::Momentum, 0.0)],
            energy_rate: Some((-2e-5, 1e-5)),
        }
    }

    #[rstest]
    #[case::all_hold(measured(), 0)]
    #[case::too_large(errors(1e-3, 1.1e-2), 1)]
    #[case::too_small(errors(0.9e-3, 1e-2), 1)]
    #[case::no_level_counts(Measured { figures: [None, None, Some(1e-4), Some(1e-7)], ..measured() }, 2)]
    #[case::nan_errors(errors(NAN, NAN), 2)]
    #[case::far_off(with(CaseFigure::ObservedWithin, Some(2e-3)), 1)]
    #[case::observed_nan(with(CaseFigure::ObservedWithin, Some(NAN)), 1)]
    #[case::still_moving(with(CaseFigure::RestBelow, Some(2e-6)), 1)]
    #[case::residual_speed_nan(with(CaseFigure::RestBelow, Some(NAN)), 1)]
    #[case::not_observed(with(CaseFigure::ObservedWithin, None), 1)]
    #[case::failed(Measured { drift: Some(ConservationError::NONE), ..measured() }, 2)]
    #[case::no_totals(Measured { drift: None, ..measured() }, 2)]
    #[case::energy_lost(Measured { energy_rate: Some((-2.1e-5, 0.0)), ..measured() }, 1)]
    #[case::energy_made(Measured { energy_rate: Some((0.0, 1.1e-5)), ..measured() }, 1)]
    #[case::energy_nan(Measured { energy_rate: Some((NAN, 0.0)), ..measured() }, 1)]
    #[case::energy_unknown(Measured { energy_rate: None, ..measured() }, 1)]
    fn every_limit_must_hold(#[case] measured: Measured, #[case] unmet: usize) {
        let found = limits().unmet(&measured);
        assert_eq!(found.len(), unmet, "{found:?}");
    }

    #[test]
    fn sums_with_one_limit_are_named_together() {
        let mut limits = limits();
        assert_eq!(
            limits.summary()[4..],
            [
                "drift of mass at most 1e-13",
                "drift of momentum at most 0e0",
                "rate of energy within [-2e-5, 1e-5] 1/s"
            ]
        );
        limits.energy_rate = None;
        limits.drift[1].1 = 1e-13;
        assert_eq!(limits.summary()[4..], ["drift of mass, momentum at most 1e-13"]);
        assert!(limits.found(&measured()).ends_with("; drift of mass 0e0, momentum 0e0"));
    }

    /// The mass drifts by 2e-13 of 1e6 kg, and the momentum by half of 4e-6 kg m/s.
    #[test]
    fn drifts_and_rates_are_reported_with_their_own_values() {
        let start = Totals { mass: 1e6, momentum_size: 4e-6, ..Totals::default() };
        let mut balance = Balance::start(start);
        balance.look(Some(&Totals { mass: 1e6 - 2e-7, momentum: [0.0, 0.0, 2e-6], ..start }));
        let (drift, energy_rate) = (Some(balance.drift()), Some((-3e-5, 2e-6)));
        let measured = Measured { drift, energy_rate, ..measured() };
        let rates = "[-3e-5, 2e-6]";
        let unmet = limits().unmet(&measured).into_iter().map(|one| one.unmet.text);
        assert_eq!(
            unmet.collect::<Vec<_>>(),
            [
                "expected drift of mass at most 1e-13, got 2e-13".to_owned(),
                "expected drift of momentum at most 0e0, got 5e-1".to_owned(),
                format!("expected rate of energy within [-2e-5, 1e-5] 1/s, got {rates}"),
            ]
        );
        let found = format!("; drift of mass 2e-13, momentum 5e-1; rate of energy {rates} 1/s");
        assert!(limits().found(&measured).ends_with(&found));
    }

    #[test]
    fn values_without_limits_are_not_checked() {
        assert!(Limits::default().unmet(&Measured::NONE).is_empty());
        assert!(Limits::default().is_empty() && !limits().is_empty());
    }

    #[test]
    fn limits_and_findings_in_words() {
        let bounds = vec![(CaseFigure::ErrorBelow, 1e-11)];
        let limits = Limits { bounds, ..Limits::default() };
        assert_eq!(limits.summary(), ["largest error at most 1e-11"]);
        assert_eq!(limits.found(&measured()), "largest error 0.01");
        let unmet = limits.unmet(&errors(NAN, NAN)).pop().expect("a line");
        assert_eq!(unmet.unmet.text, "expected largest error at most 1e-11, got NaN");
        assert!(!unmet.measured);
    }
}
