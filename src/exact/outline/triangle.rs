//! Polygons cut into triangles, and what half-planes leave of them.

use super::side::{Point, cross, side, turn};

/// Three corners, counter-clockwise.
pub(super) type TriangleCorners = [Point; 3];

/// The simple polygon of these corners, counter-clockwise, as triangles that do not overlap, by
/// cutting off ears (Meisters 1975, Polygons have ears).
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
        // A corner on a straight line takes no area with it. Where rounding hides all ears, the
        // largest goes: areas with their signs add up all the same.
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

/// The part of a convex polygon where `height` is not negative, a linear function of the place
/// (Sutherland & Hodgman 1974, Reentrant polygon clipping).
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
