//! Round bodies: annuli and disks in the plane, balls in space.
//!
//! The module also computes the volume of the intersection of a box and a ball around the origin.

use super::{Cut, Outline};
use crate::exact::gauss::points;
use crate::exact::random::Random;
use std::f64::consts::{PI, TAU};

const TRACE: usize = 48;

/// The points at a distance between `inner` (0 for a disk and a ball) and `outer` (m) of a centre.
#[derive(Debug, Clone, PartialEq)]
pub struct Round {
    /// Centre (m), with two or three coordinates.
    pub centre: Vec<f64>,
    /// Inner radius (m).
    pub inner: f64,
    /// Outer radius (m).
    pub outer: f64,
}

/// A circular rim of a plane body.
#[derive(Debug, Clone, PartialEq)]
pub struct Circle {
    /// Name of the rim in suites.
    pub name: &'static str,
    /// Index in [`Outline::rims`].
    pub number: usize,
    /// Centre (m).
    pub centre: [f64; 2],
    /// Radius (m).
    pub radius: f64,
    /// 1 if the outward normal of the body points away from the centre, otherwise -1.
    pub outwards: f64,
}

struct Rim {
    /// Name in messages.
    title: &'static str,
    /// Name in suites.
    name: &'static str,
    radius: f64,
    /// 1 if the outward normal points away from the centre, otherwise -1.
    outwards: f64,
}

impl Round {
    /// Returns the rims with nonzero radius, the inner rim first.
    fn each_rim(&self) -> impl Iterator<Item = Rim> {
        let rim = |title, name, radius, outwards| Rim { title, name, radius, outwards };
        let inner = rim("the inner rim", "inner", self.inner, -1.0);
        let outer = rim("the outer rim", "outer", self.outer, 1.0);
        [inner, outer].into_iter().filter(|rim| rim.radius > 0.0)
    }

    /// Returns a random direction. On a sphere, heights of uniform points are uniform (Archimedes).
    fn direction(&self, random: &mut Random) -> [f64; 3] {
        let angle = random.between(-PI, PI);
        let height = if self.centre.len() == 2 { 0.0 } else { random.between(-1.0, 1.0) };
        direction(angle, height)
    }

    fn along(&self, direction: &[f64; 3], radius: f64) -> Vec<f64> {
        self.centre.iter().zip(direction).map(|(c, n)| c + radius * n).collect()
    }

    fn radius_of(&self, label: &[f64]) -> f64 {
        let square: f64 = label.iter().zip(&self.centre).map(|(x, c)| (x - c) * (x - c)).sum();
        square.sqrt()
    }
}

