//! Panels with four straight sides, filled with particles by the bilinear map of the unit square,
//! `x = sum_c M_c(s) x_c` with the hat functions M_c of the corners.

use crate::mpm::foundation::algebra::{Matrix, Vector, det, inverse};
use crate::mpm::foundation::particles::Particles;

/// A panel in the plane. Its corners (m) are in counter-clockwise order, with a left turn at each
/// corner. The first corner starts the side whose direction is closest to X.
#[derive(Debug, Clone, PartialEq)]
pub struct Quadrilateral {
    corners: [Vector<2>; 4],
}

impl Quadrilateral {
    /// Creates the panel with these corners.
    ///
    /// # Errors
    /// The index of the first corner without a left turn.
    pub fn new(corners: [Vector<2>; 4]) -> Result<Self, usize> {
        let panel = Self { corners };
        let turns = |i: &usize| {
            det(&Matrix::from_columns(&[panel.side((i + 3) % 4), panel.side(*i)])) > 0.0
        };
        match (0..4).find(|i| !turns(i)) {
            Some(corner) => Err(corner),
            None => Ok(panel.upright()),
        }
    }

    /// Renumbers the corners so that the first axis of the map is as close to X as possible. The
    /// boxes of GIMP require this orientation, because their half-lengths are the diagonal entries
    /// of the domain matrix.
    fn upright(self) -> Self {
        let along = |i: &usize| self.side(*i)[0] - self.side((i + 2) % 4)[0];
        let first = (1..4).fold(0, |best, i| if along(&i) > along(&best) { i } else { best });
        Self { corners: std::array::from_fn(|i| self.corners[(first + i) % 4]) }
    }

    /// Returns the corners (m).
    pub fn corners(&self) -> &[Vector<2>; 4] {
        &self.corners
    }

    /// Returns the lowest and highest corners of the bounding box of the panel (m).
    pub fn ends(&self) -> (Vec<f64>, Vec<f64>) {
        let [a, b, c, d] = &self.corners;
        let end = |of: fn(f64, f64) -> f64| {
            (0..2).map(|axis| of(of(a[axis], b[axis]), of(c[axis], d[axis]))).collect()
        };
        (end(f64::min), end(f64::max))
    }

    /// Whether a whole side is at the low or high end of the panel along `axis`.
    pub fn has_side_at(&self, axis: usize, high: bool) -> bool {
        let (low, top) = self.ends();
        let end = if high { top[axis] } else { low[axis] };
        let at_end = |i: usize| self.corners[i % 4][axis] == end;
        (0..4).any(|i| at_end(i) && at_end(i + 1))
    }

    fn side(&self, i: usize) -> Vector<2> {
        self.corners[(i + 1) % 4] - self.corners[i]
    }

    /// Returns the number of particles along each axis of the map, at least two. The number is the
    /// mean length of two opposite sides divided by `h` (m), times `per_axis`, rounded.
    pub fn counts(&self, h: f64, per_axis: usize) -> [usize; 2] {
        [0, 1].map(|i| {
            let length = f64::midpoint(self.side(i).norm(), self.side(i + 2).norm());
            libm::round(length * per_axis as f64 / h).max(2.0) as usize
        })
    }

    /// Returns the position (m) of a point of the unit square, and the derivative of the map there
    /// (m).
    fn at(&self, s: f64, t: f64) -> (Vector<2>, Matrix<2>) {
        let [a, b, c, d] = &self.corners;
        let place = (a * (1.0 - s) + b * s) * (1.0 - t) + (d * (1.0 - s) + c * s) * t;
        let along = self.side(0) * (1.0 - t) - self.side(2) * t;
        let across = self.side(1) * s - self.side(3) * (1.0 - s);
        (place, Matrix::from_columns(&[along, across]))
    }

    /// Returns the point of the unit square that is mapped to `place` (m), by Newton's method from
    /// the centre. In a convex panel this point is unique.
    pub fn inverse(&self, place: &Vector<2>) -> [f64; 2] {
        const MOST_ITERATIONS: usize = 50;
        let mut point = Vector::<2>::from_element(0.5);
        for _ in 0..MOST_ITERATIONS {
            let (here, slope) = self.at(point[0], point[1]);
            let Some(change) = inverse(&slope).map(|inverse| inverse * (place - here)) else {
                break;
            };
            point += change;
            if change.norm() <= 4.0 * f64::EPSILON {
                break;
            }
        }
        [point[0], point[1]]
    }

