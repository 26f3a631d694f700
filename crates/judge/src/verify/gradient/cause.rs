//! Finds the probable mistake in a wrong derivative by comparison with runs without derivatives.

use super::ValueCheck;

/// Maximum relative difference at which two numbers count as equal.
const ALIKE: f64 = 1e-3;

/// Fraction of a central difference below which a derivative counts as zero.
const ZERO: f64 = 1e-9;

/// Range of the factor by which an error of first or second order grows with twice the motion.
const GROWS: (f64, f64) = (1.6, 4.5);

/// Minimum relative error whose growth is measured. Smaller errors may be rounding.
const MEASURED: f64 = 1e-7;

/// One entry of a reported gradient.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GradientEntry {
    /// Name of the parameter.
    pub parameter: &'static str,
    /// The reported derivative.
    pub reported: f64,
    /// Central difference of runs without derivatives.
    pub difference: f64,
}

impl GradientEntry {
    fn is_right(&self) -> bool {
        alike(self.reported, self.difference)
    }

    fn is_zero(&self) -> bool {
        self.reported.abs() <= ZERO * self.difference.abs()
    }
}

/// Results of runs without derivatives, for comparison with a wrong derivative.
#[derive(Debug, Clone, PartialEq)]
pub struct GradientEvidence {
    /// Entries of the reported gradient, on the level where parameters are perturbed.
    pub entries: Vec<GradientEntry>,
    /// Value of the functional after all steps except the last; NaN if it is unknown.
    pub one_step_less: f64,
    /// Relative errors of the derivative, with the initial velocity of the problem and with twice
    /// that velocity; NaN if unknown.
    pub errors: [f64; 2],
    /// Value of the functional for a Young's modulus near zero; NaN if it is unknown.
    pub without_stress: f64,
}

impl GradientEvidence {
    /// Returns the probable mistake in the derivative with respect to `parameter`, if known.
    pub fn cause(&self, parameter: &str, value: &ValueCheck) -> Option<String> {
        if !value.agrees() {
            let is_earlier = (value.reported - self.one_step_less).abs() <= value.tolerance;
            return is_earlier.then(|| "the value is that of one step less".to_owned());
        }
        let own = self.entries.iter().find(|entry| entry.parameter == parameter)?;
        if let Some(order) = self.order() {
            return Some(format!("the entries are in another order: {order}"));
        }
        if let Some(sums) = self.running_sums() {
            return Some(sums);
        }
        if self.is_without_stress() {
            let text = "the derivative with respect to the initial velocity is that of a motion \
                        without stress: derivatives do not pass through the stress";
            return Some(text.to_owned());
        }
        let (velocities, others): (Vec<&GradientEntry>, Vec<&GradientEntry>) =
            self.entries.iter().partition(|entry| entry.parameter == "initial_velocity");
        if own.is_zero() && others.iter().all(|entry| entry.is_zero()) {
            let rest = if velocities.iter().any(|entry| entry.is_right()) {
                "all derivatives except that of the initial velocity are zero"
            } else {
                "the derivatives of the material are zero"
            };
            return Some(rest.to_owned());
        }
        if own.is_zero() {
            return Some("the derivative is zero: it misses the dependence entirely".to_owned());
        }
        let [error, with_twice] = self.errors.map(f64::abs);
        let growth = with_twice / error;
        if error >= MEASURED && GROWS.0 <= growth && growth <= GROWS.1 {
            return Some(format!(
                "the relative error {error:.1e} grows to {with_twice:.1e} with twice the initial \
                 velocity: derivatives do not pass through the positions or the volumes of \
                 particles"
            ));
        }
        let factor = own.reported / own.difference;
        let have_factor = |entry: &GradientEntry| alike(entry.reported, factor * entry.difference);
        // With nine digits, a factor close to 1 is not printed as 1.
        let digits = if (factor - 1.0).abs() < 0.01 { 9 } else { 4 };
        let times = format!("{factor:.digits$} times the central difference");
        // Central differences cannot tell factors apart that are this close to 1.
        let is_distinct = !alike(factor, 1.0);
        if is_distinct && self.entries.len() > 1 && self.entries.iter().all(have_factor) {
            return Some(format!("all derivatives have the same factor, {factor:.digits$}"));
        }
        let rest_is_right =
            self.entries.iter().all(|entry| entry.parameter == parameter || entry.is_right());
        if is_distinct && parameter == "density" && self.entries.len() > 1 && rest_is_right {
            return Some(format!(
                "the derivative is {times}, and those of all other parameters are right: \
                 derivatives do not pass through all masses"
            ));
        }
        factor.is_finite().then(|| format!("the derivative is {times}"))
    }

