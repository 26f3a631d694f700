//! All checks of the derivative with respect to one parameter.

use super::{GradientEvidence, GradientState, Sweep, SweepPoint, Taylor, ValueCheck};
use crate::verify::order::fit::{FittedLine, LogPoint};
use crate::verify::order::format_number::format_number;
use crate::verify::order::level::{Level, observed_order};
use crate::verify::{Unmet, UnmetCode};

/// Maximum difference between the observed order of the derivative error and the formal order.
const ORDER: f64 = 0.15;

/// Maximum difference between the order over the two finest levels and the formal order.
const FINEST: f64 = 0.25;

/// Reported and exact derivative on one level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GradientLevel {
    /// Cells along the first axis.
    pub cells: u64,
    /// Cell size (m).
    pub h: f64,
    /// Time step (s).
    pub dt: f64,
    /// Reported total derivative with respect to the parameter.
    pub gradient: f64,
    /// The exact derivative.
    pub exact: f64,
}

impl GradientLevel {
    /// Returns the magnitude of the error of the derivative.
    pub fn error(&self) -> f64 {
        (self.gradient - self.exact).abs()
    }
}

/// Results of all checks of the derivative with respect to one parameter.
#[derive(Debug, Clone)]
pub struct GradientStudy {
    /// Name of the functional.
    pub functional: &'static str,
    /// Name of the parameter.
    pub parameter: &'static str,
    /// Whether a solver that states double precision has derivatives of single precision only.
    pub single_precision: bool,
    /// Check 1: the value of the functional, on the level where parameters are perturbed.
    pub value: ValueCheck,
    /// Check 2: the remainder of the Taylor series with the derivative.
    pub taylor: Taylor,
    /// Check 3: the derivatives on all levels.
    pub levels: Vec<GradientLevel>,
    /// Check 4: the derivative over an interval of the parameter.
    pub sweep: Option<Sweep>,
    /// The points of the sweep.
    pub points: Vec<SweepPoint>,
    /// Results of additional runs without derivatives, if the derivative is wrong.
    pub evidence: Option<GradientEvidence>,
}

impl GradientStudy {
    /// Whether the method fails at the problem. Such a failure may be expected.
    pub fn fails(&self) -> bool {
        self.state().0 == GradientState::Wrong
    }

    /// Returns the state of the derivative, and the reason with values and the cause of an error.
    pub fn state(&self) -> (GradientState, String) {
        let (state, reason) = self.measured_state();
        let evidence = self.evidence.as_ref().filter(|_| state == GradientState::Wrong);
        match evidence.and_then(|evidence| evidence.cause(self.parameter, &self.value)) {
            Some(cause) => (state, format!("{cause}; {reason}")),
            None => (state, reason),
        }
    }

    fn measured_state(&self) -> (GradientState, String) {
        if !self.value.agrees() {
            let ValueCheck { reported, computed, .. } = self.value;
            let reason = format!(
                "the value {reported:e} that comes with the gradient is not that of a run without derivatives, \
                 {computed:e}"
            );
            return (GradientState::Wrong, reason);
        }
        let (state, reason) = self.taylor.judge();
        if self.single_precision {
            let reason = format!(
                "single-precision: every reported derivative is a number of single precision, but \
                 the solver states double precision; {reason}"
            );
            return (GradientState::Wrong, reason);
        }
        let Some(sweep) = &self.sweep else { return (state, reason) };
        let is_open = matches!(state, GradientState::Wrong | GradientState::AtRounding);
        let state = if is_open || sweep.is_smooth() { state } else { GradientState::Jumps };
        (state, format!("{reason}; {}", sweep.summary()))
    }

    /// Returns the orders of the derivative error between neighbouring levels; NaN if undefined.
    pub fn pairwise_orders(&self) -> Vec<f64> {
        let level = |level: &GradientLevel| Level::new(level.h, level.error());
        let order = |pair: &[GradientLevel]| observed_order(&level(&pair[0]), &level(&pair[1]));
        self.levels.windows(2).map(|pair| order(pair).unwrap_or(f64::NAN)).collect()
    }