impl Outline for Round {
    fn kind(&self) -> &'static str {
        match self.centre.len() {
            2 if self.inner > 0.0 => "annulus",
            2 => "disk",
            _ => "ball",
        }
    }

    fn row(&self) -> String {
        let centre: Vec<String> = self.centre.iter().map(ToString::to_string).collect();
        let inner = if self.inner > 0.0 { format!("{} to ", self.inner) } else { String::new() };
        let (kind, centre) = (self.kind(), centre.join(", "));
        format!("{kind} about ({centre}), radius {inner}{} m", self.outer)
    }

    fn ends(&self) -> (Vec<f64>, Vec<f64>) {
        let shifted = |by: f64| self.centre.iter().map(|c| c + by).collect();
        (shifted(-self.outer), shifted(self.outer))
    }

    fn holds(&self, label: &[f64]) -> bool {
        (self.inner..=self.outer).contains(&self.radius_of(label))
    }

    fn distance(&self, label: &[f64]) -> f64 {
        (self.radius_of(label) - self.outer).max(0.0)
    }

    fn ball(&self) -> Option<(&[f64], f64)> {
        Some((&self.centre, self.outer))
    }

    fn hole(&self) -> f64 {
        self.inner
    }

    fn circles(&self) -> Vec<Circle> {
        let [x, y] = self.centre[..] else { return Vec::new() };
        let circle = |(number, Rim { name, radius, outwards, .. })| Circle {
            name,
            number,
            centre: [x, y],
            radius,
            outwards,
        };
        self.each_rim().enumerate().map(circle).collect()
    }

    /// Returns the whole lattice cell if its centre is inside: the rim becomes a staircase.
    fn cut(&self, centre: &[f64], _: &[f64]) -> Cut {
        if self.holds(centre) { Cut::Whole } else { Cut::Nothing }
    }

    fn volume_within(&self, from: &[f64], to: &[f64]) -> f64 {
        let ends = from.iter().zip(to).zip(&self.centre).map(|((from, to), c)| (from - c, to - c));
        let ends: Vec<(f64, f64)> = ends.collect();
        ball_in_box(self.outer, &ends) - ball_in_box(self.inner, &ends)
    }

    fn trace(&self) -> Vec<(f64, f64)> {
        let circle = |radius: f64, turn: f64| {
            let angle = move |k: usize| turn * TAU * k as f64 / TRACE as f64;
            let point = move |k: usize| {
                let (sin, cos) = (libm::sin(angle(k)), libm::cos(angle(k)));
                (self.centre[0] + radius * cos, self.centre[1] + radius * sin)
            };
            (0..=TRACE).map(point)
        };
        let hole = (self.inner > 0.0).then(|| circle(self.inner, -1.0));
        circle(self.outer, 1.0).chain(hole.into_iter().flatten()).collect()
    }

    fn rims(&self) -> Vec<String> {
        self.each_rim().map(|rim| rim.title.to_owned()).collect()
    }

    fn on_rim(&self, rim: usize, random: &mut Random) -> (Vec<f64>, [f64; 3]) {
        let direction = self.direction(random);
        let normal = |rim: &Rim| direction.map(|n| rim.outwards * n);
        let rim = self.each_rim().nth(rim);
        let radius = rim.as_ref().map_or(self.outer, |rim| rim.radius);
        (self.along(&direction, radius), rim.as_ref().map_or(direction, normal))
    }

    fn point(&self, random: &mut Random) -> Vec<f64> {
        let d = self.centre.len() as f64;
        let power = |radius: f64| libm::pow(radius / self.outer, d);
        let radius = self.outer * libm::pow(random.between(power(self.inner), 1.0), 1.0 / d);
        let direction = self.direction(random);
        self.along(&direction, radius.clamp(self.inner, self.outer))
    }

    fn patch(&self, random: &mut Random) -> (Vec<f64>, Vec<f64>) {
        let radius = self.inner + (self.outer - self.inner) * random.between(0.25, 0.75);
        let away = |rim: Rim| (rim.radius - radius).abs();
        let reach = self.each_rim().map(away).fold(f64::INFINITY, f64::min);
        let direction = self.direction(random);
        let corner = reach / (self.centre.len() as f64).sqrt();
        let half = self.centre.iter().map(|_| corner * random.between(0.2, 1.0)).collect();
        (self.along(&direction, radius), half)
    }

    /// Returns the ranges of radius, angle and, in 3-D, height divided by radius.
    fn charts(&self) -> Vec<Vec<(f64, f64)>> {
        let all = [(self.inner, self.outer), (-PI, PI), (-1.0, 1.0)];
        vec![all[..self.centre.len()].to_vec()]
    }

    /// Returns the point, and the volume per unit of the coordinates: r in the plane, r^2 in space.
    fn place(&self, _: usize, coordinates: &[f64]) -> (Vec<f64>, f64) {
        let (radius, height) = (coordinates[0], coordinates.get(2).copied().unwrap_or(0.0));
        let direction = direction(coordinates[1], height);
        (self.along(&direction, radius), (1..self.centre.len()).map(|_| radius).product())
    }
}

/// Returns the unit vector at `angle` around the third axis, whose third component is `height`.
fn direction(angle: f64, height: f64) -> [f64; 3] {
    let flat = (1.0 - height * height).sqrt();
    [flat * libm::cos(angle), flat * libm::sin(angle), height]
}

/// Number of panels between two kinks. With four, a kink just outside causes an error of 1e-9.
const PANELS: usize = 8;

/// Computes the volume of the intersection of a ball at the origin and the box between `ends`, by
/// integration over slices, which are intersections with a ball of one dimension less.
pub(super) fn ball_in_box(radius: f64, ends: &[(f64, f64)]) -> f64 {
    let Some((&(low, high), others)) = ends.split_last() else { return 1.0 };
    let (low, high) = (low.max(-radius), high.min(radius));
    if !(low < high) {
        return 0.0;
    }
    let kinks = || kinks(radius, others, low, high);
    match others {
        [] => high - low,
        [across] => kinks().windows(2).map(|x| between_chords(radius, across.0, across.1, x)).sum(),
        _ => {
            let slice = |x: f64| ball_in_box((radius * radius - x * x).max(0.0).sqrt(), others);
            kinks().windows(2).map(|x| integral(x, slice)).sum()
        }
    }
}

