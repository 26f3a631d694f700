//! Tests of polygons: validity, and intersections with lattice cells.

use super::polygon::{AreaMoments, Point, triangles};
use super::{Cut, Outline, Piece, Polygon, ROUNDING, join_small};
use crate::exact::random::Random;
use approx::assert_relative_eq;
use proptest::prelude::*;
use rstest::rstest;

const TRIANGLE: &[[f64; 2]] = &[[0.1, 0.1], [0.9, 0.2], [0.7, 0.8]];
const ANGLE: &[[f64; 2]] =
    &[[0.1, 0.1], [0.9, 0.1], [0.9, 0.4], [0.4, 0.4], [0.4, 0.9], [0.1, 0.9]];
/// A comb with slits and arms narrower than a lattice cell, and a corner on a straight line.
const COMB: &[[f64; 2]] = &[
    [0.0, 0.0],
    [0.5, 0.0],
    [1.0, 0.0],
    [1.0, 0.9],
    [0.81, 0.9],
    [0.8, 0.11],
    [0.79, 0.9],
    [0.31, 0.7],
    [0.3, 0.1],
    [0.29, 0.7],
    [0.0, 0.95],
];

fn polygon(corners: &[[f64; 2]]) -> Polygon {
    Polygon::new("polygon", corners).unwrap()
}

/// Computes area and first moments from the sides (Green's theorem).
fn by_sides(corners: &[[f64; 2]]) -> [f64; 3] {
    let next = corners.iter().cycle().skip(1);
    let sums = corners.iter().zip(next).fold([0.0; 3], |sums, (a, b)| {
        let doubled = a[0] * b[1] - b[0] * a[1];
        let terms = [0.5, (a[0] + b[0]) / 6.0, (a[1] + b[1]) / 6.0];
        [0, 1, 2].map(|i| sums[i] + doubled * terms[i])
    });
    sums.map(|sum| if sums[0] < 0.0 { -sum } else { sum })
}

/// Returns the particles of a lattice with `count` cells per unit length.
fn particles(body: &Polygon, count: i32) -> Vec<Piece> {
    let spacing = 1.0 / f64::from(count);
    let half = [0.5 * spacing; 2];
    let (from, to) = body.ends();
    let start = [0, 1].map(|axis| libm::floor(from[axis] / spacing) - 1.0);
    let rows = [0, 1].map(|axis| (libm::ceil(to[axis] / spacing) + 1.0 - start[axis]) as usize);
    let centre = |p: usize| {
        let at = [p % rows[0], p / rows[0]];
        [0, 1].map(|axis| (start[axis] + at[axis] as f64 + 0.5) * spacing)
    };
    let mut cuts: Vec<Cut> = (0..rows[0] * rows[1]).map(|p| body.cut(&centre(p), &half)).collect();
    join_small(&mut cuts, rows[0], half, &centre, &|label| body.holds(label));
    let all = cuts.into_iter().enumerate().flat_map(|(p, cut)| match cut {
        Cut::Nothing => Vec::new(),
        Cut::Whole => vec![Piece::whole(centre(p), half)],
        Cut::Pieces(pieces) => pieces,
    });
    all.collect()
}

/// Each corner may have a piece in the next cell that is so small that it is omitted.
fn is_exact(corners: &[[f64; 2]], count: i32) {
    let cell = 1.0 / f64::from(count * count);
    let bound = 1e-13 + corners.len() as f64 * ROUNDING * cell;
    let body = polygon(corners);
    let all = particles(&body, count);
    let found = all.iter().fold([0.0; 3], |sum, Piece { volume, place, .. }| {
        [sum[0] + volume, sum[1] + volume * place[0], sum[2] + volume * place[1]]
    });
    for (found, exact) in found.into_iter().zip(by_sides(corners)) {
        assert!((found - exact).abs() < bound, "{found} is not {exact}, {corners:?}, {count}");
    }
    for piece in &all {
        assert!(body.holds(&piece.place), "{:?} is outside of {corners:?}", piece.place);
        let [xx, xy, yx, yy] = piece.domain();
        assert_relative_eq!(4.0 * (xx * yy - xy * yx), piece.volume, max_relative = 1e-9);
    }
}

#[rstest]
fn mass_and_centroid_are_exact(
    #[values(TRIANGLE, ANGLE, COMB)] corners: &[[f64; 2]],
    #[values(1, 2, 3, 7, 10, 40)] count: i32,
    #[values(false, true)] is_turned: bool,
) {
    let mut corners = corners.to_vec();
    if is_turned {
        corners.reverse();
        corners.rotate_left(2);
    }
    is_exact(&corners, count);
}