    /// Returns the order of the derivative error, the slope of the least-squares line of log error
    /// over log h. NaN with fewer than two levels, or if an error is zero or not finite.
    pub fn order(&self) -> f64 {
        let point = |(index, level): (usize, &GradientLevel)| LogPoint {
            level: index,
            x: libm::log(level.h),
            y: libm::log(level.error()),
        };
        let points: Vec<LogPoint> = self.levels.iter().enumerate().map(point).collect();
        FittedLine::through(&points).map_or(f64::NAN, |line| line.slope)
    }
}

/// Requirements on a derivative.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct GradientTerms {
    /// Required state.
    pub state: Option<GradientState>,
    /// Lowest and highest order of the error of the derivative.
    pub order: Option<(f64, f64)>,
    /// Lowest and highest order over the two finest levels.
    pub finest: Option<(f64, f64)>,
}

impl GradientTerms {
    /// Returns the requirements of `run --gate`: any state except `wrong`, and the formal order.
    pub fn of_gate(formal_order: f64) -> Self {
        let around = |width: f64| Some((formal_order - width, formal_order + width));
        Self { state: None, order: around(ORDER), finest: around(FINEST) }
    }

    /// Returns the requirements in one line.
    pub fn summary(&self) -> String {
        let range = |name: &str, range: (f64, f64)| {
            format!("{name} {} to {}", format_number(range.0), format_number(range.1))
        };
        let state = self.state.map_or("not wrong".to_owned(), |state| state.name().to_owned());
        let order = self.order.map(|order| range("order", order));
        let finest = self.finest.map(|order| range("order of the finest pair", order));
        [Some(state), order, finest].into_iter().flatten().collect::<Vec<_>>().join(", ")
    }