/// Integrates `slice` between two kinks. The substitution `(3 xi - xi^3)/2` makes it smooth there.
fn integral(ends: &[f64], slice: impl Fn(f64) -> f64) -> f64 {
    let (middle, half) = (f64::midpoint(ends[0], ends[1]), 0.5 * (ends[1] - ends[0]));
    let term = |(xi, weight): &(Vec<f64>, f64)| {
        let square = xi[0] * xi[0];
        weight * 1.5 * half * (1.0 - square) * slice(middle + 0.5 * half * xi[0] * (3.0 - square))
    };
    points(&[(-1.0, 1.0)], PANELS).iter().map(term).sum()
}

/// Computes the area of a circle between two chords at the positions `ends`, and between `low` and
/// `high` along the chords. Both `low` and `high` must be entirely inside or outside the circle.
fn between_chords(radius: f64, low: f64, high: f64, ends: &[f64]) -> f64 {
    let (from, to) = (ends[0], ends[1]);
    let root = |x: f64| (radius * radius - x * x).max(0.0).sqrt();
    let below =
        |x: f64| 0.5 * (x * root(x) + radius * radius * libm::asin((x / radius).clamp(-1.0, 1.0)));
    let (arc, middle) = (below(to) - below(from), root(f64::midpoint(from, to)));
    let top = if middle < high { arc } else { high * (to - from) };
    let bottom = if -middle > low { -arc } else { low * (to - from) };
    if middle.min(high) > low.max(-middle) { top - bottom } else { 0.0 }
}