/// A side passes a corner of a cell at 1.4e-6 m, with an area of 4e-13 m2 beyond it.
#[test]
fn a_negligible_piece_is_omitted() {
    let [one, other] = [
        [1.014_061_456_529_452_3, -0.006_158_796_960_851_92],
        [0.500_715_295_223_069_8, 0.218_704_232_731_431_8],
    ];
    let corners = [[-0.5, -0.4], one, other];
    let volume: f64 = particles(&polygon(&corners), 1).iter().map(|piece| piece.volume).sum();
    assert_relative_eq!(by_sides(&corners)[0] - volume, 4.08e-13, epsilon = 1e-15);
    is_exact(&corners, 1);
}

/// Generates star-shaped polygons: corners at random distances from a centre, at increasing angles.
fn star() -> impl Strategy<Value = Vec<[f64; 2]>> {
    prop::collection::vec((0.05..1.0_f64, 0.1..1.0_f64), 4..12).prop_map(|corners| {
        let whole: f64 = corners.iter().map(|(_, angle)| angle).sum();
        let mut angle = 0.0;
        let corner = |(radius, step): (f64, f64)| {
            angle += step;
            let turned = std::f64::consts::TAU * angle / whole;
            [0.3 + radius * libm::cos(turned), -0.2 + radius * libm::sin(turned)]
        };
        corners.into_iter().map(corner).collect()
    })
}

/// Whether the centre is inside: all angles between neighbouring corners are below 180 degrees.
fn is_around_its_centre(corners: &[[f64; 2]]) -> bool {
    let next = corners.iter().cycle().skip(1);
    corners.iter().zip(next).all(|(a, b)| {
        let [a, b] = [a, b].map(|p| [p[0] - 0.3, p[1] + 0.2]);
        a[0] * b[1] - a[1] * b[0] > 0.0
    })
}

proptest! {
    #[test]
    fn any_star_has_its_mass_and_centroid(corners in star(), count in 1..30_i32) {
        prop_assume!(is_around_its_centre(&corners));
        is_exact(&corners, count);
    }

    #[test]
    fn what_is_drawn_lies_in_the_polygon(corners in star(), seed: u64) {
        prop_assume!(is_around_its_centre(&corners));
        let body = polygon(&corners);
        let mut random = Random::new(seed);
        prop_assert!(body.holds(&body.point(&mut random)));
        let (centre, half) = body.patch(&mut random);
        for (x, y) in [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)] {
            prop_assert!(body.holds(&[centre[0] + x * half[0], centre[1] + y * half[1]]));
        }
        for rim in 0..body.rims().len() {
            let (label, normal) = body.on_rim(rim, &mut random);
            prop_assert!(body.holds(&label), "{:?}", label);
            let beside = |by: f64| [label[0] + by * normal[0], label[1] + by * normal[1]];
            prop_assert!(!body.holds(&beside(1e-9)), "{:?}", label);
        }
    }

    /// Integrals of a quadratic polynomial over all charts add up to the integral over the body.
    #[test]
    fn charts_cover_the_polygon(corners in star()) {
        prop_assume!(is_around_its_centre(&corners));
        let body = polygon(&corners);
        let mut sums = [0.0; 3];
        for (chart, axes) in body.charts().iter().enumerate() {
            prop_assert_eq!(axes, &vec![(0.0, 1.0); 2]);
            let ends = [-1.0, 1.0].map(|sign| 0.5 + sign * (1.0_f64 / 12.0).sqrt());
            for (s, t) in ends.into_iter().flat_map(|s| ends.map(|t| (s, t))) {
                let (place, volume) = body.place(chart, &[s, t]);
                let terms = [1.0, place[0], place[1]];
                sums = [0, 1, 2].map(|i| sums[i] + 0.25 * volume * terms[i]);
            }
        }
        for (found, exact) in sums.into_iter().zip(by_sides(&corners)) {
            prop_assert!((found - exact).abs() < 1e-13, "{} is not {}", found, exact);
        }
    }
}

