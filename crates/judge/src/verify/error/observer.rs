//! Records the velocity at one label over time, and interpolates the displacement at a point.

use crate::exact::Truth;
use mpm_subject::Samples;
use serde::{Deserialize, Serialize};

/// Velocity at one label over a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct History {
    /// Reference position (m) of the observed label, the one nearest to the requested point.
    pub label: Vec<f64>,
    /// Time (s), and the first component of the computed and the exact velocity (m/s).
    pub velocity: Vec<[f64; 3]>,
}

impl History {
    /// Starts the history of the label of `samples` that is nearest to `wanted`, the first of
    /// equally near ones. `None` without labels, or if the solver reports no velocities.
    pub fn start(samples: &Samples, wanted: &[f64]) -> Option<(usize, Self)> {
        let d = samples.dimension;
        let distance = |p: usize| -> f64 {
            let label = &samples.label[p * d..(p + 1) * d];
            label.iter().zip(wanted).map(|(a, b)| (a - b) * (a - b)).sum()
        };
        let count = if samples.velocity.is_empty() { 0 } else { samples.len() };
        let nearest = (0..count)
            .reduce(|best, p| if distance(p) < distance(best) * (1.0 - 1e-9) { p } else { best })?;
        let label = samples.label[nearest * d..(nearest + 1) * d].to_vec();
        Some((nearest, Self { label, velocity: Vec::new() }))
    }

    /// Records the velocity at an instant. `at` is the index of the observed label.
    pub fn record(&mut self, at: usize, samples: &Samples, truth: &dyn Truth, t: f64) {
        let mut exact = vec![0.0; samples.dimension];
        truth.velocity(&self.label, t, &mut exact);
        self.velocity.push([t, samples.velocity[at * samples.dimension], exact[0]]);
    }

    /// Returns the RMS of the velocity error over time, relative to the largest exact speed; `None`
    /// if the exact velocity is always zero.
    pub fn relative_error(&self) -> Option<f64> {
        let square: f64 = self.velocity.iter().map(|[_, v, e]| (v - e) * (v - e)).sum();
        let largest = self.velocity.iter().map(|[_, _, e]| e.abs()).fold(0.0, f64::max);
        (largest > 0.0).then(|| (square / self.velocity.len() as f64).sqrt() / largest)
    }
}

const NEAR: usize = 4;

/// Interpolates the displacement at a fixed point by cubic Lagrange interpolation, from up to four
/// labels around the point on each axis. `None` if the labels near the point do not form a lattice.
pub fn displacement_at(samples: &Samples, place: &[f64]) -> Option<Vec<f64>> {
    let d = samples.dimension;
    if d == 0 || place.len() != d || samples.is_empty() {
        return None;
    }
    let axes: Vec<Vec<(f64, f64)>> = (0..d).map(|axis| near(samples, axis, place[axis])).collect();
    let mut interpolated = vec![0.0; d];
    for k in 0..axes.iter().map(Vec::len).product() {
        let mut rest = k;
        let corner = axes.iter().map(|near| {
            let i = rest % near.len();
            rest /= near.len();
            near[i]
        });
        let (label, weights): (Vec<f64>, Vec<f64>) = corner.unzip();
        let weight: f64 = weights.iter().product();
        let p = samples.label.chunks_exact(d).position(|at| at == label)?;
        for (sum, u) in interpolated.iter_mut().zip(&samples.displacement[p * d..]) {
            *sum += weight * u;
        }
    }
    Some(interpolated)
}

/// Returns the lattice coordinates around `x` on an axis, each with its Lagrange weight.
fn near(samples: &Samples, axis: usize, x: f64) -> Vec<(f64, f64)> {
    let mut all: Vec<f64> =
        samples.label.iter().skip(axis).step_by(samples.dimension).copied().collect();
    all.sort_by(f64::total_cmp);
    all.dedup();
    let (first, weights) = lagrange_weights(&all, x, NEAR);
    all[first..].iter().copied().zip(weights).collect()
}

