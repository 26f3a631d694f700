//! Growth or decay rate of the energy over a long run, with a confidence interval.
//!
//! The energy of an oscillating body oscillates too, so neighbouring instants are not independent.
//! The run is therefore divided into ten equal parts, and a line is fitted to the means of ln E
//! over each part (the method of batch means; Law, *Simulation Modeling and Analysis*, 5th ed.,
//! section 9.5.3). The slope is the rate, d ln E/dt (1/s), with an interval from Student's t.
//!
//! The interval contains the rate with a probability of 95 % if the parts are much longer than a
//! period and the means deviate independently. A non-linear drift counts as noise.

use super::order::fit::{FittedLine, Interval, LogPoint};
use mpm_subject::Totals;

const PARTS: usize = 10;

/// Minimum number of instants per part.
const LEAST: usize = 5;

/// Computes the energy rate (1/s) of a run from equally spaced instants. `None` if there are fewer
/// than fifty instants, or if the energy is unknown or not positive at one of them.
pub(crate) fn energy_rate(account: &[(f64, Totals)]) -> Option<Interval> {
    let each = account.len() / PARTS;
    if each < LEAST {
        return None;
    }
    // Drops the first instants if their number is not a multiple of the number of parts.
    let seen = &account[account.len() - PARTS * each..];
    let means = seen.chunks_exact(each).enumerate().map(|(level, part)| {
        let logarithm = |(t, totals): &(f64, Totals)| {
            let energy = totals.energy().filter(|energy| *energy > 0.0)?;
            Some((*t, libm::log(energy)))
        };
        let (t, y): (Vec<f64>, Vec<f64>) =
            part.iter().map(logarithm).collect::<Option<Vec<_>>>()?.into_iter().unzip();
        let mean = |all: Vec<f64>| all.iter().sum::<f64>() / each as f64;
        Some(LogPoint { level, x: mean(t), y: mean(y) })
    });
    let rate = FittedLine::through(&means.collect::<Option<Vec<_>>>()?)?.order();
    (rate.low + rate.high).is_finite().then_some(rate)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::{assert_abs_diff_eq, assert_relative_eq};
    use rstest::rstest;

    /// Creates `n` instants whose energy alternates between kinetic and stored energy.
    fn account(n: usize, energy: impl Fn(f64) -> f64) -> Vec<(f64, Totals)> {
        let at = |i: usize| {
            let (t, share) = (i as f64, (i % 3) as f64 / 2.0);
            let (kinetic_energy, stored) = (energy(t) * share, energy(t) * (1.0 - share));
            (t, Totals { kinetic_energy, strain_energy: Some(stored), ..Totals::default() })
        };
        (0..n).map(at).collect()
    }

    #[rstest]
    fn exponential_energy_has_its_exact_rate(#[values(0.0, -0.01, 3e-5)] rate: f64) {
        // The first three of 203 instants do not fit into ten equal parts.
        let energy = |t: f64| if t < 3.0 { 1e6 } else { 7.0 * libm::exp(rate * t) };
        let found = energy_rate(&account(203, energy)).unwrap();
        assert_abs_diff_eq!(found.value, rate, epsilon = 1e-12);
        assert_abs_diff_eq!(found.half_width(), 0.0, epsilon = 1e-12);
    }

    /// An oscillation of 10 % with a period of twenty instants.
    #[test]
    fn oscillation_is_not_a_drift() {
        let swing = |t: f64| 1.0 + 0.1 * libm::sin(t * std::f64::consts::PI / 10.0);
        let whole = energy_rate(&account(1000, |t| swing(t) * libm::exp(-1e-4 * t))).unwrap();
        assert_relative_eq!(whole.value, -1e-4, max_relative = 1e-9);
        let torn = energy_rate(&account(1130, |t| swing(t) * libm::exp(-1e-4 * t))).unwrap();
        assert!(torn.low < -1e-4 && -1e-4 < torn.high && torn.half_width() > 1e-7, "{torn:?}");
        // An incomplete period in a part has little effect on the mean of the part.
        assert!(torn.half_width() < 1e-2 / 1000.0, "{torn:?}");
    }

    /// By hand for ten parts of 5 s with ln E = 1 and -1 in turn: `Sxx = 25 * 82.5`, `Sxy = -25`,
    /// `rss = 10 - 25/82.5`, and t(0.975, 8) = 2.306.
    #[test]
    fn interval_of_a_rate_by_hand() {
        let is_even = |t: f64| ((t / 5.0) as u32).is_multiple_of(2);
        let energy = |t: f64| libm::exp(if is_even(t) { 1.0 } else { -1.0 });
        let rate = energy_rate(&account(50, energy)).unwrap();
        assert_relative_eq!(rate.value, -1.0 / 82.5, max_relative = 1e-12);
        let half_width = 2.306 * ((10.0 - 25.0 / 82.5) / 8.0 / (25.0 * 82.5_f64)).sqrt();
        assert_relative_eq!(rate.half_width(), half_width, max_relative = 1e-4);
    }

    #[test]
    fn too_few_or_invalid_energies_have_no_rate() {
        assert_eq!(energy_rate(&account(49, |_| 1.0)), None);
        assert_eq!(energy_rate(&account(100, |t| 50.0 - t)), None);
        assert_eq!(energy_rate(&account(100, |t| if t > 98.0 { f64::NAN } else { 1.0 })), None);
        let mut silent = account(100, |_| 1.0);
        silent[40].1.strain_energy = None;
        assert_eq!(energy_rate(&silent), None);
    }
}
