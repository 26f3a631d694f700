//! The mean stress, tr(sigma)/D.

use super::declaration::{Declaration, STRESS, TensorShape};
use std::borrow::Cow;

/// tr(sigma)/D of each label in D dimensions.
fn means(d: usize, stress: &[f64]) -> Vec<f64> {
    let trace = |s: &[f64]| (0..d).map(|i| s[i * d + i]).sum::<f64>();
    stress.chunks_exact((d * d).max(1)).map(|s| trace(s) / d as f64).collect()
}

pub(super) const MEAN_STRESS: Declaration = Declaration {
    shape: TensorShape::Scalar,
    computed: |samples| Cow::from(means(samples.dimension, &samples.stress)),
    exact: |truth, label, t, into| {
        let mut stress = vec![0.0; label.len() * label.len()];
        let is_known = truth.stress(label, t, &mut stress);
        into.copy_from_slice(&means(label.len(), &stress));
        is_known
    },
    ..STRESS
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::subject::Samples;

    #[test]
    fn mean_stress_is_a_third_of_the_trace_in_space() {
        let stress = vec![3.0, 9.0, 9.0, 9.0, 5.0, 9.0, 9.0, 9.0, 4.0];
        let samples = Samples { dimension: 3, stress, ..Samples::default() };
        assert_eq!(*(MEAN_STRESS.computed)(&samples), [4.0]);
    }
}
