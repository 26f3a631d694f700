//! What makes the errors and the work of different methods comparable.

use super::quantity::Quantity;
use crate::exact::Truth;

/// What errors of a case are compared by, and how its work must grow.
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorScale {
    /// Which problem is solved, in words: the end of the run, and the truth. Only cases of one problem
    /// are compared.
    pub problem: String,
    /// What an error is divided by to be a share of the solution, in the unit of the judged error: 1
    /// where the suite states a scale, which has been applied, else the largest exact magnitude. NaN
    /// if there is none.
    pub size: f64,
    /// Work grows like spacing^-growth: one power for each axis of the body that is refined, and that
    /// of the time step.
    pub growth: f64,
}

/// The largest magnitude of the exact `of` at `places` (m) and `times` (s): of a vector its length, of
/// a tensor its Frobenius norm. What has no natural zero is measured by how much it changes: F from the
/// identity, a temperature by its range. NaN if the truth does not know it, or it is zero throughout.
pub fn largest_exact(of: Quantity, truth: &dyn Truth, places: &[Vec<f64>], times: &[f64]) -> f64 {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for place in places {
        for t in times {
            let Some(value) = magnitude(of, truth, place, *t) else { return f64::NAN };
            if !value.is_finite() {
                return f64::NAN;
            }
            (low, high) = (low.min(value), high.max(value));
        }
    }
    let size = if of == Quantity::Temperature { high - low } else { high };
    if size > 0.0 && size.is_finite() { size } else { f64::NAN }
}

fn magnitude(of: Quantity, truth: &dyn Truth, place: &[f64], t: f64) -> Option<f64> {
    let d = place.len();
    let mut exact = vec![0.0; of.components(d)];
    if !of.exact(truth, place, t, &mut exact) {
        return None;
    }
    match of {
        Quantity::Temperature => return exact.first().copied(),
        Quantity::DeformationGradient => (0..d).for_each(|i| exact[i * d + i] -= 1.0),
        _ => {}
    }
    Some(exact.iter().fold(0.0, |all, x| libm::hypot(all, *x)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use rstest::rstest;

    /// A rod that is stretched and warms up with time; it knows no stress.
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
        let found = largest_exact(of, &Rod, &places, &[0.0, 1.0, 2.0]);
        assert_relative_eq!(found, size, max_relative = 1e-14);
    }

    #[rstest]
    #[case::not_known(Quantity::Stress, 2.0)]
    #[case::not_a_number(Quantity::Velocity, 2.0)]
    #[case::zero(Quantity::Displacement, 0.0)]
    fn no_size(#[case] of: Quantity, #[case] until: f64) {
        assert!(largest_exact(of, &Rod, &[vec![1.0, 0.0]], &[0.0, until]).is_nan());
        assert!(largest_exact(of, &Rod, &[], &[until]).is_nan());
    }
}
