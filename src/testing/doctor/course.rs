//! Recorded runs, quantities computed from them, and vector fields.

use crate::external::LevelProblem;
use crate::subject::{Samples, Subject};
use nalgebra::Vector3;

/// The states of a run, starting with the initial state.
pub(super) struct Course {
    pub(super) problem: LevelProblem,
    /// Times of the states (s).
    pub(super) times: Vec<f64>,
    pub(super) states: Vec<Samples>,
    /// Reason why the run ended early; `None` if the run is complete.
    pub(super) failure: Option<String>,
}

pub(super) type Field = fn(&Samples) -> &[f64];

pub(super) fn displacement(samples: &Samples) -> &[f64] {
    &samples.displacement
}

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
    /// with its own points does not report.
    pub(super) fn start(&mut self, displacement: &AffineField, velocity: &AffineField) {
        let d = self.problem.dimension;
        let Some(samples) = self.states.first_mut() else { return };
        let at_labels = |field: &AffineField| {
            let labels = samples.label.chunks_exact(d).map(vector);
            labels.flat_map(|label| field.at(label).data.0[0].into_iter().take(d)).collect()
        };
        (samples.displacement, samples.velocity) = (at_labels(displacement), at_labels(velocity));
    }

    pub(super) fn last(&self) -> usize {
        self.states.len() - 1
    }

    /// Returns the displacements and velocities of the points in a box, such as one of two bodies.
    pub(super) fn within(&self, (low, high): &(Vec<f64>, Vec<f64>)) -> Self {
        let d = self.problem.dimension;
        let part = |state: &Samples| {
            let mut part = Samples::default();
            for (p, label) in state.label.chunks_exact(d).enumerate() {
                let is_inside = |(x, (a, b)): (&f64, (&f64, &f64))| {
                    let rounding = 1e-9 * (b - a);
                    (a - rounding..=b + rounding).contains(x)
                };
                if label.iter().zip(low.iter().zip(high)).all(is_inside) {
                    let at = p * d..(p + 1) * d;
                    let (u, v) = (&state.displacement[at.clone()], &state.velocity[at]);
                    part.push(label, u, v, state.weight[p]);
                }
            }
            part
        };
        let states = self.states.iter().map(part).collect();
        Self { states, times: self.times.clone(), ..Self::new(&self.problem) }
    }

    /// Returns the mean over the body of a vector column in state `k`.
    pub(super) fn mean(&self, field: Field, k: usize) -> Vector3<f64> {
        let (mut sum, mut all) = (Vector3::zeros(), 0.0);
        for ((_, vector), weight) in self.points(field, k).zip(&self.states[k].weight) {
            sum += vector * *weight;
            all += weight;
        }
        sum / all
    }

    /// Returns the largest difference between `wanted` and the vector of any point in state `k`;
    /// infinite if a vector is NaN.
    pub(super) fn farthest(&self, field: Field, k: usize, wanted: impl Into<Vector3<f64>>) -> f64 {
        let wanted = wanted.into();
        self.points(field, k).map(|(_, vector)| (vector - wanted).norm()).fold(0.0, larger)
    }

    /// Returns the largest change of a displacement in the first step (m); infinite if it is NaN.
    pub(super) fn first_motion(&self) -> f64 {
        let pairs = self.points(displacement, 0).zip(self.points(displacement, 1));
        pairs.map(|((_, a), (_, b))| (b - a).norm()).fold(0.0, larger)
    }

    /// Returns the label of every point and its vector in state `k`; missing components are zero.
    pub(super) fn points(
        &self,
        field: Field,
        k: usize,
    ) -> impl Iterator<Item = (Vector3<f64>, Vector3<f64>)> {
        let (samples, d) = (&self.states[k], self.problem.dimension);
        samples
            .label
            .chunks_exact(d)
            .zip(field(samples).chunks_exact(d))
            .map(|(x, v)| (vector(x), vector(v)))
    }
}

/// Returns the larger of two numbers; infinity in place of NaN, which `f64::max` ignores.
fn larger(a: f64, b: f64) -> f64 {
    if b.is_nan() { f64::INFINITY } else { a.max(b) }
}

/// Returns a vector with these components; missing components are zero.
pub(super) fn vector(components: &[f64]) -> Vector3<f64> {
    Vector3::from_fn(|i, _| components.get(i).copied().unwrap_or_default())
}

/// Fits a least-squares line `y = a + b x`. Returns a, b, and the largest distance from the line.
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

/// Formats a number with four digits.
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

pub(super) fn shown_vector(x: Vector3<f64>, dimension: usize) -> String {
    shown_list(&x.as_slice()[..dimension])
}

pub(super) fn shown_list(numbers: &[f64]) -> String {
    format!("({})", numbers.iter().map(|x| shown(*x)).collect::<Vec<_>>().join(", "))
}

/// Returns the largest difference between the entries of two lists; NaN is ignored.
pub(super) fn largest_difference(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

pub(super) fn transposed(tensor: &[f64], d: usize) -> Vec<f64> {
    (0..d * d).map(|k| tensor[(k % d) * d + k / d]).collect()
}

/// The vector field `value + gradient (X - centre)` of the reference position X.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct AffineField {
    pub(super) value: Vector3<f64>,
    /// Row i contains the derivatives of component i.
    pub(super) gradient: [[f64; 3]; 3],
    /// Position (m) at which the field has `value`.
    pub(super) centre: Vector3<f64>,
}

impl AffineField {
    pub(super) fn uniform(value: impl Into<Vector3<f64>>) -> Self {
        Self { value: value.into(), ..Self::default() }
    }

    /// Creates a uniform field whose only component is that along `axis`.
    pub(super) fn along(axis: usize, value: f64) -> Self {
        Self::uniform(std::array::from_fn(|i| if i == axis { value } else { 0.0 }))
    }

    pub(super) fn at(&self, place: Vector3<f64>) -> Vector3<f64> {
        let from = place - self.centre;
        Vector3::from_fn(|i, _| {
            (0..3).fold(self.value[i], |sum, j| sum + self.gradient[i][j] * from[j])
        })
    }

    pub(super) fn is_zero(&self) -> bool {
        *self == Self { centre: self.centre, ..Self::default() }
    }

    /// Formats the field as one formula of X, Y, Z for each component.
    pub(super) fn formulas(&self, dimension: usize) -> Vec<String> {
        let term = |i: usize, j: usize| {
            let (slope, axis, centre) = (self.gradient[i][j], ["X", "Y", "Z"][j], self.centre[j]);
            (slope != 0.0).then(|| format!(" + ({slope:e})*({axis} - ({centre:e}))"))
        };
        let formula = |i: usize| {
            let terms: String = (0..dimension).filter_map(|j| term(i, j)).collect();
            format!("{:e}{terms}", self.value[i])
        };
        (0..dimension).map(formula).collect()
    }
}
