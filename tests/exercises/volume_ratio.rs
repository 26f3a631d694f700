//! The volume ratio, J = det F.

use super::declaration::{DEFORMATION_GRADIENT, Declaration, SolutionSize, TensorShape};
use std::borrow::Cow;

/// det F of each label in D dimensions.
fn ratios(d: usize, gradients: &[f64]) -> Vec<f64> {
    let ratio = |f: &[f64]| match d {
        1 => f[0],
        2 => f[0] * f[3] - f[1] * f[2],
        _ => (0..3).map(|j| f[j] * minor(f, j)).sum(),
    };
    gradients.chunks_exact((d * d).max(1)).map(ratio).collect()
}

/// The cofactor of component j of the first row.
fn minor(f: &[f64], j: usize) -> f64 {
    let (a, b) = ((j + 1) % 3, (j + 2) % 3);
    f[3 + a] * f[6 + b] - f[3 + b] * f[6 + a]
}

pub(super) const VOLUME_RATIO: Declaration = Declaration {
    shape: TensorShape::Scalar,
    computed: |samples| Cow::from(ratios(samples.dimension, &samples.deformation_gradient)),
    exact: |truth, label, t, into| {
        let mut f = vec![0.0; label.len() * label.len()];
        let is_known = truth.deformation_gradient(label, t, &mut f);
        into.copy_from_slice(&ratios(label.len(), &f));
        is_known
    },
    size: SolutionSize::Range,
    ..DEFORMATION_GRADIENT
};

#[cfg(test)]
mod tests {
    use super::*;
    use mpm_subject::Samples;

    #[test]
    fn volume_ratio_is_the_determinant_in_space() {
        let deformation_gradient = vec![2.0, 1.0, 0.0, 0.0, 3.0, 1.0, 1.0, 0.0, 4.0];
        let samples = Samples { dimension: 3, deformation_gradient, ..Samples::default() };
        assert_eq!(*(VOLUME_RATIO.computed)(&samples), [25.0]);
    }
}
