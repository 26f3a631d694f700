//! One place of the body, watched over time.

use crate::{exact::Truth, subject::Samples};

/// What was seen at one label during a run.
#[derive(Debug, Clone, PartialEq)]
pub struct History {
    /// Reference position of the label that was watched: the nearest to the wanted one (m).
    pub label: Vec<f64>,
    /// Time (s), first velocity component of the subject and of the truth (m/s), at t = 0 and
    /// at each instant.
    pub velocity: Vec<[f64; 3]>,
}

impl History {
    /// Starts watching the label of `samples` that is nearest to `wanted`; of two equally near
    /// ones the first.
    pub fn start(samples: &Samples, wanted: &[f64]) -> (usize, Self) {
        let d = samples.dimension;
        let distance = |p: usize| -> f64 {
            let label = &samples.label[p * d..(p + 1) * d];
            label.iter().zip(wanted).map(|(a, b)| (a - b) * (a - b)).sum()
        };
        let nearest = (0..samples.len())
            .reduce(|best, p| if distance(p) < distance(best) * (1.0 - 1e-9) { p } else { best })
            .unwrap_or(0);
        let label = samples.label[nearest * d..(nearest + 1) * d].to_vec();
        (nearest, Self { label, velocity: Vec::new() })
    }

    /// Records the state at an instant.
    pub fn record(&mut self, at: usize, samples: &Samples, truth: &dyn Truth, t: f64) {
        let mut exact = vec![0.0; samples.dimension];
        truth.velocity(&self.label, t, &mut exact);
        self.velocity.push([t, samples.velocity[at * samples.dimension], exact[0]]);
    }

    /// RMS over time of the velocity error, relative to the largest exact speed.
    pub fn relative_error(&self) -> f64 {
        let square: f64 = self.velocity.iter().map(|[_, v, e]| (v - e) * (v - e)).sum();
        let largest = self.velocity.iter().map(|[_, _, e]| e.abs()).fold(0.0, f64::max);
        (square / self.velocity.len() as f64).sqrt() / largest
    }
}

/// First component of the displacement at a fixed place of a one-dimensional body: cubic Lagrange
/// interpolation through the four labels around it, so that Richardson's extrapolation compares
/// the same place on every level. `None` with fewer than four labels or in more dimensions.
pub fn displacement_at(samples: &Samples, x: f64) -> Option<f64> {
    let n = samples.len();
    if samples.dimension != 1 || n < 4 {
        return None;
    }
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|a, b| samples.label[*a].total_cmp(&samples.label[*b]));
    let above = order.partition_point(|p| samples.label[*p] < x);
    let first = above.saturating_sub(2).min(n - 4);
    let near = &order[first..first + 4];
    let weight = |p: usize| -> f64 {
        let others = near.iter().filter(|q| **q != p);
        others.map(|q| (x - samples.label[*q]) / (samples.label[p] - samples.label[*q])).product()
    };
    Some(near.iter().map(|p| weight(*p) * samples.displacement[*p]).sum())
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
    #[case(0.5)]
    #[case(0.0)]
    #[case(0.31)]
    #[case(1.0)]
    fn a_cubic_is_interpolated_exactly(#[case] x: f64) {
        let samples = cubic(&[0.9, 0.1, 0.3, 0.5, 0.7, 0.2]);
        let u = displacement_at(&samples, x).unwrap();
        assert_relative_eq!(u, 1.0 - x + 3.0 * x * x * x, max_relative = 1e-12);
    }

    #[test]
    fn of_two_equally_near_labels_the_first_is_watched() {
        let (index, history) = History::start(&cubic(&[0.1, 0.45, 0.55, 0.9]), &[0.5]);
        assert_eq!((index, history.label), (1, vec![0.45]));
    }
}
