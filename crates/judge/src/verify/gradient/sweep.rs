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

    fn sweep(f: impl Fn(f64) -> f64, slope: impl Fn(f64) -> f64) -> Option<Sweep> {
        let point = |k: u32| {
            let at = 1.0 + 0.004 * f64::from(k) / 40.0;
            SweepPoint { at, value: f(at), gradient: slope(at) }
        };
        Sweep::new(&(0..=40).map(point).collect::<Vec<_>>(), 1e-15)
    }

    #[test]
    fn the_integral_of_a_derivative_is_the_change() {
        let smooth = sweep(libm::sin, libm::cos).expect("a change");
        assert!(smooth.is_smooth() && (smooth.share - 1.0).abs() < 1e-8, "{smooth:?}");
    }

    #[test]
    fn jumps_are_counted_with_their_shares() {
        let change = libm::sin(1.004) - libm::sin(1.0);
        let step = |q: f64| if q > 1.0021 { 0.25 * change } else { 0.0 };
        let jumps = sweep(|q| libm::sin(q) + step(q), libm::cos).expect("a change");
        assert!(!jumps.is_smooth());
        assert_eq!(jumps.jumps.len(), 1);
        assert!((jumps.jumps[0] - 0.2).abs() < 1e-4, "{jumps:?}");
        assert!((jumps.share - 0.8).abs() < 1e-4, "{jumps:?}");
    }

    #[test]
    fn a_wrong_or_undefined_derivative_is_not_smooth() {
        for factor in [2.0, 0.99, f64::NAN] {
            let wrong = sweep(libm::sin, |q| factor * libm::cos(q)).expect("a change");
            assert!(!wrong.is_smooth(), "{factor}");
        }
    }

    #[test]
    fn a_function_without_a_change_has_no_sweep() {
        assert_eq!(sweep(|_| 1.0, |_| 0.0), None);
    }
}
