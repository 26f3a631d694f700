//! Polygons: sides, triangulation and moments.

use super::{Cut, Outline, Piece, ROUNDING};
use crate::exact::random::Random;

/// Number of random candidates for a patch; the one furthest from all sides is used.
const CANDIDATES: usize = 8;

/// A simple polygon: its sides meet only at its corners.
#[derive(Debug, Clone, PartialEq)]
pub struct Polygon {
    kind: &'static str,
    /// Corners in counter-clockwise order.
    corners: Vec<Point>,
    triangles: Vec<TriangleCorners>,
}

impl Polygon {
    /// Creates the polygon with these corners (m), in either orientation, of the shape `kind`.
    ///
    /// # Errors
    /// Indices of two sides that cross, or that touch other than at a common corner. Side i begins
    /// at corner i.
    pub fn new(kind: &'static str, corners: &[[f64; 2]]) -> Result<Self, (usize, usize)> {
        let n = corners.len();
        for second in 0..n {
            for first in 0..second {
                if meet(corners, first, second) {
                    return Err((first, second));
                }
            }
        }
        let mut corners = corners.to_vec();
        let doubled: f64 = (1..n).map(|i| turn(&corners[0], &corners[i - 1], &corners[i])).sum();
        if doubled < 0.0 {
            corners.reverse();
        }
        let triangles = triangles(&corners);
        Ok(Self { kind, corners, triangles })
    }

    /// Whether both polygons have a common area.
    pub fn overlaps(&self, other: &Self) -> bool {
        let area: f64 = [self, other].map(Self::area).into_iter().fold(f64::INFINITY, f64::min);
        let common = |one: &TriangleCorners, other: &TriangleCorners| {
            let sides = [0, 1, 2].map(|i| (other[i], other[(i + 1) % 3]));
            let piece = sides
                .iter()
                .fold(one.to_vec(), |left, (from, to)| clip(&left, |p| turn(from, to, p)));
            AreaMoments::from_pieces(&[piece], &one[0]).area
        };
        let pairs =
            self.triangles.iter().flat_map(|one| other.triangles.iter().map(move |two| (one, two)));
        pairs.map(|(one, two)| common(one, two)).sum::<f64>() > ROUNDING * area
    }

    fn area(&self) -> f64 {
        self.triangles.iter().map(|[a, b, c]| 0.5 * turn(a, b, c)).sum()
    }

    fn sides(&self) -> impl Iterator<Item = (&Point, &Point)> {
        self.corners.iter().zip(self.corners.iter().cycle().skip(1))
    }

    /// Returns the distance of a point from the nearest side (m).
    fn depth(&self, p: &Point) -> f64 {
        self.sides().map(|(a, b)| distance(a, b, p)).fold(f64::INFINITY, f64::min)
    }

    /// Returns the piece that consists of these convex `parts` of a cell; `None` if negligible.
    fn piece(parts: &[Vec<Point>], centre: &Point, half: &Point) -> Option<Piece> {
        let AreaMoments { area, first, .. } = AreaMoments::from_pieces(parts, centre);
        if !(area > ROUNDING * 4.0 * half[0] * half[1]) {
            return None;
        }
        let place: Point = [0, 1].map(|axis| centre[axis] + first[axis] / area);
        let spread = AreaMoments::from_pieces(parts, &place).second.map(|moment| moment / area);
        let joint = |(axis, sign): (usize, f64)| {
            let is_at = |p: &Point| {
                (sign * (p[axis] - centre[axis]) - half[axis]).abs() <= 1e-9 * half[axis]
            };
            let sides = parts.iter().flat_map(|part| part.iter().zip(part.iter().cycle().skip(1)));
            let along = sides.filter(|(a, b)| is_at(a) && is_at(b));
            along.map(|(a, b)| (b[1 - axis] - a[1 - axis]).abs()).sum()
        };
        let joints = [(0, -1.0), (0, 1.0), (1, -1.0), (1, 1.0)].map(joint);
        Some(Piece { volume: area, place, spread, joints })
    }
}