/// Computes the weights of the Lagrange interpolation at `x` from the `count` nearest of the
/// ascending coordinates `sorted`, or from all if there are fewer. Also returns the index of the
/// first coordinate used.
pub fn lagrange_weights(sorted: &[f64], x: f64, count: usize) -> (usize, Vec<f64>) {
    let count = sorted.len().min(count);
    let above = sorted.partition_point(|c| *c < x);
    let first = above.saturating_sub(count / 2).min(sorted.len() - count);
    let near = &sorted[first..first + count];
    let weight = |c: &f64| -> f64 {
        near.iter().filter(|other| *other != c).map(|other| (x - other) / (c - other)).product()
    };
    (first, near.iter().map(weight).collect())
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use rstest::rstest;

    fn cubic(labels: &[f64]) -> Samples {
        Samples {
            dimension: 1,
            label: labels.to_vec(),
            displacement: labels.iter().map(|x| 1.0 - x + 3.0 * x * x * x).collect(),
            velocity: labels.to_vec(),
            weight: vec![1.0; labels.len()],
            ..Samples::default()
        }
    }

    #[rstest]
    fn a_cubic_is_interpolated_exactly(#[values(0.5, 0.0, 0.31, 1.0)] x: f64) {
        let samples = cubic(&[0.9, 0.1, 0.3, 0.5, 0.7, 0.2]);
        let u = displacement_at(&samples, &[x]).unwrap();
        assert_relative_eq!(u[0], 1.0 - x + 3.0 * x * x * x, max_relative = 1e-12);
    }

    /// Creates five labels along X and two along Y. The displacement is cubic in X and linear in Y.
    fn plate() -> Samples {
        let labels = (0..10).map(|p| [f64::from(p % 5) / 4.0, f64::from(p / 5)]);
        let field = |[x, y]: [f64; 2]| [x * x * x * (1.0 + y), 2.0 * y - x];
        Samples {
            dimension: 2,
            label: labels.clone().flatten().collect(),
            displacement: labels.flat_map(field).collect(),
            weight: vec![1.0; 10],
            ..Samples::default()
        }
    }

    #[test]
    fn a_lattice_is_interpolated_axis_by_axis() {
        let u = displacement_at(&plate(), &[0.3, 0.7]).unwrap();
        assert_relative_eq!(u[0], 0.027 * 1.7, max_relative = 1e-12);
        assert_relative_eq!(u[1], 1.1, max_relative = 1e-12);
    }

    #[test]
    fn no_interpolation_without_a_lattice() {
        let mut moved = plate();
        moved.label[2] += 0.01;
        assert_eq!(displacement_at(&moved, &[0.3, 0.7]), None);
        assert_eq!(displacement_at(&Samples::default(), &[]), None);
        assert_eq!(displacement_at(&plate(), &[0.3]), None);
    }

    #[test]
    fn history_belongs_to_its_label() {
        struct Falls;
        impl Truth for Falls {
            fn displacement(&self, _: &[f64], _: f64, _: &mut [f64]) {}
            fn velocity(&self, _: &[f64], t: f64, into: &mut [f64]) {
                into.copy_from_slice(&[2.0 * t, -t]);
            }
        }
        let velocity = (0..20).map(f64::from).collect();
        let samples = Samples { velocity, ..plate() };
        let (at, mut history) = History::start(&samples, &[0.8, 1.1]).unwrap();
        assert_eq!((at, history.label.as_slice()), (8, &[0.75, 1.0][..]));
        history.record(at, &samples, &Falls, 7.0);
        assert_eq!(history.velocity, [[7.0, 16.0, 14.0]]);
    }

    /// Errors of 3e-6 and 4e-6 m/s have the RMS 5e-6/sqrt(2), and the largest exact speed is 1e-5.
    #[test]
    fn velocity_error_is_relative_to_the_largest_exact_speed() {
        let velocity = vec![[0.0, 7e-6, 4e-6], [1.0, -1.4e-5, -1e-5]];
        let history = History { label: vec![0.0], velocity };
        assert_relative_eq!(
            history.relative_error().unwrap(),
            0.5 / 2.0_f64.sqrt(),
            epsilon = 1e-14
        );
    }

    #[test]
    fn a_truth_at_rest_has_no_relative_velocity_error() {
        let history = History { label: vec![0.0], velocity: vec![[0.0, 1e-9, 0.0]] };
        assert_eq!(history.relative_error(), None);
    }

    #[test]
    fn first_of_two_equally_near_labels_is_observed() {
        let (index, history) = History::start(&cubic(&[0.1, 0.45, 0.55, 0.9]), &[0.5]).unwrap();
        assert_eq!((index, history.label), (1, vec![0.45]));
    }

    #[test]
    fn nothing_is_observed_without_labels() {
        assert_eq!(History::start(&Samples::default(), &[0.5]), None);
    }

    /// Both sides contribute equally many points, except at the ends of the lattice.
    #[rstest]
    #[case::inside(3.5, 2)]
    #[case::at_the_low_end(0.2, 0)]
    #[case::at_the_high_end(6.9, 4)]
    fn the_nearest_on_both_sides_are_taken(#[case] x: f64, #[case] first: usize) {
        let lattice: Vec<f64> = (0..8).map(f64::from).collect();
        assert_eq!(lagrange_weights(&lattice, x, 4).0, first);
    }
}
