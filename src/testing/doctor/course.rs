//! Runs as they were seen, and figures of them.

use super::vectors::{AffineField, minus, size};
use crate::external::LevelProblem;
use crate::subject::{Samples, Subject};

/// The states of a run, the first one that of the start.
pub(super) struct Course {
    pub(super) problem: LevelProblem,
    /// Times (s) of the states.
    pub(super) times: Vec<f64>,
    pub(super) states: Vec<Samples>,
    /// Why it did not get to its end, if it did not.
    pub(super) failure: Option<String>,
}

/// A column of a state.
pub(super) type Field = fn(&Samples) -> &[f64];

/// Displacements (m).
pub(super) fn displacement(samples: &Samples) -> &[f64] {
    &samples.displacement
}

/// Velocities (m/s).
pub(super) fn velocity(samples: &Samples) -> &[f64] {
    &samples.velocity
}

impl Course {
    pub(super) fn new(problem: &LevelProblem) -> Self {
        let (times, states) = (Vec::new(), Vec::new());
        Self { problem: problem.clone(), times, states, failure: None }
    }

    pub(super) fn look(&mut self, time: f64, subject: &dyn Subject) {
        let mut samples = Samples::default();
        subject.sample(&mut samples);
        self.times.push(time);
        self.states.push(samples);
    }

    /// Sets displacements and velocities of the first state to the initial fields, which a solver
    /// with points of its own does not report.
    pub(super) fn start(&mut self, displacement: &AffineField, velocity: &AffineField) {
        let d = self.problem.dimension;
        let Some(samples) = self.states.first_mut() else { return };
        let labels: Vec<[f64; 3]> = samples
            .label
            .chunks_exact(d)
            .map(|label| std::array::from_fn(|i| label.get(i).copied().unwrap_or_default()))
            .collect();
        let at_labels = |field: &AffineField| {
            labels.iter().flat_map(|label| field.at(*label).into_iter().take(d)).collect()
        };
        samples.displacement = at_labels(displacement);
        samples.velocity = at_labels(velocity);
    }

    /// Index of the last state.
    pub(super) fn last(&self) -> usize {
        self.states.len() - 1
    }

    /// Mean of a vector over the body in state `k`.
    pub(super) fn mean(&self, field: Field, k: usize) -> [f64; 3] {
        let (samples, d) = (&self.states[k], self.problem.dimension);
        let (mut sum, mut all) = ([0.0; 3], 0.0);
        for (p, weight) in samples.weight.iter().enumerate() {
            all += weight;
            for i in 0..d {
                sum[i] += weight * field(samples)[p * d + i];
            }
        }
        sum.map(|sum| sum / all)
    }

    /// Largest distance of a point's vector from `wanted` in state `k`.
    pub(super) fn farthest(&self, field: Field, k: usize, wanted: [f64; 3]) -> f64 {
        self.points(field, k).map(|(_, vector)| size(minus(vector, wanted))).fold(0.0, f64::max)
    }

    /// Every point's label and vector in state `k`; components beyond the dimension are zero.
    pub(super) fn points(
        &self,
        field: Field,
        k: usize,
    ) -> impl Iterator<Item = ([f64; 3], [f64; 3])> {
        let (samples, d) = (&self.states[k], self.problem.dimension);
        let vector = move |column: &[f64], p: usize| {
            std::array::from_fn(|i| if i < d { column[p * d + i] } else { 0.0 })
        };
        (0..samples.len()).map(move |p| (vector(&samples.label, p), vector(field(samples), p)))
    }
}

/// The line `y = a + b x` of least squares: a, b, and the largest distance from it.
pub(super) fn line(x: &[f64], y: &[f64]) -> (f64, f64, f64) {
    let n = x.len() as f64;
    let (mx, my) = (x.iter().sum::<f64>() / n, y.iter().sum::<f64>() / n);
    let sxy: f64 = x.iter().zip(y).map(|(x, y)| (x - mx) * (y - my)).sum();
    let sxx: f64 = x.iter().map(|x| (x - mx) * (x - mx)).sum();
    let b = if sxx > 0.0 { sxy / sxx } else { 0.0 };
    let a = my - b * mx;
    let off = x.iter().zip(y).map(|(x, y)| (y - a - b * x).abs()).fold(0.0, f64::max);
    (a, b, off)
}

/// A number for a reader: four digits.
pub(super) fn shown(x: f64) -> String {
    let magnitude = x.abs();
    if x == 0.0 {
        "0".to_owned()
    } else if (1e-3..1e5).contains(&magnitude) {
        let digits = (3 - libm::floor(libm::log10(magnitude)) as i32).clamp(0, 6) as usize;
        format!("{x:.digits$}")
    } else {
        format!("{x:.3e}")
    }
}

/// A vector for a reader.
pub(super) fn shown_vector(x: [f64; 3], dimension: usize) -> String {
    let all: Vec<String> = x[..dimension].iter().map(|x| shown(*x)).collect();
    format!("({})", all.join(", "))
}