impl Outline for Polygon {
    fn kind(&self) -> &'static str {
        self.kind
    }

    fn row(&self) -> String {
        let corners = self.corners.iter().map(|[x, y]| format!("({x}, {y})"));
        format!("{} {} m", self.kind, corners.collect::<Vec<_>>().join(", "))
    }

    fn ends(&self) -> (Vec<f64>, Vec<f64>) {
        let end = |start: f64, of: fn(f64, f64) -> f64| {
            [0, 1].map(|axis| self.corners.iter().map(|c| c[axis]).fold(start, of)).to_vec()
        };
        (end(f64::INFINITY, f64::min), end(f64::NEG_INFINITY, f64::max))
    }

    /// Whether the polygon contains the point. Counts the sides that a ray to the right crosses.
    fn holds(&self, label: &[f64]) -> bool {
        let p = [label[0], label[1]];
        let (from, to) = self.ends();
        let size = libm::hypot(to[0] - from[0], to[1] - from[1]);
        let crossed = |(a, b): &(&Point, &Point)| {
            let up = a[1] <= p[1];
            up != (b[1] <= p[1]) && (turn(a, b, &p) > 0.0) == up
        };
        self.sides().filter(crossed).count() % 2 == 1 || self.depth(&p) <= ROUNDING * size
    }

    fn distance(&self, label: &[f64]) -> f64 {
        if self.holds(label) { 0.0 } else { self.depth(&[label[0], label[1]]) }
    }

    /// Returns the exact intersection of cell and body, with a particle at its centroid, or one for
    /// each convex piece if the centroid is outside the body. Sums over the particles approximate
    /// integrals to second order in the spacing, also at the rim.
    fn cut(&self, centre: &[f64], half: &[f64]) -> Cut {
        let (centre, half) = ([centre[0], centre[1]], [half[0], half[1]]);
        let is_near = |corners: &&TriangleCorners| {
            [0, 1].into_iter().all(|axis| {
                corners.iter().any(|p| p[axis] > centre[axis] - half[axis])
                    && corners.iter().any(|p| p[axis] < centre[axis] + half[axis])
            })
        };
        let [from, to] =
            [-1.0, 1.0].map(|sign| [0, 1].map(|axis| centre[axis] + sign * half[axis]));
        let parts =
            self.triangles.iter().filter(is_near).map(|corners| inside(corners, &from, &to));
        let parts: Vec<Vec<Point>> = parts.collect();
        let whole = (1.0 - ROUNDING) * 4.0 * half[0] * half[1];
        match Self::piece(&parts, &centre, &half) {
            None => Cut::Nothing,
            Some(piece) if piece.volume >= whole => Cut::Whole,
            Some(piece) if self.holds(&piece.place) => Cut::Pieces(vec![piece]),
            Some(_) => {
                let each = parts.iter().map(std::slice::from_ref);
                Cut::Pieces(each.filter_map(|part| Self::piece(part, &centre, &half)).collect())
            }
        }
    }

    fn volume_within(&self, from: &[f64], to: &[f64]) -> f64 {
        let parts = self.triangles.iter().map(|corners| inside(corners, from, to));
        AreaMoments::from_pieces(&parts.collect::<Vec<_>>(), &self.corners[0]).area
    }

    fn trace(&self) -> Vec<(f64, f64)> {
        self.corners.iter().map(|c| (c[0], c[1])).collect()
    }

    fn rims(&self) -> Vec<String> {
        let side = |(a, b): (&Point, &Point)| {
            format!("the side from ({}, {}) to ({}, {})", a[0], a[1], b[0], b[1])
        };
        self.sides().map(side).collect()
    }

    fn on_rim(&self, rim: usize, random: &mut Random) -> (Vec<f64>, [f64; 3]) {
        let (a, b) = (self.corners[rim], self.corners[(rim + 1) % self.corners.len()]);
        let ([x, y], share) = (side(&a, &b), random.unit());
        let length = libm::hypot(x, y);
        (vec![a[0] + share * x, a[1] + share * y], [y / length, -x / length, 0.0])
    }

    fn point(&self, random: &mut Random) -> Vec<f64> {
        let mut left = random.between(0.0, self.area());
        let area = |[a, b, c]: &TriangleCorners| 0.5 * turn(a, b, c);
        let chosen = self.triangles.iter().position(|triangle| {
            left -= area(triangle);
            left < 0.0
        });
        let chart = chosen.unwrap_or(self.triangles.len() - 1);
        // The area per unit of the first coordinate is proportional to it. The square root makes
        // the distribution uniform.
        self.place(chart, &[random.unit().sqrt(), random.unit()]).0
    }

    fn patch(&self, random: &mut Random) -> (Vec<f64>, Vec<f64>) {
        let mut candidate = || {
            let point = self.point(random);
            let depth = self.depth(&[point[0], point[1]]);
            (point, depth)
        };
        let mut best = candidate();
        for other in (1..CANDIDATES).map(|_| candidate()) {
            if other.1 > best.1 {
                best = other;
            }
        }
        let (centre, depth) = best;
        let corner = depth * std::f64::consts::FRAC_1_SQRT_2;
        let half = centre.iter().map(|_| corner * random.between(0.2, 1.0)).collect();
        (centre, half)
    }

    /// Returns one chart per triangle: a unit square with one side mapped to the first corner.
    fn charts(&self) -> Vec<Vec<(f64, f64)>> {
        self.triangles.iter().map(|_| vec![(0.0, 1.0); 2]).collect()
    }

    fn place(&self, chart: usize, coordinates: &[f64]) -> (Vec<f64>, f64) {
        let ([a, b, c], [s, t]) = (&self.triangles[chart], [coordinates[0], coordinates[1]]);
        let (along, across) = (side(a, b), side(b, c));
        let place = [0, 1].map(|axis| a[axis] + s * (along[axis] + t * across[axis]));
        (place.to_vec(), s * cross(&along, &across))
    }
}

