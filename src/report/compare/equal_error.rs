//! Compares the work for the same error in two runs.
//!
//! On the same grid, two methods or versions reach different errors, so the work for a target error
//! is compared. Between two levels of a converging series, ln(work) is interpolated linearly in
//! ln(error). This is exact for `error = C h^p` and `work = c h^-q`. Nothing is extrapolated,
//! because the error may stop falling on levels finer than the last one.

/// Error and work of a level.
pub(super) type ErrorAndWork = (f64, f64);

/// Minimum number of consecutive levels with decreasing error that count as convergence.
const LEAST_LEVELS: usize = 3;

/// An error that both runs reach, and the ratio of their work for this error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct EqualError {
    /// The error: 1, 2 or 5 times a power of ten.
    pub(super) target: f64,
    /// Ratio of the new to the old work.
    pub(super) ratio: f64,
}

/// Compares the work at the smallest round error (1, 2 or 5 times a power of ten) within the
/// converging parts of both series. Returns `None` if there is no such error.
pub(super) fn compare(old: &[ErrorAndWork], new: &[ErrorAndWork]) -> Option<EqualError> {
    let (old, new) = (converging(old)?, converging(new)?);
    let lowest = f64::max(old.last()?.0, new.last()?.0);
    let highest = f64::min(old.first()?.0, new.first()?.0);
    let target = round_above(lowest).filter(|target| *target <= highest)?;
    let ratio = work(new, target)? / work(old, target)?;
    Some(EqualError { target, ratio })
}

/// Returns the longest sequence of levels with decreasing error and increasing work. Of two equally
/// long sequences, the coarser one is returned.
fn converging(points: &[ErrorAndWork]) -> Option<&[ErrorAndWork]> {
    let usable = |(error, work): ErrorAndWork| error > 0.0 && work > 0.0;
    let goes_on =
        |a: &ErrorAndWork, b: &ErrorAndWork| usable(*a) && usable(*b) && b.0 < a.0 && b.1 > a.1;
    let runs = points.chunk_by(goes_on).filter(|run| run.len() >= LEAST_LEVELS);
    runs.reduce(|longest, run| if run.len() > longest.len() { run } else { longest })
}

/// Returns the smallest number not below `x` that is 1, 2 or 5 times a power of ten.
fn round_above(x: f64) -> Option<f64> {
    if !(x > 0.0 && x.is_finite()) {
        return None;
    }
    let power = libm::floor(libm::log10(x)) as i32;
    let ladder = [(1, power), (2, power), (5, power), (1, power + 1)];
    // Parsing the decimal text makes the target equal to the printed number.
    let rungs = ladder.iter().filter_map(|(k, power)| format!("{k}e{power}").parse().ok());
    rungs.into_iter().find(|rung| *rung >= x)
}

/// Interpolates the work for an error between the errors of two neighbouring levels.
fn work(run: &[ErrorAndWork], target: f64) -> Option<f64> {
    let (a, b) = run.windows(2).map(|pair| (pair[0], pair[1])).find(|(_, b)| b.0 <= target)?;
    let share = libm::log(a.0 / target) / libm::log(a.0 / b.0);
    Some(a.1 * libm::exp(share * libm::log(b.1 / a.1)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use rstest::rstest;

    /// Creates levels with `error = c h^2` and `work = w h^-3`.
    fn series(c: f64, w: f64, levels: i32) -> Vec<ErrorAndWork> {
        (0..levels)
            .map(|k| libm::exp2(-f64::from(k)))
            .map(|h| (c * h * h, w / (h * h * h)))
            .collect()
    }

    /// With these power laws, the ratio of the work at equal error is (c'/c)^(3/2): eight for four
    /// times the error.
    #[rstest]
    #[case::itself(1.0, 1.0, 1.0)]
    #[case::twice_the_work(1.0, 2.0, 2.0)]
    #[case::four_times_the_error(4.0, 1.0, 8.0)]
    #[case::better_for_more(0.25, 2.0, 0.25)]
    fn power_laws_are_exact(#[case] c: f64, #[case] w: f64, #[case] ratio: f64) {
        let found = compare(&series(1.0, 1.0, 8), &series(c, w, 8)).expect("a common error");
        assert_relative_eq!(found.ratio, ratio, max_relative = 1e-12);
    }

    #[rstest]
    #[case::nothing(&[], None)]
    #[case::two_levels(&[(1.0, 1.0), (0.1, 2.0)], None)]
    #[case::grows(&[(0.1, 1.0), (0.2, 2.0), (0.3, 4.0)], None)]
    #[case::floor(&[(1.0, 1.0), (0.1, 2.0), (0.01, 4.0), (0.01, 8.0)], Some(3))]
    #[case::rises_at_the_end(&[(1.0, 1.0), (0.1, 2.0), (0.01, 4.0), (0.5, 8.0), (0.4, 9.0)], Some(3))]
    #[case::zero_ends_it(&[(1.0, 1.0), (0.1, 2.0), (0.0, 4.0)], None)]
    #[case::nan_ends_it(&[(1.0, 1.0), (0.1, 2.0), (f64::NAN, 4.0), (0.01, 8.0)], None)]
    #[case::work_must_grow(&[(1.0, 4.0), (0.1, 4.0), (0.01, 8.0)], None)]
    fn converging_parts(#[case] points: &[ErrorAndWork], #[case] levels: Option<usize>) {
        assert_eq!(converging(points).map(<[ErrorAndWork]>::len), levels);
    }

    /// Both series converge but have no common error, and nothing is extrapolated.
    #[test]
    fn series_without_common_errors_are_not_compared() {
        assert_eq!(compare(&series(1.0, 1.0, 4), &series(1e-4, 1.0, 4)), None);
    }

    #[rstest]
    #[case(1e-3, 1e-3)]
    #[case(1.01e-3, 2e-3)]
    #[case(2.1e-3, 5e-3)]
    #[case(5.1e-3, 1e-2)]
    #[case(3.0, 5.0)]
    #[case(1e300, 1e300)]
    fn targets_are_round(#[case] x: f64, #[case] target: f64) {
        assert_eq!(round_above(x), Some(target));
    }

    #[rstest]
    #[case(0.0)]
    #[case(f64::NAN)]
    #[case(f64::INFINITY)]
    #[case(-1.0)]
    fn no_target(#[case] x: f64) {
        assert_eq!(round_above(x), None);
    }
}
