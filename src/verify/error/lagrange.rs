//! Lagrange interpolation on one axis of a lattice.

/// The `count` of the ascending coordinates `sorted` around `x`, or all where there are fewer: the
/// index of the first, and the weight of each.
pub(crate) fn weights(sorted: &[f64], x: f64, count: usize) -> (usize, Vec<f64>) {
    let count = sorted.len().min(count);
    let above = sorted.partition_point(|c| *c < x);
    let first = above.saturating_sub(count / 2).min(sorted.len() - count);
    let near = &sorted[first..first + count];
    let weight = |c: &f64| -> f64 {
        near.iter().filter(|other| *other != c).map(|other| (x - other) / (c - other)).product()
    };
    (first, near.iter().map(weight).collect())
}
