//! Checks a reported derivative by the remainder of the Taylor series that contains it.

use super::GradientState;

/// Exponent k of the smallest perturbation, the parameter times 2^-k.
pub const LAST_LEVEL: u32 = 16;

/// Exponent k of the largest perturbation, the parameter times 2^-k.
pub const FIRST_LEVEL: u32 = 4;

/// Range of the order of the remainder for a correct derivative of a smooth function.
const SECOND: (f64, f64) = (1.9, 2.1);

/// Range of the order of the remainder for a wrong derivative.
const FIRST: (f64, f64) = (0.9, 1.1);

/// Range of the order of a remainder that does not decrease.
const FLAT: (f64, f64) = (-0.1, 0.1);

/// Number of consecutive perturbations over which an order must hold.
const LEVELS: usize = 4;

/// Maximum relative difference between central differences if there is no jump between them.
const SPREAD: f64 = 0.05;

/// Maximum rounding error of a usable central difference, relative to its magnitude.
const NOISE: f64 = 0.01;

/// Maximum distance between a correct derivative and the central difference, in units of the
/// uncertainty of the central difference.
const SURE: f64 = 10.0;

/// Values of the functional for one perturbation of the parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Perturbed {
    /// Exponent of the perturbation e, which is the parameter times 2^-level.
    pub level: u32,
    /// Perturbation e.
    pub by: f64,
    /// J(q + e).
    pub above: f64,
    /// J(q - e).
    pub below: f64,
}

impl Perturbed {
    /// Returns the central difference `(J(q + e) - J(q - e))/(2 e)`.
    pub fn difference(&self) -> f64 {
        (self.above - self.below) / (2.0 * self.by)
    }
}

/// Values of a function around a point, and the derivative reported at this point.
#[derive(Debug, Clone, PartialEq)]
pub struct Taylor {
    /// J(q).
    pub value: f64,
    /// The reported derivative g.
    pub gradient: f64,
    /// Rounding error of the remainder.
    pub rounding: f64,
    /// Perturbed values, the largest perturbation first.
    pub perturbed: Vec<Perturbed>,
}

impl Taylor {
    /// Returns the remainders `|J(q + e) - J(q) - e g|`.
    pub fn remainders(&self) -> Vec<f64> {
        let remainder = |p: &Perturbed| (p.above - self.value - p.by * self.gradient).abs();
        self.perturbed.iter().map(remainder).collect()
    }

    /// Returns the orders of the remainder between consecutive perturbations; `None` if a remainder
    /// is not larger than its rounding error.
    pub fn orders(&self) -> Vec<Option<f64>> {
        let all: Vec<(f64, f64)> =
            self.perturbed.iter().map(|p| p.by).zip(self.remainders()).collect();
        let is_above = |r: f64| r > self.rounding;
        let order = |pair: &[(f64, f64)]| {
            let ((e0, r0), (e1, r1)) = (pair[0], pair[1]);
            let order = libm::log(r0 / r1) / libm::log(e0 / e1);
            (is_above(r0) && is_above(r1)).then_some(order)
        };
        all.windows(2).map(order).collect()
    }

    /// Returns the central differences `(J(q + e) - J(q - e))/(2 e)`.
    pub fn differences(&self) -> Vec<f64> {
        self.perturbed.iter().map(Perturbed::difference).collect()
    }

    /// Returns the state of the derivative, and the reason with measured values.
    pub fn judge(&self) -> (GradientState, String) {
        let (remainders, orders) = (self.remainders(), self.orders());
        let above = remainders.iter().filter(|r| **r > self.rounding).count();
        let differences = self.usable_differences();
        if !remainders.iter().all(|r| r.is_finite()) {
            return (GradientState::Wrong, "a Taylor remainder is not finite".to_owned());
        }
        let agrees = differences.iter().all(|d| (d - self.gradient).abs() <= SPREAD * d.abs());
        if above == 0 && agrees && differences.len() >= LEVELS {
            return (
                GradientState::Linear,
                "the Taylor remainder is at rounding on all levels".to_owned(),
            );
        }
        if above < LEVELS {
            let reason = format!("the Taylor remainder is above rounding on {above} levels only");
            return (GradientState::AtRounding, reason);
        }
        let spread = spread(&differences);
        if !(spread <= SPREAD) && (has_tail(&orders, SECOND) || has_tail(&orders, FLAT)) {
            let percent = 100.0 * spread;
            return (GradientState::Jumps, format!("central differences differ by {percent:.1} %"));
        }
        let figures = format!(
            "the derivative is {:.4e}, the central difference {:.4e}",
            self.gradient,
            differences.last().copied().unwrap_or(f64::NAN)
        );
        if has_tail(&orders, FIRST) {
            let reason = format!("the Taylor remainder has order 1: {figures}");
            return (GradientState::Wrong, reason);
        }
        if self.is_off() {
            return (GradientState::Wrong, format!("two derivatives disagree: {figures}"));
        }
        let longest = longest_run(&orders, SECOND);
        if longest + 1 >= LEVELS {
            return (GradientState::Smooth, format!("Taylor order 2 on {} levels", longest + 1));
        }
        if agrees && spread <= SPREAD {
            let reason = "the Taylor remainder has no order, as for a function with kinks or \
                          rounding; the derivative agrees with the central differences";
            return (GradientState::AtRounding, reason.to_owned());
        }
        (GradientState::Wrong, "the Taylor remainder does not have order 2".to_owned())
    }

