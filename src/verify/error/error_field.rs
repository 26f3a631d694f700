//! Errors over the body at the end of a run, reduced to the resolution of a drawing.

use super::norm::{larger, length};
use super::quantity::Quantity;
use crate::exact::Truth;
use crate::subject::Samples;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Number of parts along the longer side of a plane body, as many as a drawing can show.
const SQUARES: f64 = 20.0;
const PARTS: f64 = 80.0;

/// Fraction of a part below which a distance counts as rounding error.
const ROUNDING: f64 = 1e-9;

/// The largest error in each part of the body. In 3-D the body is divided along the first two axes
/// only, and each part extends along the whole third axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ErrorField {
    /// Whether the parts cover a plane rather than a line.
    pub is_plane: bool,
    /// Size of a part (m).
    pub size: f64,
    /// Current position (m) of the middle, and largest error magnitude, for each part that contains
    /// particles. The error is NaN if any error in the part is NaN. A part is a square, or an
    /// interval in 1-D, or one particle if particles are larger than parts.
    pub parts: Vec<[f64; 3]>,
}

impl ErrorField {
    /// Computes the errors of the quantity `of` in `samples` against `truth` at time `t` (s).
    /// `None` if the quantity has no errors at labels, or if no two particles have different
    /// positions.
    pub(super) fn of(of: Quantity, samples: &Samples, truth: &dyn Truth, t: f64) -> Option<Self> {
        let (components, errors) = of.differences(samples, truth, t)?;
        let d = samples.dimension;
        let places = samples.label.chunks(d).zip(samples.displacement.chunks(d)).map(|(x, u)| {
            let place = |axis: usize| Some(x.get(axis)? + u.get(axis)?);
            [place(0).unwrap_or(f64::NAN), place(1).unwrap_or(0.0)]
        });
        let seen: Vec<([f64; 2], f64)> = places
            .zip(errors.chunks(components).map(length))
            .filter(|(place, _)| place.iter().all(|x| x.is_finite()))
            .collect();
        let low =
            seen.iter().fold([f64::INFINITY; 2], |low, (x, _)| [0, 1].map(|i| low[i].min(x[i])));
        let high = seen
            .iter()
            .fold([f64::NEG_INFINITY; 2], |high, (x, _)| [0, 1].map(|i| high[i].max(x[i])));
        let length = (high[0] - low[0]).max(high[1] - low[1]);
        let size = length / if d > 1 { SQUARES } else { PARTS };
        if !(size > 0.0 && size.is_finite()) {
            return None;
        }
        // If parts would be smaller than particles, each particle is one part.
        let volume = samples.weight.iter().sum::<f64>() / samples.len() as f64;
        let spacing = libm::pow(volume, 1.0 / d as f64);
        let is_coarse = spacing >= size;
        let mut parts: BTreeMap<[i64; 2], [f64; 3]> = BTreeMap::new();
        // A particle at the end of the body belongs to the last part, not to an additional one.
        let end = [0, 1].map(|axis| (high[axis] - low[axis]) / size);
        let last = end
            .map(|end| if is_coarse { end } else { (libm::ceil(end - ROUNDING) - 1.0).max(0.0) });
        for (x, error) in seen {
            let part = |axis: usize| libm::floor((x[axis] - low[axis]) / size).min(last[axis]);
            let part = [0, 1].map(part);
            let place = [0, 1].map(|axis| low[axis] + (part[axis] + 0.5) * size);
            let [x, y] = if is_coarse { x } else { place };
            let worst = parts.entry(part.map(|k| k as i64)).or_insert([x, y, error]);
            worst[2] = larger(worst[2], error);
        }
        let size = if is_coarse { spacing } else { size };
        Some(Self { is_plane: d > 1, size, parts: parts.into_values().collect() })
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use rstest::rstest;

    pub(in crate::verify::error) struct AtRest;

    impl Truth for AtRest {
        fn displacement(&self, _: &[f64], _: f64, into: &mut [f64]) {
            into.fill(0.0);
        }

        fn velocity(&self, _: &[f64], _: f64, into: &mut [f64]) {
            into.fill(0.0);
        }
    }

    /// Creates a square with `n` particles along each side. The displacement of each particle is
    /// its number times 1e-6.
    fn square(n: usize) -> Samples {
        let mut samples = Samples::default();
        for p in 0..n * n {
            let label = [(p % n) as f64, (p / n) as f64].map(|x| x / n as f64);
            samples.push(&label, &[p as f64 * 1e-6, 0.0], &[0.0, 0.0], 1.0);
        }
        samples
    }

    #[rstest]
    #[case::each_in_its_own_part(10, 100)]
    #[case::several_in_a_part(100, 441)]
    fn every_part_has_its_worst_error(#[case] n: usize, #[case] most: usize) {
        let field = ErrorField::of(Quantity::Displacement, &square(n), &AtRest, 0.0).unwrap();
        assert!(field.is_plane && field.parts.len() <= most, "{}", field.parts.len());
        let largest = field.parts.iter().map(|part| part[2]).fold(0.0, f64::max);
        assert_eq!(largest, (n * n - 1) as f64 * 1e-6);
    }

    #[test]
    fn parts_cover_the_whole_body() {
        let mut samples = square(32);
        samples.weight.fill(1.0 / 1024.0);
        for (p, u) in samples.displacement.iter_mut().enumerate() {
            *u = 1e-9 * (p * 7 % 5) as f64;
        }
        let field = ErrorField::of(Quantity::Displacement, &samples, &AtRest, 0.0).unwrap();
        assert_eq!(field.parts.len(), 400);
    }

    /// A particle without a position is excluded. A NaN error makes the error of its part NaN.
    #[test]
    fn nan_is_seen() {
        let mut samples = square(10);
        samples.velocity[1] = f64::NAN;
        samples.displacement[40] = f64::NAN;
        let field = ErrorField::of(Quantity::Velocity, &samples, &AtRest, 0.0).unwrap();
        assert_eq!(field.parts.len(), 99);
        assert_eq!(field.parts.iter().filter(|part| part[2].is_nan()).count(), 1);
    }

    #[test]
    fn single_particle_has_no_field() {
        assert_eq!(ErrorField::of(Quantity::Displacement, &square(1), &AtRest, 0.0), None);
    }

    #[test]
    fn a_part_shows_its_largest_error_in_its_middle() {
        let mut samples = Samples::default();
        for (x, u) in [(0.0, 0.0), (1.01, 5e-3), (1.02, 1e-3), (80.0, 0.0)] {
            samples.push(&[x - u], &[u], &[0.0], 0.01);
        }
        let field = ErrorField::of(Quantity::Displacement, &samples, &AtRest, 0.0).unwrap();
        let found: Vec<[f64; 2]> = field.parts.iter().map(|[x, _, error]| [*x, *error]).collect();
        assert_eq!(found, [[0.5, 0.0], [1.5, 5e-3], [79.5, 0.0]]);
    }
}
