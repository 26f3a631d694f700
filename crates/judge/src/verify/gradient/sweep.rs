//! Checks a derivative over an interval of the parameter.

/// Maximum relative difference between the integral of the derivative and the function's change.
const SMOOTH: f64 = 1e-3;

/// Minimum size of a jump between neighbours, relative to the change of the function.
const JUMP: f64 = 5e-4;

/// Value and derivative of the functional at one value of the parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SweepPoint {
    /// The parameter q.
    pub at: f64,
    /// J(q).
    pub value: f64,
    /// The reported derivative.
    pub gradient: f64,
}

/// The integral of a derivative compared with the change of its function.
#[derive(Debug, Clone, PartialEq)]
pub struct Sweep {
    /// Change of the function from the first value of the parameter to the last.
    pub change: f64,
    /// Trapezoidal sum of the derivative, divided by `change`.
    pub share: f64,
    /// Jumps of the function between neighbouring points, divided by `change`.
    pub jumps: Vec<f64>,
}

impl Sweep {
    /// Integrates the derivative over `points`, which are sorted by the parameter. `None` if the
    /// rounding error of a value, `rounding`, could count as a jump.
    pub fn new(points: &[SweepPoint], rounding: f64) -> Option<Self> {
        let (first, last) = (points.first()?, points.last()?);
        let change = last.value - first.value;
        if change.abs() <= rounding / JUMP {
            return None;
        }
        let trapezium = |pair: &[SweepPoint]| {
            0.5 * (pair[0].gradient + pair[1].gradient) * (pair[1].at - pair[0].at)
        };
        let jump = |pair: &[SweepPoint]| (pair[1].value - pair[0].value - trapezium(pair)) / change;
        let share = points.windows(2).map(trapezium).sum::<f64>() / change;
        let jumps = points.windows(2).map(jump).filter(|jump| !(jump.abs() <= JUMP)).collect();
        Some(Self { change, share, jumps })
    }

    /// Whether the integral of the derivative equals the change of the function, without jumps.
    pub fn is_smooth(&self) -> bool {
        (self.share - 1.0).abs() <= SMOOTH && self.jumps.is_empty()
    }

    /// Formats share and jumps in one line.
    pub fn summary(&self) -> String {
        let jumps: Vec<String> = self.jumps.iter().map(|jump| format!("{jump:+.3}")).collect();
        let jumps = match jumps.as_slice() {
            [] => "no jump".to_owned(),
            [one] => format!("a jump of {one}"),
            all => format!("{} jumps: {}", all.len(), all.join(" ")),
        };
        format!(
            "over the sweep the integrated derivative is {:.4} times the change, with {jumps}",
            self.share
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    /// The trapezoidal integrals over the two intervals are 3e-6 and 9e-6. The function rises by
    /// 3e-6 and 8e-6, so its change is 11e-6, with a jump of -1/11 of the change.
    #[test]
    fn integral_and_jump_by_hand() {
        let points = [(1e6, 5e-6, 2e-12), (2.5e6, 8e-6, 2e-12), (4.5e6, 1.6e-5, 7e-12)];
        let points = points.map(|(at, value, gradient)| SweepPoint { at, value, gradient });
        let found = Sweep::new(&points, 5.4e-9).expect("a change");
        assert!((found.change / 1.1e-5 - 1.0).abs() < 1e-12, "{found:?}");
        assert!((found.share - 12.0 / 11.0).abs() < 1e-12, "{found:?}");
        assert!(found.jumps.len() == 1 && (found.jumps[0] + 1.0 / 11.0).abs() < 1e-12);
        let text = "over the sweep the integrated derivative is 1.0909 times the change, with a jump of -0.091";
        assert_eq!(found.summary(), text);
        // A rounding error of 5e-4 of the change could count as a jump.
        assert_eq!(Sweep::new(&points, 5.6e-9), None);
    }

    /// A jump between 4 of 5 points of a linear function that falls by 4e6, and a derivative that
    /// is wrong by a factor.
    #[rstest]
    #[case::small_jump(4.9e-4, 1.0, 0)]
    #[case::large_jump(5.1e-4, 1.0, 1)]
    #[case::small_factor(0.0, 1.000_9, 0)]
    #[case::large_factor(0.0, 1.001_1, 0)]
    #[case::other_sign(0.0, -1.0, 4)]
    #[case::undefined(0.0, f64::NAN, 4)]
    fn jumps_and_factors_have_bounds(#[case] jump: f64, #[case] factor: f64, #[case] jumps: usize) {
        let point = |k: u32| {
            let fall = -1e6 * f64::from(k) - if k > 2 { 4e6 * jump / (1.0 - jump) } else { 0.0 };
            SweepPoint { at: 1e-6 * f64::from(k), value: fall, gradient: -1e12 * factor }
        };
        let found = Sweep::new(&(0..5).map(point).collect::<Vec<_>>(), 1e-9).expect("a change");
        assert_eq!(found.jumps.len(), jumps, "{found:?}");
        assert_eq!(found.is_smooth(), jump < 5e-4 && (factor - 1.0).abs() < 1e-3, "{found:?}");
    }

    #[test]
    fn a_function_without_a_change_has_no_sweep() {
        let point = |at| SweepPoint { at, value: 1.0, gradient: 0.0 };
        assert_eq!(Sweep::new(&[1.0, 2.0].map(point), 1e-15), None);
    }
}