    /// Whether the derivative differs significantly from the most accurate central difference,
    /// whose uncertainty is its rounding error plus its change from the next larger perturbation.
    /// The remainder does not show small relative errors, because its order is still 2.
    fn is_off(&self) -> bool {
        let all: Vec<(f64, f64)> =
            self.perturbed.iter().map(|p| p.by.abs()).zip(self.differences()).collect();
        let uncertain = |pair: &[(f64, f64)]| {
            let ((_, before), (by, now)) = (pair[0], pair[1]);
            ((now - before).abs() + self.rounding / by, now)
        };
        let best = all.windows(2).map(uncertain).min_by(|a, b| a.0.total_cmp(&b.0));
        best.is_some_and(|(error, now)| !((now - self.gradient).abs() <= SURE * error))
    }

    fn usable_differences(&self) -> Vec<f64> {
        let all = self.perturbed.iter().zip(self.differences());
        let usable = all.filter(|(p, d)| !(self.rounding > NOISE * (p.by * d).abs()));
        usable.map(|(_, d)| d).collect()
    }
}

/// Returns the range of the numbers relative to the largest magnitude; NaN if a number is NaN.
fn spread(numbers: &[f64]) -> f64 {
    if numbers.iter().any(|number| number.is_nan()) {
        return f64::NAN;
    }
    let low = numbers.iter().copied().fold(f64::INFINITY, f64::min);
    let high = numbers.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let size = low.abs().max(high.abs());
    if numbers.is_empty() || size == 0.0 { 0.0 } else { (high - low) / size }
}

fn is_in(order: Option<f64>, range: (f64, f64)) -> bool {
    order.is_some_and(|order| range.0 <= order && order <= range.1)
}

/// Whether the orders for the smallest perturbations above rounding are in a range.
fn has_tail(orders: &[Option<f64>], range: (f64, f64)) -> bool {
    let end = orders.iter().rposition(Option::is_some).map_or(0, |last| last + 1);
    let start = end.saturating_sub(LEVELS - 1);
    end - start == LEVELS - 1 && orders[start..end].iter().all(|order| is_in(*order, range))
}

