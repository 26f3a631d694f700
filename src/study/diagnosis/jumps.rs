//! Jumps of the exact displacement and its derivatives, and the length over which the displacement
//! changes.
//!
//! The derivatives are those of the formulas, piece by piece, so that a jump between two points
//! stays when the points approach each other, and a steep slope does not.

use crate::exact::{Derivatives, Problem};

/// Times at which the solution is examined, as shares of the run.
const TIMES: [f64; 6] = [0.37, 0.61, 0.83, 0.17, 1.0, 0.0];

/// Intervals of each line on which the solution is examined, and lines along each axis, by
/// dimension.
const INTERVALS: [usize; 3] = [512, 128, 64];
const LINES: [usize; 3] = [1, 5, 3];

/// Share of the largest value of a derivative that a jump has at least.
const LEAST: f64 = 1e-3;

/// Share of the length of a line that is taken for a point.
const POINT: f64 = 1e-9;

/// Share of its natural size below which a derivative is rounding.
const ROUNDING: f64 = 1e-9;

/// A derivative of the displacement: its order, and its values.
type Derivative = (usize, fn(&Derivatives) -> Vec<f64>);

/// The displacement and its derivatives, from the lowest order.
const GROUPS: [Derivative; 6] = [
    (0, |now| now.u.to_vec()),
    (1, |now| now.velocity.to_vec()),
    (1, |now| now.grad.as_flattened().to_vec()),
    (2, |now| now.acceleration.to_vec()),
    (2, |now| now.grad_rate.as_flattened().to_vec()),
    (2, |now| now.second.as_flattened().as_flattened().to_vec()),
];

/// A place and a time at which a derivative jumps.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Jump {
    /// Order of the derivative.
    pub(crate) order: usize,
    /// Place (m).
    pub(crate) place: Vec<f64>,
    /// Time (s).
    pub(crate) time: f64,
}

/// Largest magnitudes of the displacement and its derivatives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Sizes([f64; GROUPS.len()]);

impl Sizes {
    /// Length (m) over which the displacement changes: the square root of its size over that of
    /// its second derivatives. That of a sine is its wavelength over 2 pi.
    pub(crate) fn length(&self) -> f64 {
        (self.0[0] / self.0[5]).sqrt()
    }

    /// Length (m) over which the displacement gradient changes.
    pub(crate) fn gradient_length(&self) -> f64 {
        self.0[2] / self.0[5]
    }
}

/// Sizes of the displacement and its derivatives in the body until time `until` (s).
pub(crate) fn sizes(problem: &Problem, until: f64) -> Sizes {
    let mut sizes = [0.0_f64; GROUPS.len()];
    for line in lines(problem) {
        for share in TIMES {
            for (_, place) in line.inside(problem) {
                let now = problem.motion.derivatives(&place, share * until);
                for (size, (_, values)) in sizes.iter_mut().zip(&GROUPS) {
                    *size = values(&now).iter().fold(*size, |a, b| a.max(b.abs()));
                }
            }
        }
    }
    Sizes(sizes)
}

/// A jump of the derivative of lowest order that has one, of those up to the second.
pub(crate) fn lowest_jump(problem: &Problem, until: f64) -> Option<Jump> {
    let Sizes(sizes) = sizes(problem, until);
    let length = problem.from.iter().zip(&problem.to).map(|(a, b)| b - a).fold(0.0, f64::max);
    let [u, velocity, grad, ..] = sizes;
    let natural = [u, u / until, u / length, velocity / until, velocity / length, grad / length];
    for (index, (order, values)) in GROUPS.iter().enumerate() {
        if !(sizes[index] > ROUNDING * natural[index]) {
            continue;
        }
        let least = LEAST * sizes[index];
        for line in lines(problem) {
            for time in TIMES.map(|share| share * until) {
                let at = |place: &[f64]| values(&problem.motion.derivatives(place, time));
                if let Some(place) = line.jump(problem, least, &at) {
                    return Some(Jump { order: *order, place, time });
                }
            }
        }
    }
    None
}

/// A line through the body.
struct LocalLine {
    axis: usize,
    from: Vec<f64>,
    to: f64,
}

impl LocalLine {
    fn place(&self, x: f64) -> Vec<f64> {
        let mut place = self.from.clone();
        place[self.axis] = x;
        place
    }

    /// Points of the line in the body, each with its number.
    fn inside<'a>(&'a self, problem: &'a Problem) -> impl Iterator<Item = (usize, Vec<f64>)> + 'a {
        let count = INTERVALS[problem.dimension().clamp(1, 3) - 1];
        let from = self.from[self.axis];
        let place = move |k: usize| self.place(from + (self.to - from) * k as f64 / count as f64);
        let places = (0..=count).map(move |k| (k, place(k)));
        places.filter(|(_, place)| problem.holds(place))
    }

    /// The place of a jump of a component of `at` by at least `least`.
    fn jump(
        &self,
        problem: &Problem,
        least: f64,
        at: &dyn Fn(&[f64]) -> Vec<f64>,
    ) -> Option<Vec<f64>> {
        let mut before: Option<(usize, f64, Vec<f64>)> = None;
        for (k, place) in self.inside(problem) {
            let (x, values) = (place[self.axis], at(&place));
            if let Some((_, from, old)) = before.filter(|(last, ..)| last + 1 == k) {
                let jump = (0..values.len())
                    .find_map(|i| self.bisect((from, old[i]), (x, values[i]), i, least, at));
                if jump.is_some() {
                    return jump;
                }
            }
            before = Some((k, x, values));
        }
        None
    }

    /// The place of a jump of component `i` between two points with its values.
    fn bisect(
        &self,
        mut low: (f64, f64),
        mut high: (f64, f64),
        i: usize,
        least: f64,
        at: &dyn Fn(&[f64]) -> Vec<f64>,
    ) -> Option<Vec<f64>> {
        let point = POINT * (self.to - self.from[self.axis]);
        // A value that is not finite is no jump.
        while (high.1 - low.1).abs() >= least && (high.1 - low.1).is_finite() {
            let x = 0.5 * (low.0 + high.0);
            if high.0 - low.0 <= point {
                return Some(self.place(x));
            }
            let middle = (x, at(&self.place(x))[i]);
            let is_low = (middle.1 - low.1).abs() >= (high.1 - middle.1).abs();
            (low, high) = if is_low { (low, middle) } else { (middle, high) };
        }
        None
    }
}

/// Lines along every axis, evenly through the body.
fn lines(problem: &Problem) -> Vec<LocalLine> {
    let d = problem.dimension();
    let count = LINES[d.clamp(1, 3) - 1];
    let mut lines = Vec::new();
    for axis in 0..d {
        for number in 0..count.pow(d as u32 - 1) {
            let mut rest = number;
            let mut from = problem.from.clone();
            for other in (0..d).filter(|other| *other != axis) {
                let share = (0.5 + (rest % count) as f64) / count as f64;
                from[other] += (problem.to[other] - problem.from[other]) * share;
                rest /= count;
            }
            lines.push(LocalLine { axis, from, to: problem.to[axis] });
        }
    }
    lines
}
