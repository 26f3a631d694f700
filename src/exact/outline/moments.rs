//! Area and moments of convex polygons.

use super::side::{Point, side, turn};
use super::triangle::TriangleCorners;

/// Area, first and second moments of convex polygons.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct AreaMoments {
    /// Area (m2).
    pub(super) area: f64,
    /// Integral of the place (m3).
    pub(super) first: Point,
    /// Integrals of the products of coordinates: xx, xy, yy (m4).
    pub(super) second: [f64; 3],
}

impl AreaMoments {
    /// The moments about `origin`.
    pub(super) fn of(pieces: &[Vec<Point>], origin: &Point) -> Self {
        let mut all = Self::default();
        for corners in pieces {
            for pair in corners.windows(2).skip(1) {
                all.add([corners[0], pair[0], pair[1]].map(|p| side(origin, &p)));
            }
        }
        all
    }

    /// Adds a triangle: the mean of the product of linear functions over it is a twelfth of the
    /// sum of their products at the corners and of the product of their sums.
    fn add(&mut self, corners: TriangleCorners) {
        let [a, b, c] = &corners;
        let area = 0.5 * turn(a, b, c);
        let sum = [0, 1].map(|axis| corners.iter().map(|p| p[axis]).sum::<f64>());
        self.area += area;
        for axis in 0..2 {
            self.first[axis] += area * sum[axis] / 3.0;
        }
        for (into, (i, k)) in self.second.iter_mut().zip([(0, 0), (0, 1), (1, 1)]) {
            let products: f64 = corners.iter().map(|p| p[i] * p[k]).sum();
            *into += area / 12.0 * (products + sum[i] * sum[k]);
        }
    }
}
