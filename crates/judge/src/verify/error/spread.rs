//! Differences between repeated runs of one level.
//!
//! Solvers that add in no fixed order, for instance with atomic additions on a GPU, give different
//! bits in each run. The spread of a level is the largest norm of the differences between two of
//! its runs at each label: errors with equal norms can differ at every label.

use crate::exact::Truth;
use crate::verify::{NormName, Norms, Quantity, RunErrors};
use mpm_subject::Samples;
use std::cmp::Ordering;

/// Judged quantity of one run minus its exact value, which is the same in all runs of a level.
#[derive(Debug, Clone, Default)]
pub struct RunRecord {
    /// Whether all instants are recorded, instead of only the last one.
    over_instants: bool,
    instants: Vec<Instant>,
    /// Error of a judged sum over the body at each instant.
    pub(super) sums: Vec<[f64; 3]>,
}

/// Differences from the exact value at one instant, sorted by label.
#[derive(Debug, Clone)]
struct Instant {
    labels: Vec<f64>,
    weights: Vec<f64>,
    /// Masses (kg); empty if they are unknown.
    masses: Vec<f64>,
    components: usize,
    /// `computed - exact`.
    differences: Vec<f64>,
}

impl RunRecord {
    pub(super) fn for_norm(norm: NormName) -> Self {
        Self { over_instants: norm.is_over_instants(), ..Self::default() }
    }

    pub(super) fn add(&mut self, of: Quantity, samples: &Samples, truth: &dyn Truth, t: f64) {
        if !self.over_instants {
            self.instants.clear();
        }
        let (components, differences) = of.differences(samples, truth, t).unwrap_or_default();
        let (labels, weights) = (samples.label.clone(), samples.weight.clone());
        let masses = samples.mass.clone();
        let instant = Instant { labels, weights, masses, components, differences };
        self.instants.push(instant.sorted(samples.dimension));
    }

    /// Computes the difference between two runs in `norm`, in the unit of the judged quantity. NaN
    /// if the runs have different labels or instants.
    fn difference(&self, other: &Self, norm: NormName) -> f64 {
        let is_alike = self.instants.len() == other.instants.len()
            && self.sums.len() == other.sums.len()
            && !(self.instants.is_empty() && self.sums.is_empty());
        if !is_alike {
            return f64::NAN;
        }
        if !self.sums.is_empty() {
            let all = subtract(self.sums.as_flattened(), other.sums.as_flattened());
            let norms = Norms::of(&all, 3, &vec![1.0; self.sums.len()]);
            return RunErrors { at_end: norms, largest: norms }.in_norm(norm);
        }
        let mut errors = RunErrors::START;
        for (a, b) in self.instants.iter().zip(&other.instants) {
            errors.add(a.difference(b));
        }
        errors.in_norm(norm)
    }
}

impl Instant {
    /// Sorts the labels lexicographically. The order of particles may differ between runs.
    fn sorted(self, dimension: usize) -> Self {
        let d = dimension.max(1);
        let count = self.weights.len();
        let is_whole =
            self.labels.len() == d * count && self.differences.len() == self.components * count;
        if !is_whole {
            return self;
        }
        let label = |p: usize| &self.labels[d * p..d * (p + 1)];
        let order = |a: &usize, b: &usize| {
            let along = label(*a).iter().zip(label(*b)).map(|(a, b)| a.total_cmp(b));
            along.fold(Ordering::Equal, Ordering::then)
        };
        let mut places: Vec<usize> = (0..count).collect();
        places.sort_by(order);
        let n = self.components;
        let rows = |values: &[f64], n: usize| -> Vec<f64> {
            places.iter().flat_map(|p| values[n * p..n * (p + 1)].to_vec()).collect()
        };
        Self {
            labels: rows(&self.labels, d),
            weights: rows(&self.weights, 1),
            masses: if self.masses.len() == count { rows(&self.masses, 1) } else { self.masses },
            differences: rows(&self.differences, n),
            components: n,
        }
    }