/// Returns the sorted positions from `low` to `high` at which a slice touches a face, an edge or a
/// corner of `others`, including both ends.
fn kinks(radius: f64, others: &[(f64, f64)], low: f64, high: f64) -> Vec<f64> {
    let with = |squares: Vec<f64>, (from, to): &(f64, f64)| -> Vec<f64> {
        squares.into_iter().flat_map(|s| [s, s + from * from, s + to * to]).collect()
    };
    let squares = others.iter().fold(vec![0.0], with);
    let roots = squares.into_iter().map(|square| (radius * radius - square).max(0.0).sqrt());
    let inside = |x: &f64| low < *x && *x < high;
    let mut all: Vec<f64> = roots.flat_map(|root| [-root, root]).filter(inside).collect();
    all.extend([low, high]);
    all.sort_by(f64::total_cmp);
    all.dedup();
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use proptest::prelude::*;
    use proptest::test_runner::FileFailurePersistence;
    use rstest::rstest;
    use std::f64::consts::{FRAC_PI_4, PI};

    proptest! {
        #[test]
        fn what_is_drawn_lies_in_the_body(
            seed: u64,
            d in 2..=3_usize,
            inner in prop_oneof![Just(0.0), 0.1..0.99],
        ) {
            let body = Round { centre: vec![3.0, -2.0, 0.5][..d].to_vec(), inner, outer: 1.0 };
            let mut random = Random::new(seed);
            let wide = Round { inner: inner - 1e-12, outer: 1.0 + 1e-12, ..body.clone() };
            prop_assert!(wide.holds(&body.point(&mut random)));
            let (centre, half) = body.patch(&mut random);
            for corner in 0..1 << d {
                let sign = |a: usize| if corner >> a & 1 == 1 { 1.0 } else { -1.0 };
                let label: Vec<f64> = (0..d).map(|a| centre[a] + sign(a) * half[a]).collect();
                prop_assert!(wide.holds(&label), "{label:?}");
            }
            for rim in 0..body.rims().len() {
                let (label, normal) = body.on_rim(rim, &mut random);
                prop_assert!(wide.holds(&label), "{label:?}");
                // The normal points out of the body.
                let beside = |by: f64| -> Vec<f64> {
                    label.iter().zip(normal).map(|(x, n)| x + by * n).collect()
                };
                prop_assert!(!body.holds(&beside(1e-6)) && body.holds(&beside(-1e-6)));
            }
        }
    }

    /// The traced polygon is closed and has the area of the body; holes have opposite orientation.
    #[rstest]
    fn the_drawn_rims_are_those_of_the_body(#[values(0.0, 0.4)] inner: f64) {
        let trace = Round { centre: vec![1.0, 2.0], inner, outer: 1.5 }.trace();
        let next = trace.iter().cycle().skip(1);
        let doubled: f64 = trace.iter().zip(next).map(|(a, b)| a.0 * b.1 - b.0 * a.1).sum();
        let area = std::f64::consts::PI * (1.5 * 1.5 - inner * inner);
        assert!((0.5 * doubled / area - 1.0).abs() < 0.01, "{doubled}");
    }

    /// Half of the random points are closer to the centre than the radius that halves the volume.
    #[rstest]
    #[case(2, 0.75, 1.25)]
    #[case(2, 0.0, 1.0)]
    #[case(3, 0.0, 2.0)]
    fn points_are_spread_evenly(#[case] d: usize, #[case] inner: f64, #[case] outer: f64) {
        let body = Round { centre: vec![1.0; d], inner, outer };
        let mut random = Random::new(1);
        let n = d as f64;
        let middle = libm::pow(f64::midpoint(libm::pow(inner, n), libm::pow(outer, n)), 1.0 / n);
        let half = Round { outer: middle, ..body.clone() };
        let near = (0..4000).filter(|_| half.holds(&body.point(&mut random))).count();
        assert!((1880..2120).contains(&near), "{near} of 4000");
    }

    #[rstest]
    #[case::a_disk(&[(-2.0, 3.0), (-1.0, 1.0)], PI)]
    #[case::a_quarter(&[(0.0, 3.0), (0.0, 1.0)], FRAC_PI_4)]
    #[case::a_box_inside(&[(-0.1, 0.2), (0.3, 0.5)], 0.06)]
    #[case::a_box_beside(&[(0.8, 2.0), (0.8, 2.0)], 0.0)]
    #[case::a_segment(&[(0.5, 2.0), (-2.0, 2.0)], PI / 3.0 - 0.75_f64.sqrt() / 2.0)]
    #[case::a_ball(&[(-2.0, 2.0), (-1.0, 1.0), (-1.0, 3.0)], 4.0 * PI / 3.0)]
    #[case::an_octant(&[(0.0, 2.0), (-1.0, 0.0), (0.0, 3.0)], PI / 6.0)]
    #[case::a_cap(&[(-2.0, 2.0), (-1.0, 1.0), (0.5, 3.0)], 5.0 * PI / 24.0)]
    #[case::a_cap_along_another_axis(&[(0.5, 3.0), (-2.0, 2.0), (-1.0, 1.0)], 5.0 * PI / 24.0)]
    #[case::a_box_in_the_ball(&[(-0.1, 0.2), (0.3, 0.5), (0.0, 0.5)], 0.03)]
    fn a_closed_form_is_met(#[case] ends: &[(f64, f64)], #[case] volume: f64) {
        for scale in [1.0, 0.01, 3.0] {
            let ends: Vec<_> = ends.iter().map(|(low, high)| (scale * low, scale * high)).collect();
            let volume = volume * scale.powi(ends.len() as i32);
            let found = ball_in_box(scale, &ends);
            assert_relative_eq!(found, volume, max_relative = 1e-11, epsilon = 1e-15);
        }
    }

    proptest! {
        // Cases that failed before: tests/proptest-regressions/exact/outline/round.txt.
        #![proptest_config(ProptestConfig {
            failure_persistence: Some(Box::new(FileFailurePersistence::SourceParallel(
                "tests/proptest-regressions",
            ))),
            ..ProptestConfig::default()
        })]

        /// Splits a box at a point. Faces, edges and corners lie inside or outside the ball.
        #[test]
        fn parts_of_a_box_add_up_to_its_volume(
            at in prop::array::uniform3(-1.1..1.1_f64),
            to in prop::array::uniform3(0.1..1.5_f64),
            d in 2..=3_usize,
        ) {
            let whole: Vec<(f64, f64)> = at.iter().zip(to).map(|(a, b)| (*a, a + b)).collect();
            let middle = |axis: usize| at[axis] + 0.3 * to[axis];
            let part = |corner: usize| {
                let side = |axis: usize| match corner >> axis & 1 {
                    0 => (whole[axis].0, middle(axis)),
                    _ => (middle(axis), whole[axis].1),
                };
                ball_in_box(1.0, &(0..d).map(side).collect::<Vec<_>>())
            };
            let sum: f64 = (0..1 << d).map(part).sum();
            prop_assert!((sum - ball_in_box(1.0, &whole[..d])).abs() < 1e-9);
        }
    }
}
