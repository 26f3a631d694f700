//! Norms of the error of one level.
//!
//! `|e_p|` is the Euclidean length of the error at label `p` (the reference position of a
//! particle), `w_p` its weight (reference volume), `m_p` its mass, and `n` the number of labels:
//!
//! ```text
//! rms  = sqrt(1/n sum |e_p|^2)             unweighted, as in Wobbes & Tielen (2015)
//! l1   = sum w_p |e_p| / sum w_p
//! l2   = sqrt(sum w_p |e_p|^2 / sum w_p)
//! linf = max |e_p|
//! mass_l2 = sqrt(sum m_p |e_p|^2 / sum m_p)
//! ```
//!
//! The squares of `|e_p| / linf` are summed, because they can neither overflow nor underflow.

use mpm_subject::named;
use serde::{Deserialize, Serialize};

named! {
    /// Norm of the judged error.
    #[derive(Default)]
    pub enum NormName {
        /// RMS over labels at the end.
        #[default]
        Rms = "rms",
        /// Mean, weighted by volume, at the end.
        L1 = "l1",
        /// RMS, weighted by volume, at the end.
        L2 = "l2",
        /// Largest error length at the end.
        Linf = "linf",
        /// RMS, weighted by mass, at the end. Suitable for a density that varies over the body.
        MassL2 = "mass_l2",
        /// Largest RMS over the instants.
        MaxRms = "max_rms",
        /// Largest L1 over the instants.
        MaxL1 = "max_l1",
        /// Largest L2 over the instants.
        MaxL2 = "max_l2",
        /// Largest error length over labels and instants.
        MaxLinf = "max_linf",
        /// Largest mass-weighted RMS over the instants.
        MaxMassL2 = "max_mass_l2",
    }
}

impl NormName {
    /// Whether the norm is the maximum of another norm over the instants.
    pub fn is_over_instants(self) -> bool {
        matches!(self, Self::MaxRms | Self::MaxL1 | Self::MaxL2 | Self::MaxLinf | Self::MaxMassL2)
    }

    /// Whether the norm is weighted by masses. Only some solvers report masses.
    pub fn is_by_mass(self) -> bool {
        matches!(self, Self::MassL2 | Self::MaxMassL2)
    }
}

/// Norms of one error field; all NaN for an empty field.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Norms {
    /// Root of the unweighted mean square.
    pub rms: f64,
    /// Mean, weighted by volume.
    pub l1: f64,
    /// Root of the mean square, weighted by volume.
    pub l2: f64,
    /// Largest error length.
    pub linf: f64,
    /// Root of the mean square weighted by mass; `None` if masses are unknown.
    pub mass_l2: Option<f64>,
}

impl Norms {
    /// Norms of an error that is zero everywhere.
    pub const ZERO: Self = Self { rms: 0.0, l1: 0.0, l2: 0.0, linf: 0.0, mass_l2: Some(0.0) };

    /// Norms without a measurement: NaN, and no `mass_l2`.
    pub const NONE: Self =
        Self { rms: f64::NAN, l1: f64::NAN, l2: f64::NAN, linf: f64::NAN, mass_l2: None };

    /// For each norm, returns the larger value; NaN if either value is NaN.
    #[must_use]
    #[inline]
    pub fn larger(self, other: Self) -> Self {
        Self {
            rms: larger(self.rms, other.rms),
            l1: larger(self.l1, other.l1),
            l2: larger(self.l2, other.l2),
            linf: larger(self.linf, other.linf),
            mass_l2: self.mass_l2.zip(other.mass_l2).map(|(a, b)| larger(a, b)),
        }
    }

    /// Returns these norms with `mass_l2` computed from `errors` and `masses`, which has one mass
    /// for each label. Without masses `mass_l2` is `None`.
    #[must_use]
    pub fn with_masses(self, errors: &[f64], dimension: usize, masses: &[f64]) -> Self {
        let by_mass = || Self::of(errors, dimension, masses).l2;
        Self { mass_l2: (!masses.is_empty()).then(by_mass), ..self }
    }

