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

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    /// As many on one side as on the other, but for the ends of the lattice.
    #[rstest]
    #[case::inside(3.5, 2)]
    #[case::at_the_low_end(0.2, 0)]
    #[case::at_the_high_end(6.9, 4)]
    fn the_nearest_on_both_sides_are_taken(#[case] x: f64, #[case] first: usize) {
        let lattice: Vec<f64> = (0..8).map(f64::from).collect();
        assert_eq!(weights(&lattice, x, 4).0, first);
    }
}
