//! Levels that the judge does not count because their error is not a discretisation error.
//!
//! - *Rounding*: the solver uses single precision, and its displacement error lies below the bound
//!   on the accumulated rounding error of positions ([`rounding_bound`]).
//! - *Spread*: the difference between repeated runs exceeds [`MOST_SPREAD`] of the error.
//!
//! Both rules apply to observed orders only: a small error meets a bound regardless of its cause.

use crate::verify::{Axis, Judgement, LevelOutcome, NormName, Verdict, format_number, rounded};
use mpm_subject::named;

/// Maximum spread of a level that counts, as a fraction of its error.
const MOST_SPREAD: f64 = 0.1;

named! {
    /// Reason why a level does not count for the observed order.
    pub enum Exclusion {
        /// Particles change their cell. The theory of the method does not cover such changes.
        Crossings = "crossings",
        /// The error lies below the bound of rounding errors.
        Rounding = "rounding",
        /// Repeated runs differ by more than a tenth of the error.
        Spread = "spread",
    }
}

/// Returns the distance (m) between `largest`, the largest absolute coordinate (m) of a particle,
/// and the next smaller single-precision number. `None` if `largest` is zero or not a normal number
/// in single precision.
pub fn single_precision_spacing(largest: f64) -> Option<f64> {
    // The coordinate is rounded first: 1 + 1e-16, for example, is 1 in single precision.
    let largest = largest as f32;
    let is_normal = largest.is_normal() && largest > 0.0;
    is_normal.then(|| f64::from(largest) - f64::from(largest.next_down()))
}

/// Returns the bound (m), in `norm`, on the accumulated rounding error of positions after `steps`
/// steps. In each step positions are rounded to multiples of `spacing` (m).
///
/// One rounding error is uniform in `[-spacing/2, spacing/2]`, with the root mean square
/// `spacing/sqrt 12`. In the worst case all rounding errors are equal, because increments change
/// little from step to step. The sum of N rounding errors is then `N spacing/sqrt 12` in the RMS
/// norm, and `N spacing/2` in the maximum norm.
pub fn rounding_bound(steps: u64, spacing: f64, norm: NormName) -> f64 {
    let most = steps as f64 * spacing;
    match norm {
        NormName::Linf | NormName::MaxLinf => 0.5 * most,
        _ => most / 12.0_f64.sqrt(),
    }
}

impl LevelOutcome {
    /// Returns the reason why the level does not count for the observed order; `None` if it counts.
    pub fn exclusion(&self) -> Option<Exclusion> {
        let is_steady = |spread: f64| spread <= MOST_SPREAD * self.error;
        if !self.usable {
            Some(Exclusion::Crossings)
        } else if self.run.failure.is_some() {
            // Failed levels are judged as failures.
            None
        } else if self.is_below_rounding {
            Some(Exclusion::Rounding)
        } else if !self.spread.is_none_or(is_steady) {
            Some(Exclusion::Spread)
        } else {
            None
        }
    }
}

fn excluded(levels: &[LevelOutcome], by: Exclusion) -> Vec<&LevelOutcome> {
    levels.iter().filter(|level| level.exclusion() == Some(by)).collect()
}

/// Whether too few levels remain for an order if rounding excludes levels.
pub(super) fn leaves_too_few(levels: &[LevelOutcome], judgement: &Judgement) -> bool {
    judgement.verdict == Verdict::TooFewLevels && !excluded(levels, Exclusion::Rounding).is_empty()
}

/// Adds the levels that rounding and spread exclude to the reason of a judgement.
pub(super) fn with_exclusions(
    judgement: Judgement,
    levels: &[LevelOutcome],
    axis: Axis,
) -> Judgement {
    let remarks = [rounding_remark(levels, &judgement, axis), spread_remark(levels, axis)];
    let parts = std::iter::once(judgement.reason.clone()).chain(remarks.into_iter().flatten());
    let parts: Vec<String> = parts.filter(|part| !part.is_empty()).collect();
    Judgement { reason: parts.join("; "), ..judgement }
}

/// Describes the excluded levels, such as `down to rounding: from 128 cells on ...`.
fn rounding_remark(levels: &[LevelOutcome], judgement: &Judgement, axis: Axis) -> Option<String> {
    let all = excluded(levels, Exclusion::Rounding);
    let (first, last) = (all.first()?, all.last()?);
    let name = first.name(axis);
    let bound = |level: &LevelOutcome| shown(level.rounding_bound);
    let is_tail = levels[levels.len() - all.len()..]
        .iter()
        .all(|level| level.exclusion() == Some(Exclusion::Rounding));
    let too_few = judgement.verdict == Verdict::TooFewLevels;
    let remark = if is_tail && judgement.verdict == Verdict::Converging {
        format!(
            "down to rounding: from {name} on the error lies below the rounding bound, {} m there",
            bound(first)
        )
    } else {
        let names: Vec<String> = all.iter().map(|level| level.name(axis)).collect();
        let bounds = if all.len() == 1 {
            bound(first)
        } else {
            format!("{} ... {}", bound(first), bound(last))
        };
        format!(
            "not counted because the error lies below the rounding bound of single precision \
             ({bounds} m): {}",
            names.join(", ")
        )
    };
    let advice = "; a larger amplitude raises the errors above the bound";
    Some(if too_few { remark + advice } else { remark })
}