    fn difference(&self, other: &Self) -> Norms {
        if self.labels != other.labels || self.components != other.components {
            return Norms::NONE;
        }
        let all = subtract(&self.differences, &other.differences);
        let norms = Norms::of(&all, self.components, &self.weights);
        norms.with_masses(&all, self.components, &self.masses)
    }
}

fn subtract(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

/// Computes the largest difference between two of `runs` in `norm`, in the unit of the judged
/// quantity. NaN if any two runs cannot be compared.
pub fn spread(runs: &[RunRecord], norm: NormName) -> f64 {
    let pairs = runs.iter().enumerate().flat_map(|(k, a)| runs[..k].iter().map(move |b| (a, b)));
    pairs.map(|(a, b)| a.difference(b, norm)).fold(0.0, super::norm::larger)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::error::run::tests::AtRest;
    use approx::assert_relative_eq;
    use rstest::rstest;

    /// Creates a run with one instant, with the given labels (m) and displacements (m). The second
    /// label has three times the weight and twice the mass of the first one.
    fn record(points: &[(f64, f64)], norm: NormName) -> RunRecord {
        let mut samples = Samples::default();
        for (label, u) in points {
            samples.push(&[*label], &[*u], &[0.0], 1.0 + 2.0 * label);
            samples.mass.push(1.0 + label);
        }
        let mut record = RunRecord::for_norm(norm);
        record.add(Quantity::Displacement, &samples, &AtRest, 0.0);
        record
    }

    /// The first two runs have equal sizes, but differ at each label. The last two differ most, by
    /// 2e-6 and 4e-6 m.
    #[rstest]
    #[case(NormName::Linf, 4.0)]
    #[case(NormName::Rms, 10.0_f64.sqrt())]
    #[case(NormName::L1, 3.5)]
    #[case(NormName::L2, 13.0_f64.sqrt())]
    #[case(NormName::MaxMassL2, 12.0_f64.sqrt())]
    fn spread_is_the_largest_difference_of_two_runs(#[case] norm: NormName, #[case] expected: f64) {
        let runs = [[2e-6, 1e-6], [1e-6, 2e-6], [3e-6, -2e-6]];
        // The order of particles adds no spread.
        let run = |[a, b]: [f64; 2]| {
            let mut points = [(0.0, a), (1.0, b)];
            if a > 1.5e-6 {
                points.reverse();
            }
            record(&points, norm)
        };
        assert_relative_eq!(spread(&runs.map(run), norm), 1e-6 * expected, max_relative = 1e-14);
    }

    /// Two runs differ by 5 m at the first and by 1 m at the last instant.
    #[test]
    fn only_norms_over_instants_compare_all_instants() {
        for (norm, expected) in [(NormName::Linf, 1.0), (NormName::MaxLinf, 5.0)] {
            let run = |first: f64, last: f64| {
                let mut run = record(&[(0.0, first)], norm);
                let mut samples = Samples::default();
                samples.push(&[0.0], &[last], &[0.0], 1.0);
                run.add(Quantity::Displacement, &samples, &AtRest, 1.0);
                run
            };
            assert_eq!(spread(&[run(1.0, 3.0), run(6.0, 4.0)], norm), expected);
        }
    }

    #[test]
    fn runs_with_different_labels_have_no_spread() {
        let norm = NormName::Rms;
        let runs = [record(&[(0.0, 1.0)], norm), record(&[(0.5, 1.0)], norm)];
        assert!(spread(&runs, norm).is_nan());
        assert!(spread(&[RunRecord::default(), RunRecord::default()], norm).is_nan());
    }

    #[test]
    fn sums_over_the_body_are_compared_over_the_instants() {
        let run = |value: f64| {
            let mut record = RunRecord::for_norm(NormName::MaxLinf);
            record.sums = vec![[0.0; 3], [0.0, 3.0 * value, 4.0 * value]];
            record
        };
        let of = |norm| spread(&[run(1.0), run(3.0)], norm);
        assert_eq!((of(NormName::MaxLinf), of(NormName::L1)), (10.0, 5.0));
    }
}