    /// Lists the requirements that `study` does not meet.
    pub fn unmet(&self, study: &GradientStudy) -> Vec<Unmet> {
        let (state, reason) = study.state();
        let state_is_met = match self.state {
            Some(expected) => state == expected,
            None => state != GradientState::Wrong,
        };
        let expected = self.state.map_or("not wrong", GradientState::name);
        let mut unmet = Vec::new();
        if !state_is_met {
            unmet.push(format!("state: expected {expected}, is {}: {reason}", state.name()));
        }
        let mut check = |name: &str, range: Option<(f64, f64)>, order: f64| {
            let Some((low, high)) = range else { return };
            if !(low <= order && order <= high) {
                unmet.push(format!("{name}: expected {low:.2} to {high:.2}, is {order:.2}"));
            }
        };
        check("order", self.order, study.order());
        let finest = study.pairwise_orders().last().copied().unwrap_or(f64::NAN);
        check("order of the finest pair", self.finest, finest);
        unmet.into_iter().map(|text| Unmet::new(UnmetCode::DerivativeDiffers, text)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::gradient::Perturbed;
    use rstest::rstest;

    /// Creates a study of J = q^2 at q = 1 on three levels, with `factor` times the derivative.
    fn study(factor: f64, error: impl Fn(f64) -> f64) -> GradientStudy {
        let perturbed = |level: i32| {
            let by = libm::exp2(-f64::from(level));
            let value = |q: f64| q * q;
            Perturbed { level: level as u32, by, above: value(1.0 + by), below: value(1.0 - by) }
        };
        let level = |cells: u64| {
            let h = 1.0 / cells as f64;
            GradientLevel { cells, h, dt: h, gradient: 2.0 + error(h), exact: 2.0 }
        };
        let taylor = Taylor {
            value: 1.0,
            gradient: 2.0 * factor,
            rounding: 1e-15,
            perturbed: (4..=12).map(perturbed).collect(),
        };
        GradientStudy {
            functional: "mean_displacement",
            parameter: "young",
            single_precision: false,
            value: ValueCheck { reported: 1.0, computed: 1.0, tolerance: 1e-12 },
            taylor,
            levels: [8, 16, 32].map(level).to_vec(),
            sweep: None,
            points: Vec::new(),
            evidence: None,
        }
    }

    /// Orders between neighbouring levels, from coarse to fine. The order of the line through three
    /// levels is their mean.
    #[rstest]
    #[case::second_order([2.0, 2.0], &[])]
    #[case::just_inside_below([1.96, 1.76], &[])]
    #[case::just_inside_above([2.05, 2.24], &[])]
    #[case::too_low([1.9, 1.78], &["order: expected 1.85 to 2.15, is 1.84"])]
    #[case::too_high([2.1, 2.22], &["order: expected 1.85 to 2.15, is 2.16"])]
    #[case::low_finest_pair([2.0, 1.74], &["order of the finest pair: expected 1.75 to 2.25, is 1.74"])]
    #[case::high_finest_pair([2.0, 2.26], &["order of the finest pair: expected 1.75 to 2.25, is 2.26"])]
    #[case::unknown([2.0, f64::NAN], &["order: expected 1.85 to 2.15, is NaN", "order of the finest pair: expected 1.75 to 2.25, is NaN"])]
    fn orders_have_bounds_on_both_sides(#[case] orders: [f64; 2], #[case] unmet: &[&str]) {
        let mut study = study(1.0, |_| 0.0);
        let mut error = 1e-6;
        for (k, level) in study.levels.iter_mut().enumerate() {
            error *= if k == 0 { 1.0 } else { libm::exp2(-orders[k - 1]) };
            (level.exact, level.gradient) = (-3e-6, -3e-6 - error);
        }
        let found = GradientTerms::of_gate(2.0).unmet(&study);
        assert_eq!(found.iter().map(|one| one.text.as_str()).collect::<Vec<_>>(), unmet);
        for (found, expected) in study.pairwise_orders().iter().zip(orders) {
            assert!((found - expected).abs() < 1e-6 || expected.is_nan(), "{found} {expected}");
        }
    }

    #[test]
    fn terms_are_summarised_with_both_ranges() {
        let state = Some(GradientState::Linear);
        let text = ", order 1.35 to 1.65, order of the finest pair 1.25 to 1.75";
        let terms = GradientTerms::of_gate(1.5);
        assert_eq!(terms.summary(), format!("not wrong{text}"));
        assert_eq!(GradientTerms { state, ..terms }.summary(), format!("linear{text}"));
    }

    #[test]
    fn each_check_is_named_when_it_fails() {
        let terms =
            GradientTerms { state: Some(GradientState::Smooth), ..GradientTerms::of_gate(2.0) };
        let first = |study: &GradientStudy| {
            let unmet = terms.unmet(study).into_iter().next();
            unmet.map_or(String::new(), |unmet| unmet.text)
        };
        assert!(first(&study(2.0, |h| h * h)).starts_with("state: expected smooth, is wrong"));
        let mut other = study(1.0, |h| h * h);
        for (reported, is_right) in [(1.0 + 9e-13, true), (1.0 - 1.1e-12, false), (f64::NAN, false)]
        {
            other.value.reported = reported;
            let text = first(&other);
            assert_eq!(text.is_empty(), is_right, "{text}");
            assert!(is_right || text.contains("is not that of a run without derivatives, 1e0"));
        }
        other.value.reported = 1.0;
        let points =
            [(0.0, 0.0), (1.0, 2.0)].map(|(at, value)| SweepPoint { at, value, gradient: 1.0 });
        other.sweep = Sweep::new(&points, 1e-15);
        assert_eq!(other.state().0, GradientState::Jumps);
        other.single_precision = true;
        assert_eq!(other.state().0, GradientState::Wrong);
    }
}
