//! Space-time patches with a bump function as test function, and the points of the midpoint rule.

use super::event::Event;
use crate::exact::random::Random;

/// Upper bounds on the densities of the terms in a balance.
pub(crate) struct Densities {
    pub(crate) stored: f64,
    pub(crate) flow: f64,
    pub(crate) supply: f64,
}

/// A space-time box with the bump function `phi = prod (1 - xi^2)^3`. The midpoint rule requires
/// that the slope of phi vanishes smoothly at the boundary, hence the exponent 3.
#[derive(Clone)]
pub(crate) struct SpaceTimePatch {
    pub(crate) centre: Vec<f64>,
    half: Vec<f64>,
}

impl SpaceTimePatch {
    pub(super) fn dimension(&self) -> usize {
        self.centre.len() - 1
    }

    /// Creates a random patch in a box, at most `longest` (s) long, in the run until `until` (s).
    pub(crate) fn in_box(
        random: &mut Random,
        from: &[f64],
        to: &[f64],
        until: f64,
        longest: f64,
    ) -> Self {
        let ends = from.iter().zip(to);
        let (centre, half) =
            ends.map(|(low, high)| interval(random, *low, *high, f64::INFINITY)).unzip();
        Self::over(random, centre, half, until, longest)
    }

    /// Creates a patch with the given centre and half-lengths (m) in space. The random time
    /// interval is a part of the run from 0 to `until` (s), at most `longest` (s) long.
    pub(super) fn over(
        random: &mut Random,
        mut centre: Vec<f64>,
        mut half: Vec<f64>,
        until: f64,
        longest: f64,
    ) -> Self {
        let (middle, duration) = interval(random, 0.0, until, longest);
        centre.push(middle);
        half.push(duration);
        Self { centre, half }
    }

    /// Creates a patch that covers the box and at most `longest` (s) of the run around `t` (s).
    pub(super) fn whole(from: &[f64], to: &[f64], until: f64, longest: f64, t: f64) -> Self {
        let mut half: Vec<f64> =
            from.iter().zip(to).map(|(low, high)| 0.5 * (high - low)).collect();
        let mut centre: Vec<f64> = from.iter().zip(&half).map(|(low, half)| low + half).collect();
        let duration = 0.5 * until.min(longest);
        half.push(duration);
        centre.push(t.clamp(duration, until - duration));
        Self { centre, half }
    }

    /// Returns a part of the patch around `event`, shortened by one random factor on all axes.
    pub(super) fn about(&self, event: &Event, random: &mut Random) -> Self {
        let mut place = event.label.clone();
        place.push(event.t);
        self.part(&place, 0.5 * libm::exp2(-5.0 * random.unit()))
    }

    pub(super) fn part(&self, place: &[f64], factor: f64) -> Self {
        let half: Vec<f64> = self.half.iter().map(|half| factor * half).collect();
        let within = |axis: usize| {
            let room = self.half[axis] - half[axis];
            place[axis].clamp(self.centre[axis] - room, self.centre[axis] + room)
        };
        Self { centre: (0..half.len()).map(within).collect(), half }
    }

    /// Returns an upper bound on the sum of all terms of a balance with the densities `largest`.
    pub(super) fn largest_sum(&self, largest: &Densities, per_axis: usize) -> f64 {
        let d = self.dimension();
        // On one axis, the integral of the bump is 32/35, that of the magnitude of its slope 2.
        let points = per_axis as f64;
        let mean: f64 = (0..d).map(|_| 16.0 / 35.0 * points).product();
        let slope = |axis: usize| mean * points / self.half[axis];
        let flow: f64 = (0..d).map(slope).sum();
        let supply = mean * 16.0 / 35.0 * points;
        largest.stored * slope(d) + largest.flow * flow + largest.supply * supply
    }

    pub(super) fn raster(&self, per_axis: usize) -> Raster {
        let d = self.dimension();
        let axes: Vec<Vec<AxisPoint>> = (0..d).map(|a| self.axis(a, per_axis)).collect();
        let point = |k: usize| {
            let of_axes = axes.iter().scan(k, |k, axis| {
                let point = axis[*k % per_axis];
                *k /= per_axis;
                Some(point)
            });
            of_axes.collect()
        };
        let points = (0..per_axis.pow(d as u32)).map(point).collect();
        Raster { points, times: self.axis(d, per_axis) }
    }

    /// Returns equally spaced points on axis `a`; the last axis is time.
    fn axis(&self, a: usize, points: usize) -> Vec<AxisPoint> {
        let point = |index: usize| {
            let xi = (index as f64 + 0.5) / points as f64 * 2.0 - 1.0;
            let inside = 1.0 - xi * xi;
            AxisPoint {
                at: self.centre[a] + self.half[a] * xi,
                factor: inside * inside * inside,
                slope: -6.0 * xi * inside * inside / self.half[a],
            }
        };
        (0..points).map(point).collect()
    }
}

pub(crate) struct Raster {
    /// Points in space, one coordinate per axis; the first axis varies fastest.
    pub(crate) points: Vec<Vec<AxisPoint>>,
    pub(crate) times: Vec<AxisPoint>,
}

/// A position on one axis of a patch, with the factor `(1 - xi^2)^3` of phi and its derivative.
#[derive(Clone, Copy)]
pub(crate) struct AxisPoint {
    pub(crate) at: f64,
    factor: f64,
    slope: f64,
}

pub(crate) fn labels(points: &[Vec<AxisPoint>]) -> Vec<Vec<f64>> {
    points.iter().map(|point| point.iter().map(|on_axis| on_axis.at).collect()).collect()
}

/// Returns phi and its derivative along every axis at a point with the given coordinates.
pub(crate) fn bump(points: &[AxisPoint]) -> (f64, [f64; 4]) {
    let factors = |except: usize| {
        let others = points.iter().enumerate().filter(move |(b, _)| *b != except);
        others.map(|(_, point)| point.factor).product::<f64>()
    };
    let mut slope = [0.0; 4];
    for (a, point) in points.iter().enumerate() {
        slope[a] = point.slope * factors(a);
    }
    (factors(points.len()), slope)
}

/// Returns centre and half-length of a random subinterval that is at most `longest` long.
fn interval(random: &mut Random, low: f64, high: f64, longest: f64) -> (f64, f64) {
    let width = (high - low).min(longest) * random.between(0.2, 1.0);
    let start = low + (high - low - width) * random.unit();
    (start + 0.5 * width, 0.5 * width)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `1 - xi^2` is 7/16 at the outer points and 15/16 at the inner points.
    #[test]
    fn points_of_the_midpoint_rule_are_in_the_middle_of_their_intervals() {
        let patch = SpaceTimePatch::whole(&[1.0], &[9.0], 2.0, 2.0, 1.0);
        let Raster { points, times } = patch.raster(4);
        let of_axis = |points: &[AxisPoint]| -> Vec<f64> { points.iter().map(|p| p.at).collect() };
        assert_eq!(of_axis(&points.concat()), [2.0, 4.0, 6.0, 8.0]);
        assert_eq!(of_axis(&times), [0.25, 0.75, 1.25, 1.75]);
        let (outer, inner) = (points[0][0], points[1][0]);
        assert_eq!([outer.factor, inner.factor], [7.0_f64, 15.0].map(|n| (n / 16.0).powi(3)));
        assert_eq!(
            [outer.slope, inner.slope],
            [0.75 * 49.0, 0.25 * 225.0].map(|n| n * 6.0 / 1024.0)
        );
    }
}