    /// Describes entries that are sums of all derivatives up to their own.
    fn running_sums(&self) -> Option<String> {
        let (mut sum, mut size) = (0.0, 0.0);
        let is_sum = |entry: &GradientEntry| {
            sum += entry.difference;
            size += entry.difference.abs();
            (entry.reported - sum).abs() <= ALIKE * size
        };
        let are_sums = self.entries.iter().map(is_sum).collect::<Vec<_>>().iter().all(|is| *is);
        let is_wrong = self.entries.iter().any(|entry| !entry.is_right());
        (are_sums && is_wrong).then(|| {
            "each entry is the sum of the derivatives up to its own: derivatives are not cleared \
             between parameters"
                .to_owned()
        })
    }

    /// Describes which entry belongs to which parameter, if only the order of the entries is wrong.
    fn order(&self) -> Option<String> {
        let mut free: Vec<&GradientEntry> = self.entries.iter().collect();
        let mut belongs = Vec::new();
        for entry in &self.entries {
            let place = free.iter().position(|one| alike(entry.reported, one.difference))?;
            belongs.push((entry.parameter, free.remove(place).parameter));
        }
        let moved: Vec<String> = belongs
            .iter()
            .filter(|(entry, of)| entry != of)
            .map(|(entry, of)| format!("the entry of {entry} is the derivative of {of}"))
            .collect();
        (!moved.is_empty()).then(|| moved.join(", "))
    }

    /// Whether the derivative with respect to the factor on the initial velocity is wrong, and
    /// equals that of a motion without stress, whose functional is proportional to the factor.
    fn is_without_stress(&self) -> bool {
        let velocity = self.entries.iter().find(|entry| entry.parameter == "initial_velocity");
        velocity
            .is_some_and(|entry| !entry.is_right() && alike(entry.reported, self.without_stress))
    }
}

