//! Finds the smallest value of a parameter that is not stable.
//!
//! The range is scanned upwards, because a larger value may be stable again. The first interval
//! with an unstable upper end is bisected.

/// Stability limit of a parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StabilityLimit {
    /// Even the lowest value of the range is not stable.
    Below(f64),
    /// Values are stable up to this limit.
    At(f64),
    /// Every tested value is stable, up to this end of the range.
    Above(f64),
}

impl StabilityLimit {
    /// Returns the limit, if it lies in the range.
    pub fn value(self) -> Option<f64> {
        match self {
            Self::At(value) => Some(value),
            Self::Below(_) | Self::Above(_) => None,
        }
    }
}

/// Tests `points` values in geometric progression from `low` to `high`, which are both positive,
/// then bisects to the relative interval length `tolerance`.
///
/// # Errors
/// The first error of `stable`.
pub fn stability_limit<E>(
    low: f64,
    high: f64,
    points: u32,
    tolerance: f64,
    mut stable: impl FnMut(f64) -> Result<bool, E>,
) -> Result<StabilityLimit, E> {
    if !stable(low)? {
        return Ok(StabilityLimit::Below(low));
    }
    let ratio = libm::pow(high / low, 1.0 / f64::from(points.max(1)));
    let (mut below, mut above) = (low, None);
    for k in 1..=points.max(1) {
        let value = if k >= points { high } else { low * libm::pow(ratio, f64::from(k)) };
        if !stable(value)? {
            above = Some(value);
            break;
        }
        below = value;
    }
    let Some(mut above) = above else { return Ok(StabilityLimit::Above(high)) };
    while above / below > 1.0 + tolerance {
        let middle = (below * above).sqrt();
        if stable(middle)? {
            below = middle;
        } else {
            above = middle;
        }
    }
    Ok(StabilityLimit::At((below * above).sqrt()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use rstest::rstest;

    fn find(stable: impl Fn(f64) -> bool) -> StabilityLimit {
        stability_limit::<()>(0.1, 10.0, 20, 1e-4, |x| Ok(stable(x))).unwrap()
    }

    #[rstest]
    fn the_end_of_stability_is_found(#[values(0.37, 9.99)] end: f64) {
        let found = find(|x| x <= end).value().unwrap();
        assert!((found / end - 1.0).abs() <= 1e-4, "{found}");
    }

    #[test]
    fn limits_outside_the_range_are_reported() {
        assert_eq!(find(|_| true), StabilityLimit::Above(10.0));
        assert_eq!(find(|_| false), StabilityLimit::Below(0.1));
    }

    /// The parameter is stable again from 5. The first loss of stability determines the limit.
    #[test]
    fn first_loss_of_stability_is_the_limit() {
        let found = find(|x| x <= 1.0 || x >= 5.0).value().unwrap();
        assert!((found - 1.0).abs() <= 1e-3, "{found}");
    }

    /// Intervals grow by a constant ratio. The limit is the middle of the last bracket.
    #[test]
    fn values_are_tried_in_geometric_progression() {
        let mut tried = Vec::new();
        let stable = |x: f64| {
            tried.push(x);
            Ok::<bool, ()>(x < 5.0)
        };
        let found = stability_limit(1.0, 16.0, 4, 1.1, stable).unwrap();
        let expected = [1.0, 2.0, 4.0, 8.0];
        assert!(tried.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{tried:?}");
        assert_eq!(tried.len(), 4);
        let StabilityLimit::At(limit) = found else { panic!("{found:?}") };
        assert!((limit - 32_f64.sqrt()).abs() < 1e-12, "{limit}");
    }
}
