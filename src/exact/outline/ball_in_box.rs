//! Volume that a ball about the origin and a box have in common, in any dimension.

use crate::exact::gauss::points;

/// Panels of the quadrature between two kinks: with four, a kink just beyond an end costs 1e-9.
const PANELS: usize = 8;

/// The volume that the ball of this `radius` has in common with the box between `ends`: the
/// integral, along the last axis, of the same for the slices, which are balls of one axis less.
pub(super) fn ball_in_box(radius: f64, ends: &[(f64, f64)]) -> f64 {
    let Some((&(low, high), others)) = ends.split_last() else { return 1.0 };
    let (low, high) = (low.max(-radius), high.min(radius));
    if !(low < high) {
        return 0.0;
    }
    let kinks = || kinks(radius, others, (low, high));
    match others {
        [] => high - low,
        [across] => kinks().windows(2).map(|x| between_chords(radius, *across, x)).sum(),
        _ => {
            let slice = |x: f64| ball_in_box((radius * radius - x * x).max(0.0).sqrt(), others);
            kinks().windows(2).map(|x| integral(x, slice)).sum()
        }
    }
}

/// The integral of `slice` from one kink to the next, beyond which it grows like a power of the
/// root of the distance: `(3 xi - xi^3)/2` makes it smooth.
fn integral(ends: &[f64], slice: impl Fn(f64) -> f64) -> f64 {
    let (middle, half) = (f64::midpoint(ends[0], ends[1]), 0.5 * (ends[1] - ends[0]));
    let term = |(xi, weight): &(Vec<f64>, f64)| {
        let square = xi[0] * xi[0];
        weight * 1.5 * half * (1.0 - square) * slice(middle + 0.5 * half * xi[0] * (3.0 - square))
    };
    points(&[(-1.0, 1.0)], PANELS).iter().map(term).sum()
}

/// The area of a circle between chords at two `ends`, and between `low` and `high` across
/// them, if each of these two is either inside the circle or outside all the way.
fn between_chords(radius: f64, (low, high): (f64, f64), ends: &[f64]) -> f64 {
    let (from, to) = (ends[0], ends[1]);
    let root = |x: f64| (radius * radius - x * x).max(0.0).sqrt();
    let below =
        |x: f64| 0.5 * (x * root(x) + radius * radius * libm::asin((x / radius).clamp(-1.0, 1.0)));
    let (arc, middle) = (below(to) - below(from), root(f64::midpoint(from, to)));
    let top = if middle < high { arc } else { high * (to - from) };
    let bottom = if -middle > low { -arc } else { low * (to - from) };
    if middle.min(high) > low.max(-middle) { top - bottom } else { 0.0 }
}

/// Places from `low` to `high` at which a slice touches a face, an edge or a corner of `others`,
/// in their order, with both ends.
fn kinks(radius: f64, others: &[(f64, f64)], (low, high): (f64, f64)) -> Vec<f64> {
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
    use rstest::rstest;
    use std::f64::consts::{FRAC_PI_4, PI};

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
        /// A corner inside the ball, and faces, edges and corners on either side of it.
        #[test]
        fn the_parts_of_a_box_have_its_volume(
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