fn longest_run(orders: &[Option<f64>], range: (f64, f64)) -> usize {
    let extend = |(longest, now): (usize, usize), order: &Option<f64>| {
        let now = if is_in(*order, range) { now + 1 } else { 0 };
        (longest.max(now), now)
    };
    orders.iter().fold((0, 0), extend).0
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    /// Creates a Taylor test of `f` at q = 2 with this derivative and rounding error.
    fn taylor(f: impl Fn(f64) -> f64, gradient: f64, rounding: f64) -> Taylor {
        let q = 2.0;
        let perturbed = |level: u32| {
            let by = q * libm::exp2(-f64::from(level));
            Perturbed { level, by, above: f(q + by), below: f(q - by) }
        };
        let perturbed = (FIRST_LEVEL..=LAST_LEVEL).map(perturbed).collect();
        Taylor { value: f(q), gradient, rounding, perturbed }
    }

    fn state(f: impl Fn(f64) -> f64, gradient: f64) -> GradientState {
        taylor(f, gradient, 1e-14).judge().0
    }

    /// By hand for J = 3e-6 q^2 at q = -2e6 with g = -13 instead of -12 and e = -2e6/16: the values
    /// are 12e6 and 3e-6 (17/16 q)^2, and the remainder is |3e-6 e^2 + e| = 78125.
    #[test]
    fn remainders_and_differences_by_hand() {
        let q = -2e6;
        let perturbed = |level: u32| {
            let by = q * libm::exp2(-f64::from(level));
            let value = |q: f64| 3e-6 * q * q;
            Perturbed { level, by, above: value(q + by), below: value(q - by) }
        };
        let taylor = Taylor {
            value: 12e6,
            gradient: -13.0,
            rounding: 1e4,
            perturbed: (4..=8).map(perturbed).collect(),
        };
        let close = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-9;
        let remainders = [78_125.0, 50_781.25, 28_320.312_5, 14_892.578_125, 7_629.394_531_25];
        for (found, expected) in taylor.remainders().into_iter().zip(remainders) {
            assert!(close(found, expected), "{found} {expected}");
        }
        assert!(taylor.differences().into_iter().all(|found| close(found, -12.0)));
        let orders = taylor.orders();
        for (order, pair) in orders.iter().zip(remainders[..4].windows(2)) {
            assert!(close(order.unwrap(), libm::log2(pair[0] / pair[1])), "{orders:?}");
        }
        // The smallest remainder is rounding.
        assert_eq!(orders[3], None);
    }

    /// For J = q^3 at q = 2 the difference with e = 2^-15 is 12 + e^2, and 12 + 4 e^2 before. The
    /// derivative may deviate from the former by ten times their change, 30 e^2.
    #[rstest]
    #[case::within_ten_changes(29.0, GradientState::Smooth)]
    #[case::beyond_ten_changes(31.0, GradientState::Wrong)]
    fn a_derivative_is_as_accurate_as_the_differences(
        #[case] off: f64,
        #[case] expected: GradientState,
    ) {
        for sign in [1.0, -1.0] {
            let gradient = 12.0 + (1.0 + sign * off) * libm::exp2(-30.0);
            let found = taylor(|q| q * q * q, gradient, 1e-15).judge();
            assert_eq!(found.0, expected, "{}", found.1);
        }
    }

    #[test]
    fn a_derivative_that_is_off_by_a_factor_is_wrong() {
        for factor in [0.0, 0.5, 2.0, -1.0, 1.001, 1.0 + 1e-6] {
            assert_eq!(state(libm::sin, factor * libm::cos(2.0)), GradientState::Wrong, "{factor}");
        }
    }

    #[test]
    fn a_derivative_of_a_linear_function_is_linear() {
        assert_eq!(state(|q| 3.0 * q - 1.0, 3.0), GradientState::Linear);
        assert_eq!(state(|q| 1.0 - 3.0 * q, -3.0), GradientState::Linear);
        assert_eq!(state(|q| 3.0 * q - 1.0, 6.0), GradientState::Wrong);
        // If all differences are rounding errors, no derivative can be judged.
        assert_eq!(state(|_| 0.0, 0.0), GradientState::AtRounding);
    }

    #[test]
    fn a_jump_between_perturbations_is_named() {
        let with_jump = |at: f64| move |q: f64| libm::sin(q) + if q > at { 0.05 } else { 0.0 };
        assert_eq!(state(with_jump(2.003), libm::cos(2.0)), GradientState::Jumps);
        // The distance to the jump is smaller than the smallest perturbation.
        assert_eq!(state(with_jump(2.0), libm::cos(2.0)), GradientState::Jumps);
        // The distance to the jump is larger than all perturbations.
        assert_eq!(state(with_jump(3.0), libm::cos(2.0)), GradientState::Smooth);
    }

    #[test]
    fn single_precision_is_at_rounding() {
        let single = |q: f64| f64::from(libm::sin(q) as f32);
        let (state, reason) = taylor(single, libm::cos(2.0), 2.4e-7).judge();
        assert_ne!(state, GradientState::Wrong, "{reason}");
        let linear = |q: f64| f64::from((0.5 + 1e-6 * q * q) as f32);
        assert!(taylor(linear, 4e-6, 2.4e-7).judge().0 != GradientState::Smooth);
    }

    #[test]
    fn a_value_that_is_not_finite_is_wrong() {
        for bad in [f64::NAN, f64::INFINITY] {
            assert_eq!(state(libm::sin, bad), GradientState::Wrong);
            assert_eq!(state(|q| if q > 2.05 { bad } else { q }, 1.0), GradientState::Wrong);
        }
    }
}
