//! Fewer points for the same picture.

use super::svg::Pt;

/// A curve with more points than this is thinned.
const ENOUGH: usize = 1500;

/// Whether a curve of `count` points should be thinned.
pub(crate) fn needed(count: usize) -> bool {
    count > ENOUGH
}

/// Keeps the first, the lowest, the highest and the last of each sequence of points within one
/// pixel column: together they cover the same pixels, so that no peak is lost.
pub(crate) fn thin(points: &[Pt]) -> Vec<Pt> {
    points
        .chunk_by(|a, b| libm::floor(a.0) as i64 == libm::floor(b.0) as i64)
        .flat_map(extremes)
        .collect()
}

fn extremes(column: &[Pt]) -> Vec<Pt> {
    let height = |i: usize| column[i].1;
    let by_height = |a: &usize, b: &usize| height(*a).total_cmp(&height(*b));
    let mut kept: Vec<usize> = [
        (0..column.len()).next(),
        (0..column.len()).min_by(by_height),
        (0..column.len()).max_by(by_height),
        (0..column.len()).next_back(),
    ]
    .into_iter()
    .flatten()
    .collect();
    kept.sort_unstable();
    kept.dedup();
    kept.into_iter().map(|i| column[i]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn peaks_and_ends_survive() {
        let mut points: Vec<Pt> =
            (0..10_000).map(|i| (f64::from(i) / 100.0, f64::from(i % 7))).collect();
        points[4321].1 = 99.0;
        points[4322].1 = -99.0;
        let thinned = thin(&points);
        assert!(thinned.len() <= 400);
        assert!(thinned.contains(&points[4321]) && thinned.contains(&points[4322]));
        assert_eq!(thinned.first(), points.first());
        assert_eq!(thinned.last(), points.last());
    }

    #[test]
    fn a_point_alone_in_its_column_is_kept_once() {
        let points = [(0.5, 1.0), (1.5, 2.0), (2.5, 3.0)];
        assert_eq!(thin(&points), points);
    }

    #[test]
    fn order_is_kept_when_the_curve_turns_back() {
        let points = [(0.1, 0.0), (1.1, 1.0), (0.2, 2.0)];
        assert_eq!(thin(&points), points);
    }
}