fn spread_remark(levels: &[LevelOutcome], axis: Axis) -> Option<String> {
    let all = excluded(levels, Exclusion::Spread);
    let part = |level: &&LevelOutcome| format!("{} ({})", level.name(axis), shown(level.spread));
    let parts: Vec<String> = all.iter().map(part).collect();
    (!parts.is_empty()).then(|| {
        format!(
            "not counted because the spread between runs exceeds a tenth of the error: {}",
            parts.join(", ")
        )
    })
}

fn shown(value: Option<f64>) -> String {
    value.map_or("none".to_owned(), |value| format_number(rounded(value, 2)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::convergence::tests::study;
    use rstest::rstest;

    /// A coordinate may exceed a power of two by less than its rounding error.
    #[test]
    fn spacing_is_that_below_the_largest_coordinate() {
        let exponents = [1.0, 1.0 + 1e-15, 2.0, 1.001, 8.0]
            .map(|largest| single_precision_spacing(largest).map(libm::log2));
        assert_eq!(exponents, [-24.0, -24.0, -23.0, -23.0, -21.0].map(Some));
        assert_eq!([0.0, 1e39, f64::NAN].map(single_precision_spacing), [None; 3]);
    }

    /// By hand for 1200 steps and a spacing of 1e-6 m: 1.2e-3/sqrt(12) m, and 1.2e-3/2 m.
    #[test]
    fn rounding_errors_of_all_steps_add_up() {
        for &norm in NormName::ALL {
            let is_largest = matches!(norm, NormName::Linf | NormName::MaxLinf);
            let bound = if is_largest { 6e-4 } else { 3.464_101_615_137_754e-4 };
            let found = rounding_bound(1200, 1e-6, norm);
            assert!((found / bound - 1.0).abs() < 1e-14, "{norm:?}: {found}");
        }
    }

    fn level(error: f64, bound: Option<f64>, spread: Option<f64>) -> LevelOutcome {
        let mut level = study(&[error]).levels.remove(0);
        (level.rounding_bound, level.spread) = (bound, spread);
        level.is_below_rounding = bound.is_some_and(|bound| error < bound);
        level
    }

    #[rstest]
    #[case::at_the_bound(level(1.0, Some(1.0), None), None)]
    #[case::below_the_bound(level(0.9, Some(1.0), None), Some(Exclusion::Rounding))]
    #[case::at_a_tenth(level(1.0, None, Some(0.1)), None)]
    #[case::below_a_tenth_of_a_small_error(level(1e-6, None, Some(0.99e-7)), None)]
    #[case::above_a_tenth(level(1e6, None, Some(1.01e5)), Some(Exclusion::Spread))]
    #[case::unknown_spread(level(1.0, None, Some(f64::NAN)), Some(Exclusion::Spread))]
    #[case::no_error_and_no_spread(level(0.0, None, Some(0.0)), None)]
    #[case::unknown_error(level(f64::NAN, Some(1.0), None), None)]
    fn rounding_and_spread_exclude_levels(
        #[case] level: LevelOutcome,
        #[case] expected: Option<Exclusion>,
    ) {
        assert_eq!(level.exclusion(), expected);
    }

    #[test]
    fn excluded_levels_are_listed_with_their_own_bounds() {
        let mut levels: Vec<LevelOutcome> =
            [4.0, 0.9, 0.4, 0.3].map(|e| level(e, None, None)).into();
        for (k, level) in levels.iter_mut().enumerate() {
            level.cells = 10 + k as u64;
        }
        for (k, bound) in [(2, 0.41), (3, 0.31)] {
            (levels[k].rounding_bound, levels[k].is_below_rounding) = (Some(bound), true);
        }
        levels[1].spread = Some(0.123);
        let reason = |verdict: Verdict, levels: &[LevelOutcome]| {
            let judgement = Judgement { verdict, ..study(&[1.0]).judgement };
            let judgement = Judgement { reason: "why".to_owned(), ..judgement };
            with_exclusions(judgement, levels, Axis::Space).reason
        };
        let spread = "; not counted because the spread between runs exceeds a tenth of the error: 11 cells (0.12)";
        let down = "why; down to rounding: from 12 cells on the error lies below the rounding \
                    bound, 0.41 m there";
        assert_eq!(reason(Verdict::Converging, &levels), format!("{down}{spread}"));
        let below = "why; not counted because the error lies below the rounding bound of single \
                     precision (0.41 ... 0.31 m): 12 cells, 13 cells";
        let advice = "; a larger amplitude raises the errors above the bound";
        assert_eq!(reason(Verdict::TooFewLevels, &levels), format!("{below}{advice}{spread}"));
        levels.swap(0, 3);
        let below = below.replace("0.41 ... 0.31", "0.31 ... 0.41");
        let below = below.replace("12 cells, 13 cells", "13 cells, 12 cells");
        assert_eq!(reason(Verdict::Converging, &levels), format!("{below}{spread}"));
    }
}
