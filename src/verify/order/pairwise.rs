//! The observed order between neighbouring levels.

use super::level::Level;

/// The observed order between two levels, with the true ratio of `h` and with its sign:
///
/// ```text
/// p = ln(error_coarse / error_fine) / ln(h_coarse / h_fine)
/// ```
///
/// Negative if the error grows under refinement. None where it does not exist: a zero, negative
/// or non-finite figure, or spacings that cannot be told apart.
pub fn observed_order(coarse: &Level, fine: &Level) -> Option<f64> {
    let fall = logarithm(coarse.error)? - logarithm(fine.error)?;
    let ratio = logarithm(coarse.h)? - logarithm(fine.h)?;
    let order = fall / ratio;
    order.is_finite().then_some(order)
}

/// The observed order of each level with the one before; None for the first.
pub(crate) fn pairwise(levels: &[Level]) -> Vec<Option<f64>> {
    let pairs = levels.windows(2);
    let orders = pairs.map(|pair| observed_order(&pair[0], &pair[1]));
    levels.first().map(|_| None).into_iter().chain(orders).collect()
}

fn logarithm(x: f64) -> Option<f64> {
    (x > 0.0 && x.is_finite()).then(|| libm::log(x))
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use rstest::rstest;

    #[rstest]
    #[case::halved((2.0, 4.0), (1.0, 1.0), 2.0)]
    #[case::growing_keeps_its_sign((2.0, 1.0), (1.0, 4.0), -2.0)]
    #[case::true_ratio((3.0, 9.0), (2.0, 4.0), 2.0)]
    #[case::flat((2.0, 1.0), (1.0, 1.0), 0.0)]
    fn orders(#[case] coarse: (f64, f64), #[case] fine: (f64, f64), #[case] expected: f64) {
        let levels = [coarse, fine].map(|(h, error)| Level::new(h, error));
        let orders = pairwise(&levels);
        assert_eq!(orders[0], None);
        assert_relative_eq!(orders[1].unwrap(), expected, max_relative = 1e-14);
    }

    #[rstest]
    #[case(0.0)]
    #[case(-1.0)]
    #[case(f64::NAN)]
    #[case(f64::INFINITY)]
    fn no_order_without_a_positive_figure(#[case] figure: f64) {
        let level = Level::new(2.0, 1.0);
        assert_eq!(observed_order(&level, &Level::new(1.0, figure)), None);
        assert_eq!(observed_order(&level, &Level::new(figure, 1.0)), None);
        assert_eq!(observed_order(&level, &level), None);
        assert!(pairwise(&[]).is_empty());
    }
}