fn inside(corners: &TriangleCorners, from: &[f64], to: &[f64]) -> Vec<Point> {
    [0, 1].into_iter().fold(corners.to_vec(), |left, axis| {
        clip(&clip(&left, |p| p[axis] - from[axis]), |p| to[axis] - p[axis])
    })
}

#[derive(Debug, Clone, Copy, Default)]
pub(super) struct AreaMoments {
    pub(super) area: f64,
    /// Integral of the position (m3).
    pub(super) first: Point,
    /// Integrals of the products of coordinates: xx, xy, yy (m4).
    pub(super) second: [f64; 3],
}

impl AreaMoments {
    pub(super) fn from_pieces(pieces: &[Vec<Point>], origin: &Point) -> Self {
        let mut all = Self::default();
        for corners in pieces {
            for pair in corners.windows(2).skip(1) {
                all.add([corners[0], pair[0], pair[1]].map(|p| side(origin, &p)));
            }
        }
        all
    }

    /// The mean of x y is 1/12 of the sum at the corners plus the product of the sums of x and y.
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

pub(super) type Point = [f64; 2];

pub(super) fn side(a: &Point, b: &Point) -> Point {
    [b[0] - a[0], b[1] - a[1]]
}

/// Returns the third component of the cross product, positive if `b` is to the left of `a`.
pub(super) fn cross(a: &Point, b: &Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// Returns twice the signed area of a triangle (m2), positive for counter-clockwise corners.
pub(super) fn turn(a: &Point, b: &Point, c: &Point) -> f64 {
    cross(&side(a, b), &side(a, c))
}

/// Whether two sides have a common point other than the corner between them.
pub(super) fn meet(corners: &[Point], first: usize, second: usize) -> bool {
    let n = corners.len();
    let ends = |i: usize| (&corners[i], &corners[(i + 1) % n]);
    let ((a, b), (c, d)) = (ends(first), ends(second));
    // A side that reverses direction overlaps with the previous side.
    let back = |from: &Point, corner: &Point, to: &Point| {
        let (before, after) = (side(from, corner), side(corner, to));
        turn(from, corner, to) == 0.0 && before[0] * after[0] + before[1] * after[1] < 0.0
    };
    if second == first + 1 {
        return back(a, b, d);
    }
    if first == 0 && second == n - 1 {
        return back(c, a, b);
    }
    let apart = |a: &Point, b: &Point, c: &Point, d: &Point| {
        let (left, right) = (turn(a, b, c), turn(a, b, d));
        (left > 0.0 && right > 0.0) || (left < 0.0 && right < 0.0)
    };
    let beside = |axis: usize| {
        a[axis].max(b[axis]) < c[axis].min(d[axis]) || c[axis].max(d[axis]) < a[axis].min(b[axis])
    };
    !(apart(a, b, c, d) || apart(c, d, a, b) || beside(0) || beside(1))
}

pub(super) fn distance(a: &Point, b: &Point, p: &Point) -> f64 {
    let (along, to) = (side(a, b), side(a, p));
    let square = along[0] * along[0] + along[1] * along[1];
    let share = ((along[0] * to[0] + along[1] * to[1]) / square).clamp(0.0, 1.0);
    libm::hypot(to[0] - share * along[0], to[1] - share * along[1])
}

/// Three corners in counter-clockwise order.
pub(super) type TriangleCorners = [Point; 3];

/// Triangulates a simple counter-clockwise polygon by ear clipping (Meisters 1975).
pub(super) fn triangles(corners: &[Point]) -> Vec<TriangleCorners> {
    let mut left: Vec<usize> = (0..corners.len()).collect();
    let mut found = Vec::new();
    while left.len() > 2 {
        let n = left.len();
        let ear = |i: usize| [left[(i + n - 1) % n], left[i], left[(i + 1) % n]];
        let at = |i: usize| ear(i).map(|k| corners[k]);
        let is_free = |i: &usize| {
            let ([a, b, c], own) = (at(*i), ear(*i));
            let inside = |p: &Point| {
                [(a, b), (b, c), (c, a)].iter().all(|(from, to)| turn(from, to, p) >= 0.0)
            };
            turn(&a, &b, &c) > 0.0 && left.iter().all(|k| own.contains(k) || !inside(&corners[*k]))
        };
        // A corner on a straight line is removed first. If rounding hides all ears, the largest
        // triangle is removed; the sum of signed areas remains correct.
        let area = |i: &usize| at(*i).map(|p| side(&at(*i)[0], &p));
        let area = |i: &usize| cross(&area(i)[1], &area(i)[2]);
        let flat = (0..n).find(|i| area(i) == 0.0);
        let largest = || (0..n).max_by(|i, k| area(i).total_cmp(&area(k)));
        let Some(next) = flat.or_else(|| (0..n).find(is_free)).or_else(largest) else { break };
        if flat.is_none() {
            found.push(at(next));
        }
        left.remove(next);
    }
    found
}

/// Returns the part of a convex polygon where `height`, a linear function of position, is not
/// negative (Sutherland & Hodgman 1974).
pub(super) fn clip(corners: &[Point], height: impl Fn(&Point) -> f64) -> Vec<Point> {
    let mut kept = Vec::with_capacity(corners.len() + 1);
    for (i, to) in corners.iter().enumerate() {
        let from = &corners[(i + corners.len() - 1) % corners.len()];
        let (before, after) = (height(from), height(to));
        if (before < 0.0) != (after < 0.0) {
            let share = before / (before - after);
            kept.push([0, 1].map(|axis| from[axis] + share * (to[axis] - from[axis])));
        }
        if after >= 0.0 {
            kept.push(*to);
        }
    }
    kept
}