    /// Fills the panel with particles of density `density` (kg/m^2).
    pub fn fill<const D: usize>(&self, density: f64, h: f64, per_axis: usize) -> Particles<D> {
        let counts = self.counts(h, per_axis);
        // In 3-D, a panel has unit thickness along the third axis.
        let counts = std::array::from_fn(|axis| counts.get(axis).copied().unwrap_or(1));
        Particles::fill_mapped(counts, density, |s| {
            let (place, slope) = self.at(s[0], s.get(1).copied().unwrap_or(0.5));
            let flat = |i: usize| i < 2;
            (
                Vector::from_fn(|i, _| if flat(i) { place[i] } else { s[i] }),
                Matrix::from_fn(|i, j| match (flat(i), flat(j)) {
                    (true, true) => slope[(i, j)],
                    _ => f64::from(u8::from(i == j)),
                }),
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mpm::basis::{Basis, ContiguousGimp, Cpdi, Domain, Linear, UniformGimp};
    use crate::mpm::foundation::grid::Grid;
    use approx::{assert_abs_diff_eq, assert_relative_eq};
    use proptest::prelude::*;

    fn cook() -> Quadrilateral {
        let corners = [[0.0, 0.0], [48.0, 44.0], [48.0, 60.0], [0.0, 44.0]];
        Quadrilateral::new(corners.map(Vector::from)).unwrap()
    }

    /// Creates a square with each corner moved by less than a quarter, so the panel remains convex.
    fn any() -> impl Strategy<Value = Quadrilateral> {
        prop::array::uniform4(prop::array::uniform2(-0.24..0.24_f64)).prop_map(|moved| {
            let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
            let corners = std::array::from_fn(|i| Vector::from(square[i]) + Vector::from(moved[i]));
            Quadrilateral::new(corners).unwrap()
        })
    }

    fn area(panel: &Quadrilateral) -> f64 {
        let [a, b, c, d] = panel.corners();
        0.5 * det(&Matrix::from_columns(&[c - a, d - b]))
    }

    fn is_inside(panel: &Quadrilateral, x: &Vector<2>) -> bool {
        let left = |i: usize| det(&Matrix::from_columns(&[panel.side(i), x - panel.corners[i]]));
        (0..4).all(|i| left(i) > 0.0)
    }

    proptest! {
        #[test]
        fn particles_fill_the_panel(panel in any(), h in 0.05..0.6_f64, per_axis in 1..4_usize) {
            let particles: Particles<2> = panel.fill(3.0, h, per_axis);
            let [n, m] = panel.counts(h, per_axis);
            prop_assert_eq!(particles.len(), n * m);
            let volume: f64 = particles.vol0.iter().sum();
            prop_assert!((volume - area(&panel)).abs() < 1e-13, "{} of {}", volume, area(&panel));
            prop_assert!((particles.mass.iter().sum::<f64>() - 3.0 * volume).abs() < 1e-12);
            for (x, domain) in particles.x0.iter().zip(&particles.domain0) {
                prop_assert!(is_inside(&panel, x), "{:?}", x);
                for axis in 0..2 {
                    // The middles of domain sides are inside the panel, up to rounding.
                    let towards = domain.column(axis) * (1.0 - 1e-9);
                    prop_assert!(is_inside(&panel, &(x + towards)));
                    prop_assert!(is_inside(&panel, &(x - towards)));
                }
            }
        }

        #[test]
        fn inverse_maps_a_position_back(
            panel in any(),
            s in -0.1..1.1_f64,
            t in -0.1..1.1_f64,
        ) {
            let [a, b] = panel.inverse(&panel.at(s, t).0);
            prop_assert!((a - s).abs() < 1e-12 && (b - t).abs() < 1e-12, "({}, {})", a, b);
        }

        #[test]
        fn derivative_agrees_with_differences_of_positions(
            panel in any(),
            s in 0.1..0.9_f64,
            t in 0.1..0.9_f64,
        ) {
            let d = 1e-3;
            let slope = panel.at(s, t).1;
            let along = (panel.at(s + d, t).0 - panel.at(s - d, t).0) / (2.0 * d);
            let across = (panel.at(s, t + d).0 - panel.at(s, t - d).0) / (2.0 * d);
            prop_assert!((slope.column(0) - along).norm() < 1e-12);
            prop_assert!((slope.column(1) - across).norm() < 1e-12);
        }
    }

    #[test]
    fn cooks_panel_has_two_upright_sides() {
        assert_relative_eq!(area(&cook()), 1440.0);
        assert_eq!(cook().ends(), (vec![0.0, 0.0], vec![48.0, 60.0]));
        let sides = [(0, false), (0, true), (1, false), (1, true)];
        assert_eq!(sides.map(|(a, high)| cook().has_side_at(a, high)), [true, true, false, false]);
    }

    /// Computes the largest nodal force of a uniform unit stress well inside a panel, relative to
    /// the force on a cell face of size `h`: `|sum_p V_p grad N_i|/h`.
    fn push<B: Basis>(panel: &Quadrilateral, h: f64) -> f64 {
        let mut particles: Particles<2> = panel.fill(1.0, h, 2);
        if B::DOMAIN == Domain::Follows {
            particles.track_domains();
        }
        let cells = [0, 1].map(|axis| libm::ceil(panel.ends().1[axis] / h) as usize);
        let counts = cells.map(|cells| B::count(cells, false));
        let grid = Grid::new(Vector::zeros(), h, cells, [false; 2], counts);
        let mut total = vec![Vector::<2>::zeros(); grid.nodes()];
        for (p, volume) in particles.vol0.iter().enumerate() {
            B::visit(&grid, &particles, p, |i| total[i.node] += i.gradient * (volume / h));
        }
        let is_far_inside = |i: &usize| {
            let node = Vector::<2>::new((i % counts[0]) as f64, (i / counts[0]) as f64);
            let corners = [(-2.0, -2.0), (2.0, -2.0), (2.0, 2.0), (-2.0, 2.0)];
            corners.iter().all(|(x, y)| is_inside(panel, &((node + Vector::from([*x, *y])) * h)))
        };
        (0..grid.nodes()).filter(is_far_inside).map(|i| total[i].norm()).fold(0.0, f64::max)
    }

    /// The parallelograms of CPDI tile any panel. The boxes of contiguous GIMP tile only a panel
    /// with two upright sides, and the equal boxes of uniform GIMP do not tile this panel either.
    #[test]
    fn boxes_of_gimp_tile_a_panel_with_two_upright_sides() {
        let (sin, cos) = libm::sincos(std::f64::consts::PI / 6.0);
        let corners = [(0.0, 0.0), (30.0, 0.0), (30.0, 30.0), (0.0, 30.0)];
        let turned =
            corners.map(|(x, y)| Vector::from([16.0 + cos * x - sin * y, 1.0 + sin * x + cos * y]));
        let turned = Quadrilateral::new(turned).unwrap();
        for h in [2.0, 1.0] {
            assert_abs_diff_eq!(push::<Cpdi>(&cook(), h), 0.0, epsilon = 1e-12);
            assert_abs_diff_eq!(push::<Cpdi>(&turned, h), 0.0, epsilon = 1e-12);
            assert_abs_diff_eq!(push::<ContiguousGimp>(&cook(), h), 0.0, epsilon = 1e-12);
            assert_abs_diff_eq!(push::<UniformGimp>(&cook(), h), 0.07, epsilon = 0.03);
            assert_abs_diff_eq!(push::<ContiguousGimp>(&turned, h), 0.0133, epsilon = 3e-4);
            assert_abs_diff_eq!(push::<UniformGimp>(&turned, h), 0.0133, epsilon = 3e-4);
            assert_abs_diff_eq!(push::<Linear>(&cook(), h), 0.57, epsilon = 0.05);
            assert_abs_diff_eq!(push::<Linear>(&turned, h), 0.35, epsilon = 0.01);
        }
    }

    #[test]
    fn corner_with_a_right_turn_is_reported() {
        let [a, b, c, d] = *cook().corners();
        assert_eq!(Quadrilateral::new([a, d, c, b]), Err(0));
        assert_eq!(Quadrilateral::new([a, b, (a + b) * 0.5, d]), Err(1));
        assert_eq!(Quadrilateral::new([a, b, Vector::<2>::new(f64::NAN, 0.0), d]), Err(1));
        assert_eq!(Quadrilateral::new([a, b, c, b]), Err(0));
    }

    #[test]
    fn first_corner_does_not_affect_the_panel() {
        let [a, b, c, d] = *cook().corners();
        for corners in [[b, c, d, a], [c, d, a, b], [d, a, b, c]] {
            assert_eq!(Quadrilateral::new(corners), Ok(cook()));
        }
    }
}