#[rstest]
#[case::of_a_triangle(TRIANGLE)]
#[case::of_an_angle(ANGLE)]
fn sums_over_particles_are_of_second_order(#[case] corners: &[[f64; 2]]) {
    let body = polygon(corners);
    let parts: Vec<Vec<Point>> = triangles(corners).into_iter().map(Vec::from).collect();
    let exact = AreaMoments::from_pieces(&parts, &[0.0; 2]).second;
    let error = |count: i32| {
        let sum = |sum: f64, Piece { volume, place: [x, y], .. }: Piece| sum + volume * x * (x + y);
        exact[0] + exact[1] - particles(&body, count).into_iter().fold(0.0, sum)
    };
    for count in [40, 60, 90] {
        let order = libm::log2(error(count) / error(2 * count));
        assert!((1.9..2.1).contains(&order), "{order} from {count} on");
    }
}

/// No particle of a convex body is smaller than a quarter of a cell.
#[test]
fn no_sliver_stays() {
    let body = polygon(TRIANGLE);
    for count in [10, 16, 23, 40, 64, 97] {
        let least = 0.25 / f64::from(count * count);
        assert!(particles(&body, count).iter().all(|piece| piece.volume >= least), "{count}");
    }
}

#[test]
fn points_are_spread_evenly() {
    let (body, half) = (polygon(ANGLE), polygon(&[[0.1, 0.1], [0.4, 0.1], [0.4, 0.9], [0.1, 0.9]]));
    let share = by_sides(&[[0.1, 0.1], [0.4, 0.1], [0.4, 0.9], [0.1, 0.9]])[0] / by_sides(ANGLE)[0];
    let mut random = Random::new(1);
    let inside = (0..4000).filter(|_| half.holds(&body.point(&mut random))).count() as f64;
    assert!((inside / 4000.0 - share).abs() < 0.03, "{inside} of 4000, not {share}");
}

#[rstest]
#[case::sides_that_cross(&[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]], (0, 2))]
#[case::a_corner_on_a_side(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 0.0], [0.0, 1.0]], (0, 2))]
#[case::a_corner_twice(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 0.0], [-1.0, 1.0]], (0, 2))]
#[case::a_side_that_turns_back(&[[0.0, 0.0], [2.0, 0.0], [1.0, 0.0], [0.0, 1.0]], (0, 1))]
#[case::a_last_side_that_turns_back(&[[1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [3.0, 0.0]], (0, 3))]
#[case::a_line(&[[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]], (0, 2))]
fn polygon_that_is_not_simple_is_refused(
    #[case] corners: &[[f64; 2]],
    #[case] sides: (usize, usize),
) {
    assert_eq!(Polygon::new("polygon", corners), Err(sides));
}

#[test]
fn bodies_overlap_where_they_have_an_area_in_common() {
    let shifted =
        |x: f64, y: f64| polygon(&ANGLE.iter().map(|c| [c[0] + x, c[1] + y]).collect::<Vec<_>>());
    let (body, in_the_notch) = (polygon(ANGLE), shifted(0.3, 0.3));
    assert!(!body.overlaps(&in_the_notch) && !in_the_notch.overlaps(&body));
    assert!(body.overlaps(&shifted(0.299, 0.3)) && body.overlaps(&body));
    assert!(!body.overlaps(&shifted(0.8, 0.0)));
    assert_relative_eq!(body.distance(&[0.7, 0.8]), 0.3, max_relative = 1e-12);
    assert_relative_eq!(body.distance(&[0.2, 0.2]), 0.0);
}

/// The domain of a triangle has its area, and is inclined like its hypotenuse.
#[test]
fn domains_have_the_shape_of_the_piece() {
    let piece = |body: Polygon| match body.cut(&[0.5; 2], &[0.5; 2]) {
        Cut::Pieces(pieces) if pieces.len() == 1 => pieces[0].clone(),
        other => panic!("{other:?}"),
    };
    let rectangle = piece(polygon(&[[0.25, 0.5], [2.0, 0.5], [2.0, 2.0], [0.25, 2.0]]));
    assert_relative_eq!(rectangle.domain()[..], [0.375, 0.0, 0.0, 0.25], max_relative = 1e-12);
    assert_relative_eq!(rectangle.joints[..], [0.0, 0.5, 0.0, 0.75], max_relative = 1e-12);
    let half = piece(polygon(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]));
    let [xx, xy, yx, yy] = half.domain();
    assert_relative_eq!(4.0 * (xx * yy - xy * yx), 0.5, max_relative = 1e-12);
    assert!((xx - yy).abs() < 1e-12 && (xy - yx).abs() < 1e-12 && xy < -0.05 * xx, "{xx} {xy}");
}