    /// Computes the norms of `errors`, which contains `dimension` components for each label, label
    /// by label. `weights` contains one weight for each label.
    ///
    /// A norm is not finite if an error or weight is not finite. All norms are NaN without labels,
    /// for slices whose lengths do not match, and for weights that are negative or all zero.
    pub fn of(errors: &[f64], dimension: usize, weights: &[f64]) -> Self {
        let total: f64 = weights.iter().sum();
        let fits = dimension > 0 && errors.len() == dimension * weights.len();
        if !(fits && total > 0.0 && weights.iter().all(|&w| w >= 0.0)) {
            return Self::NONE;
        }
        let lengths: Vec<f64> = errors.chunks_exact(dimension).map(length).collect();
        Self::of_lengths(&lengths, weights, total)
    }

    fn of_lengths(lengths: &[f64], weights: &[f64], total: f64) -> Self {
        let linf = lengths.iter().copied().fold(0.0, larger);
        if linf == 0.0 {
            return Self { linf, mass_l2: None, ..Self::ZERO };
        }
        let (mut squares, mut moment, mut weighted_squares) = (0.0, 0.0, 0.0);
        for (length, weight) in lengths.iter().zip(weights) {
            let scaled = length / linf;
            let square = scaled * scaled;
            squares += square;
            moment += weight * scaled;
            weighted_squares += weight * square;
        }
        Self {
            rms: linf * (squares / lengths.len() as f64).sqrt(),
            l1: linf * (moment / total),
            l2: linf * (weighted_squares / total).sqrt(),
            linf,
            mass_l2: None,
        }
    }
}

/// Errors of one quantity in a run, in every norm; all NaN if the run failed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RunErrors {
    /// Errors at the end. For a sum over the body, norms over the instants.
    pub at_end: Norms,
    /// Largest error over the instants, for each norm.
    pub largest: Norms,
}

impl RunErrors {
    /// Errors of a failed run.
    pub const NONE: Self = Self { at_end: Norms::NONE, largest: Norms::NONE };

    pub(super) const START: Self = Self { at_end: Norms::NONE, largest: Norms::ZERO };

    pub(super) fn add(&mut self, now: Norms) {
        self.at_end = now;
        self.largest = self.largest.larger(now);
    }

    /// Returns the error in `norm`.
    pub fn in_norm(&self, norm: NormName) -> f64 {
        match norm {
            NormName::Rms => self.at_end.rms,
            NormName::L1 => self.at_end.l1,
            NormName::L2 => self.at_end.l2,
            NormName::Linf => self.at_end.linf,
            NormName::MassL2 => self.at_end.mass_l2.unwrap_or(f64::NAN),
            NormName::MaxRms => self.largest.rms,
            NormName::MaxL1 => self.largest.l1,
            NormName::MaxL2 => self.largest.l2,
            NormName::MaxLinf => self.largest.linf,
            NormName::MaxMassL2 => self.largest.mass_l2.unwrap_or(f64::NAN),
        }
    }
}

pub(super) fn length(error: &[f64]) -> f64 {
    let mut length = 0.0;
    for component in error {
        length = libm::hypot(length, *component);
    }
    length
}

/// Returns the largest length of vectors in `dimension` dimensions; NaN if any length is NaN.
pub(in crate::verify) fn largest_length(vectors: &[f64], dimension: usize) -> f64 {
    vectors.chunks_exact(dimension.max(1)).map(length).fold(0.0, larger)
}

/// Returns the larger of two lengths; NaN if either is NaN (`f64::max` would ignore NaN).
#[inline]
pub fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) }
}

/// Scale for comparing the errors of different cases, and the growth of the work.
#[derive(Debug, Clone, PartialEq)]
pub struct ErrorScale {
    /// End of the run and kind of solution. Only cases with the same problem are compared.
    pub problem: String,
    /// Divisor that turns an error into a fraction of the solution, in the unit of the judged
    /// error: the largest exact magnitude, or NaN if there is none; 1 if the suite gives a scale,
    /// which is already applied.
    pub size: f64,
    /// Exponent g in work ~ spacing^-g: the number of refined axes of the body, plus the exponent
    /// of the number of steps.
    pub growth: f64,
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use rstest::rstest;