/// Whether two numbers agree; false if one is NaN.
fn alike(a: f64, b: f64) -> bool {
    (a - b).abs() <= ALIKE * b.abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    const RIGHT: ValueCheck = ValueCheck { reported: 3.0, computed: 3.0, tolerance: 1e-12 };

    /// Creates reported derivatives whose central differences are -3.6, 3.7 and 3.0.
    fn evidence(reported: [f64; 3]) -> GradientEvidence {
        let entry =
            |(parameter, reported, difference)| GradientEntry { parameter, reported, difference };
        let [young, density, velocity] = reported;
        let entries = [
            ("young", young, -3.6),
            ("density", density, 3.7),
            ("initial_velocity", velocity, 3.0),
        ];
        let entries = entries.map(entry).to_vec();
        GradientEvidence { entries, one_step_less: 2.9, errors: [f64::NAN; 2], without_stress: 5.0 }
    }

    fn cause(parameter: &str, reported: [f64; 3]) -> String {
        evidence(reported).cause(parameter, &RIGHT).unwrap_or_default()
    }

    #[test]
    fn each_mistake_is_named() {
        assert_eq!(
            cause("young", [-7.2, 7.4, 6.0]),
            "all derivatives have the same factor, 2.0000"
        );
        let order = cause("young", [3.7, 3.0, -3.6]);
        assert!(order.contains("the entry of young is the derivative of density"), "{order}");
        assert_eq!(
            cause("density", [-3.6, 3.7 * 0.99999, 3.0]),
            "the derivative is 0.999990000 times the central difference"
        );
        assert_eq!(
            cause("young", [-3.6 * 0.995, 3.7, 3.0]),
            "the derivative is 0.995000000 times the central difference"
        );
    }

    #[test]
    fn running_sums_are_named() {
        let text = "not cleared between parameters";
        assert!(cause("density", [-3.6, 0.1, 3.1]).contains(text));
        assert!(cause("young", [-3.6 + 3.7 + 3.0, 3.7, 3.0]).contains("times the central"));
    }

    #[test]
    fn an_error_that_grows_with_the_motion_is_no_common_factor() {
        let with = |errors| GradientEvidence { errors, ..evidence([-3.6, 3.7, 3.0]) };
        let cause = |errors| with(errors).cause("young", &RIGHT).unwrap_or_default();
        assert!(cause([1e-6, 2e-6]).contains("do not pass through the positions or the volumes"));
        assert!(cause([-1e-6, -4e-6]).contains("do not pass through the positions"));
        assert!(
            cause([1.01e-7, 4.49 * 1.01e-7]).contains("error 1.0e-7 grows to 4.5e-7 with twice")
        );
        assert!(cause([1e-6, 1.61e-6]).contains("do not pass through the positions"));
        for errors in [
            [1e-6, 1.59e-6],
            [1e-6, 4.51e-6],
            [0.99e-7, 2e-7],
            [2e-6, 1e-6],
            [1e-6, f64::NAN],
            [f64::NAN; 2],
        ] {
            assert_eq!(cause(errors), "the derivative is 1.000000000 times the central difference");
        }
    }

    #[test]
    fn a_value_of_an_earlier_time_is_named() {
        let of = |reported: f64| ValueCheck { reported, ..RIGHT };
        let all = evidence([-3.6, 3.7, 3.0]);
        let text = "the value is that of one step less";
        assert_eq!(all.cause("young", &of(2.9 - 0.9e-12)).as_deref(), Some(text));
        assert_eq!(all.cause("young", &of(2.9 + 1.1e-12)), None);
        assert_eq!(all.cause("young", &of(2.8)), None);
        assert_eq!(all.cause("young", &of(f64::NAN)), None);
    }

    /// Derivatives of -3.6e6, 3.7e-6 and 3.0 agree if they differ by less than a thousandth.
    #[rstest]
    #[case(1.0, "density", [1.0, 1.1, 1.0], "the derivative is 1.1000 times the central difference, and those of all other parameters are right: derivatives do not pass through all masses")]
    #[case(1.0, "density", [1.000_9, 1.1, 0.999_1], "the derivative is 1.1000 times the central difference, and those of all other parameters are right: derivatives do not pass through all masses")]
    #[case(1.0, "density", [1.001_1, 1.1, 1.0], "the derivative is 1.1000 times the central difference")]
    #[case(1.0, "young", [1.0, 1.1, 1.0], "the derivative is 1.000000000 times the central difference")]
    #[case(1.0, "young", [-0.5, -0.500_4, -0.499_6], "all derivatives have the same factor, -0.5000")]
    #[case(1.0, "young", [-0.5, -0.501, -0.5], "the derivative is -0.5000 times the central difference")]
    #[case(1.0, "young", [0.9e-9, 1.0, 1.0], "the derivative is zero: it misses the dependence entirely")]
    #[case(1.0, "young", [0.9e-9, 0.0, 1.0], "all derivatives except that of the initial velocity are zero")]
    #[case(1.0, "density", [0.0, -0.9e-9, 1.1], "the derivatives of the material are zero")]
    #[case(5.0, "young", [1.0, 1.0, 5.0 / 3.0], "the derivative with respect to the initial velocity is that of a motion without stress: derivatives do not pass through the stress")]
    fn causes_do_not_depend_on_units(
        #[case] without_stress: f64,
        #[case] parameter: &str,
        #[case] factors: [f64; 3],
        #[case] cause: &str,
    ) {
        let mut all = GradientEvidence { without_stress, ..evidence([0.0; 3]) };
        for ((entry, unit), factor) in all.entries.iter_mut().zip([1e6, 1e-6, 1.0]).zip(factors) {
            entry.difference *= unit;
            entry.reported = factor * entry.difference;
        }
        assert_eq!(all.cause(parameter, &RIGHT).as_deref(), Some(cause));
    }

    #[test]
    fn unexplained_derivative_has_no_cause() {
        assert_eq!(cause("young", [f64::NAN, 3.7, 3.0]), "");
        assert_eq!(cause("yield", [-3.6, 3.7, 3.0]), "");
    }
}
