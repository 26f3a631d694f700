//! Natural scales that make the errors and the work of different methods comparable.

/// Scale that errors of a case are compared by, and growth of its work.
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorScale {
    /// The problem as text: the end of the run, and the kind of solution. Only cases of one problem
    /// are compared.
    pub problem: String,
    /// Divisor that makes an error a share of the solution, in the unit of the judged error: 1 if
    /// the suite states a scale, which is already applied, otherwise the largest exact magnitude.
    /// NaN if there is none.
    pub size: f64,
    /// Work grows like spacing^-growth: one power for each refined axis of the body, and one for
    /// the time step.
    pub growth: f64,
}

#[cfg(test)]
mod tests {
    use crate::exact::Truth;
    use crate::verify::Quantity;
    use approx::assert_relative_eq;
    use rstest::rstest;

    /// A rod that is stretched and heated over time, without exact stress.
    struct Rod;

    impl Truth for Rod {
        fn displacement(&self, label: &[f64], t: f64, into: &mut [f64]) {
            into.copy_from_slice(&[-3.0 * t * label[0], 4.0 * t * label[0]]);
        }
        fn velocity(&self, label: &[f64], _: f64, into: &mut [f64]) {
            into.copy_from_slice(&[f64::NAN * label[0], 0.0]);
        }
        fn deformation_gradient(&self, _: &[f64], t: f64, into: &mut [f64]) -> bool {
            into.copy_from_slice(&[1.0 - 3.0 * t, 0.0, 4.0 * t, 1.0]);
            true
        }
        fn temperature(&self, _: &[f64], t: f64) -> Option<f64> {
            Some(300.0 + t)
        }
    }

    #[rstest]
    #[case::a_length(Quantity::Displacement, 20.0)]
    #[case::from_the_identity(Quantity::DeformationGradient, 10.0)]
    #[case::a_range(Quantity::Temperature, 2.0)]
    fn sizes(#[case] of: Quantity, #[case] size: f64) {
        let places = [vec![0.0, 0.0], vec![2.0, 0.0]];
        let found = of.largest_exact(&Rod, &places, &[0.0, 1.0, 2.0]);
        assert_relative_eq!(found, size, max_relative = 1e-14);
    }

    #[rstest]
    #[case::not_known(Quantity::Stress, 2.0)]
    #[case::not_a_number(Quantity::Velocity, 2.0)]
    #[case::zero(Quantity::Displacement, 0.0)]
    fn no_size(#[case] of: Quantity, #[case] until: f64) {
        assert!(of.largest_exact(&Rod, &[vec![1.0, 0.0]], &[0.0, until]).is_nan());
        assert!(of.largest_exact(&Rod, &[], &[until]).is_nan());
    }

    #[test]
    fn a_value_that_is_no_number_is_not_left_out() {
        let found = Quantity::Displacement.largest_exact(&Rod, &[vec![1.0, 0.0]], &[1.0, f64::NAN]);
        assert!(found.is_nan(), "{found}");
    }
}
