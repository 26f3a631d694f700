//! What is compared: the fields of a state, and the error of each.
//!
//! The error of a tensor at a label is measured by its Frobenius norm, that of a vector by its
//! length: the square root of the sum of the squares of all components.

use super::norm::Norms;
use crate::{exact::Truth, named::named, subject::Samples};

named! {
    /// A field of a state.
    #[derive(Default)]
    pub enum Quantity {
        /// u = x - X (m).
        #[default]
        Displacement = "displacement",
        /// Velocity (m/s).
        Velocity = "velocity",
        /// Cauchy stress (Pa).
        Stress = "stress",
        /// F = dx/dX.
        DeformationGradient = "deformation_gradient",
        /// Temperature (K).
        Temperature = "temperature",
    }
}

impl Quantity {
    /// The name in a sentence.
    pub fn words(self) -> String {
        self.name().replace('_', " ")
    }

    /// Its unit; empty for a number.
    pub fn unit(self) -> &'static str {
        match self {
            Self::Displacement => "m",
            Self::Velocity => "m/s",
            Self::Stress => "Pa",
            Self::DeformationGradient => "",
            Self::Temperature => "K",
        }
    }

    /// Whether it is no motion, but what comes with it: not every subject and not every truth has it.
    pub fn is_optional(self) -> bool {
        matches!(self, Self::Stress | Self::DeformationGradient | Self::Temperature)
    }

    /// Whether it is the unknown that a subject solves for, whose errors tables show.
    pub fn is_primary(self) -> bool {
        matches!(self, Self::Displacement | Self::Temperature)
    }

    /// Numbers at each label in `d` dimensions.
    pub(crate) fn components(self, d: usize) -> usize {
        match self {
            Self::Displacement | Self::Velocity => d,
            Self::Stress | Self::DeformationGradient => d * d,
            // Without a dimension there is nothing to compare, be it a number.
            Self::Temperature => d.min(1),
        }
    }

    /// The column of `samples`.
    fn column(self, samples: &Samples) -> &[f64] {
        match self {
            Self::Displacement => &samples.displacement,
            Self::Velocity => &samples.velocity,
            Self::Stress => &samples.stress,
            Self::DeformationGradient => &samples.deformation_gradient,
            Self::Temperature => &samples.temperature,
        }
    }

    /// The exact value at one label; whether the truth knows it.
    pub(crate) fn exact(self, truth: &dyn Truth, label: &[f64], t: f64, into: &mut [f64]) -> bool {
        match self {
            Self::Displacement => truth.displacement(label, t, into),
            Self::Velocity => truth.velocity(label, t, into),
            Self::Stress => return truth.stress(label, t, into),
            Self::DeformationGradient => return truth.deformation_gradient(label, t, into),
            Self::Temperature => {
                return truth.temperature(label, t).map(|value| into[0] = value).is_some();
            }
        }
        true
    }

    /// The exact values at all labels; whether the truth knows them.
    fn exact_at_all(self, truth: &dyn Truth, samples: &Samples, t: f64, into: &mut [f64]) -> bool {
        let d = samples.dimension;
        if self == Self::Displacement {
            truth.displacements(d, &samples.label, t, into);
            return true;
        }
        let mut places = samples.label.chunks(d).zip(into.chunks_mut(self.components(d)));
        places.all(|(label, into)| self.exact(truth, label, t, into))
    }
}

/// Norms of `computed - exact` at the labels of `samples` at time `t`; all NaN if the subject or
/// the truth has no such quantity.
pub fn errors_of(quantity: Quantity, samples: &Samples, truth: &dyn Truth, t: f64) -> Norms {
    let d = samples.dimension;
    let components = quantity.components(d);
    let column = quantity.column(samples);
    if components == 0 || column.len() != components * samples.len() {
        return Norms::NONE;
    }
    let mut error = vec![0.0; column.len()];
    if !quantity.exact_at_all(truth, samples, t, &mut error) {
        return Norms::NONE;
    }
    for (error, computed) in error.iter_mut().zip(column) {
        *error = computed - *error;
    }
    Norms::of(&error, components, &samples.weight)
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use rstest::rstest;

    /// A plane under uniform shear stress that moves along X; it knows no F.
    struct Sheared;

    impl Truth for Sheared {
        fn displacement(&self, _: &[f64], t: f64, into: &mut [f64]) {
            into.copy_from_slice(&[2.0 * t, 0.0]);
        }
        fn velocity(&self, _: &[f64], _: f64, into: &mut [f64]) {
            into.copy_from_slice(&[2.0, 0.0]);
        }
        fn stress(&self, _: &[f64], _: f64, into: &mut [f64]) -> bool {
            into.copy_from_slice(&[0.0, 7.0, 7.0, 0.0]);
            true
        }
        fn temperature(&self, _: &[f64], _: f64) -> Option<f64> {
            Some(300.0)
        }
    }

    /// Two labels whose every column is off by a vector of length 5, or a tensor of norm 5.
    fn off_by_five() -> Samples {
        Samples {
            dimension: 2,
            label: vec![0.0, 0.0, 1.0, 0.0],
            displacement: vec![5.0, 4.0, 5.0, -4.0],
            velocity: vec![2.0, 5.0, -3.0, 0.0],
            weight: vec![1.0, 3.0],
            stress: vec![3.0, 7.0, 7.0, 4.0, 0.0, 10.0, 11.0, 0.0],
            deformation_gradient: vec![1.0; 8],
            temperature: vec![305.0, 295.0],
        }
    }

    #[rstest]
    #[case(Quantity::Displacement)]
    #[case(Quantity::Velocity)]
    #[case(Quantity::Stress)]
    #[case(Quantity::Temperature)]
    fn every_component_counts(#[case] quantity: Quantity) {
        let Norms { rms, l1, l2, linf } = errors_of(quantity, &off_by_five(), &Sheared, 1.0);
        for norm in [rms, l1, l2, linf] {
            assert_relative_eq!(norm, 5.0, max_relative = 1e-15);
        }
    }

    #[rstest]
    #[case::a_truth_without_it(off_by_five(), Quantity::DeformationGradient)]
    #[case::a_subject_without_it(Samples { stress: Vec::new(), ..off_by_five() }, Quantity::Stress)]
    #[case::no_heat(Samples { temperature: Vec::new(), ..off_by_five() }, Quantity::Temperature)]
    #[case::half_a_column(
        Samples { stress: vec![0.0, 7.0, 7.0, 0.0], ..off_by_five() },
        Quantity::Stress
    )]
    #[case::no_number(
        Samples { velocity: vec![2.0, 0.0, f64::NAN, 0.0], ..off_by_five() },
        Quantity::Velocity
    )]
    #[case::no_labels(Samples::default(), Quantity::Displacement)]
    fn what_cannot_be_compared_is_no_error_of_zero(
        #[case] samples: Samples,
        #[case] quantity: Quantity,
    ) {
        let norms = errors_of(quantity, &samples, &Sheared, 1.0);
        assert!(norms.rms.is_nan() && norms.linf.is_nan(), "{norms:?}");
    }
}
