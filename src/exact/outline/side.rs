//! Points and sides in the plane.

/// A point in the plane (m).
pub(super) type Point = [f64; 2];

/// From `a` to `b` (m).
pub(super) fn side(a: &Point, b: &Point) -> Point {
    [b[0] - a[0], b[1] - a[1]]
}

/// Third component of the cross product, positive where `b` is to the left of `a`.
pub(super) fn cross(a: &Point, b: &Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// Twice the area of a triangle (m2), positive where its corners go round counter-clockwise.
pub(super) fn turn(a: &Point, b: &Point, c: &Point) -> f64 {
    cross(&side(a, b), &side(a, c))
}

/// Whether two sides have a point in common other than the corner between them.
pub(super) fn meet(corners: &[Point], first: usize, second: usize) -> bool {
    let n = corners.len();
    let ends = |i: usize| (&corners[i], &corners[(i + 1) % n]);
    let ((a, b), (c, d)) = (ends(first), ends(second));
    // A side that turns back lies on the one before.
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

/// Distance of `p` from the line between `a` and `b` (m).
pub(super) fn distance(a: &Point, b: &Point, p: &Point) -> f64 {
    let (along, to) = (side(a, b), side(a, p));
    let square = along[0] * along[0] + along[1] * along[1];
    let share = ((along[0] * to[0] + along[1] * to[1]) / square).clamp(0.0, 1.0);
    libm::hypot(to[0] - share * along[0], to[1] - share * along[1])
}