    #[test]
    fn norms_of_a_small_field_by_hand() {
        let norms = Norms::of(&[3.0, 4.0, 0.0, -1.0], 2, &[1.0, 3.0]);
        assert_relative_eq!(norms.rms, 13.0_f64.sqrt(), max_relative = 1e-15);
        assert_relative_eq!(norms.l1, 2.0, max_relative = 1e-15);
        assert_relative_eq!(norms.l2, 7.0_f64.sqrt(), max_relative = 1e-15);
        assert_relative_eq!(norms.linf, 5.0);
        assert_eq!(norms.mass_l2, None);
    }

    /// The errors have lengths 5 and 1 and masses 1 and 3, so the mean square is (25 + 3)/4.
    #[test]
    fn norm_by_mass_ignores_volumes() {
        let errors = [3.0, 4.0, 0.0, -1.0];
        let norms = Norms::of(&errors, 2, &[3.0, 1.0]);
        let found = norms.with_masses(&errors, 2, &[1.0, 3.0]);
        assert_relative_eq!(found.mass_l2.unwrap(), 7.0_f64.sqrt(), max_relative = 1e-15);
        assert_eq!(found.l2.to_bits(), norms.l2.to_bits());
        let mismatched = norms.with_masses(&errors, 2, &[1.0]);
        assert!(mismatched.mass_l2.is_some_and(f64::is_nan), "{mismatched:?}");
        assert_eq!(norms.with_masses(&errors, 2, &[]).mass_l2, None);
    }

    #[test]
    fn largest_norm_by_mass_needs_the_masses_at_all_instants() {
        let by_mass = |mass_l2| Norms { mass_l2, ..Norms::ZERO };
        let mut errors = RunErrors::START;
        errors.add(by_mass(Some(2.0)));
        errors.add(by_mass(Some(1.0)));
        assert_eq!(errors.in_norm(NormName::MassL2), 1.0);
        assert_eq!(errors.in_norm(NormName::MaxMassL2), 2.0);
        errors.add(by_mass(None));
        assert!(errors.in_norm(NormName::MaxMassL2).is_nan());
    }

    #[rstest]
    #[case::nothing(&[], 1, &[])]
    #[case::no_dimension(&[], 0, &[])]
    #[case::no_weight(&[1.0, 2.0], 1, &[0.0, 0.0])]
    #[case::negative_weight(&[1.0, 2.0], 1, &[2.0, -1.0])]
    #[case::missing_weight(&[1.0, 2.0], 1, &[1.0])]
    #[case::missing_component(&[1.0, 2.0, 3.0], 2, &[1.0, 1.0])]
    #[case::nan_weight(&[1.0], 1, &[f64::NAN])]
    #[case::nan_first(&[f64::NAN, 1.0], 1, &[1.0, 1.0])]
    #[case::nan_last(&[1.0, f64::NAN], 1, &[1.0, 1.0])]
    fn nothing_to_measure_is_nan(
        #[case] errors: &[f64],
        #[case] dimension: usize,
        #[case] weights: &[f64],
    ) {
        let Norms { rms, l1, l2, linf, .. } = Norms::of(errors, dimension, weights);
        assert!([rms, l1, l2, linf].iter().all(|norm| norm.is_nan()));
    }

    #[test]
    fn an_infinite_error_leaves_no_finite_norm() {
        let Norms { rms, l1, l2, linf, .. } = Norms::of(&[1.0, f64::INFINITY], 1, &[1.0, 1.0]);
        assert!([rms, l1, l2, linf].iter().all(|norm| !norm.is_finite()));
    }

    #[test]
    fn norm_is_zero_only_if_every_error_is_zero() {
        assert_eq!(Norms::of(&[0.0, 0.0], 2, &[1.0]).rms.to_bits(), 0);
        let tiny = Norms::of(&[1e-200, 0.0], 2, &[1.0]);
        assert_relative_eq!(tiny.l2, 1e-200, max_relative = 1e-15);
    }
}
