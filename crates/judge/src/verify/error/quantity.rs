//! Registry of the quantities that can be judged.
//!
//! To add a quantity, add its name to [`Quantity`], its [`Declaration`] to the constants of
//! [`declaration`](super::declaration), and a line to [`Quantity::declaration`] that links the two.
//!
//! The error at a label is the length of a vector, or the Frobenius norm of a tensor.

use super::declaration::{
    ANGULAR_MOMENTUM, DEFORMATION_GRADIENT, DEVIATORIC_STRESS, DISPLACEMENT, Declaration, ENERGY,
    KINETIC_ENERGY, MEAN_STRESS, MOMENTUM, RADIUS_OF_GYRATION, REACTION, SEMI_AXIS, STRAIN_ENERGY,
    STRESS, STRESS_XX, STRESS_XY, STRESS_XZ, STRESS_YY, STRESS_YZ, STRESS_ZZ, SolutionSize,
    SumDeclaration, SumNeed, TEMPERATURE, VELOCITY,
};
use crate::exact::Truth;
use crate::verify::{Norms, format_number};
use mpm_subject::Samples;
use mpm_subject::named;
use std::borrow::Cow;

named! {
    /// A field of a state, or a sum over the body.
    #[derive(Default)]
    pub enum Quantity {
        /// u = x - X (m).
        #[default]
        Displacement = "displacement",
        /// Velocity (m/s).
        Velocity = "velocity",
        /// Cauchy stress (Pa).
        Stress = "stress",
        /// Component xx of the Cauchy stress (Pa), positive in tension.
        StressXx = "stress_xx",
        /// Component yy of the Cauchy stress (Pa), positive in tension.
        StressYy = "stress_yy",
        /// Component zz of the Cauchy stress (Pa), positive in tension.
        StressZz = "stress_zz",
        /// Component xy of the Cauchy stress (Pa), positive in tension.
        StressXy = "stress_xy",
        /// Component xz of the Cauchy stress (Pa), positive in tension.
        StressXz = "stress_xz",
        /// Component yz of the Cauchy stress (Pa), positive in tension.
        StressYz = "stress_yz",
        /// Mean stress -tr(sigma)/3 (Pa), positive in compression.
        MeanStress = "mean_stress",
        /// Deviatoric stress sqrt(3/2 s:s) (Pa) of the stress deviator s.
        DeviatoricStress = "deviatoric_stress",
        /// F = dx/dX.
        DeformationGradient = "deformation_gradient",
        /// Temperature (K).
        Temperature = "temperature",
        /// Kinetic energy of the body (J).
        KineticEnergy = "kinetic_energy",
        /// Energy that the material stores (J).
        StrainEnergy = "strain_energy",
        /// Kinetic and stored energy together (J).
        Energy = "energy",
        /// Linear momentum (kg m/s).
        Momentum = "momentum",
        /// Angular momentum about the origin (kg m2/s).
        AngularMomentum = "angular_momentum",
        /// Root of the ratio of `sum m |x|^2` to `sum m |X|^2`, about the origin.
        RadiusOfGyration = "radius_of_gyration",
        /// Root of the ratio of `sum m x^2` to `sum m X^2`, for each axis.
        SemiAxis = "semi_axis",
        /// Force of walls on the body (N).
        Reaction = "reaction",
    }
}

impl Quantity {
    const fn declaration(self) -> &'static Declaration {
        match self {
            Self::Displacement => &DISPLACEMENT,
            Self::Velocity => &VELOCITY,
            Self::Stress => &STRESS,
            Self::StressXx => &STRESS_XX,
            Self::StressYy => &STRESS_YY,
            Self::StressZz => &STRESS_ZZ,
            Self::StressXy => &STRESS_XY,
            Self::StressXz => &STRESS_XZ,
            Self::StressYz => &STRESS_YZ,
            Self::MeanStress => &MEAN_STRESS,
            Self::DeviatoricStress => &DEVIATORIC_STRESS,
            Self::DeformationGradient => &DEFORMATION_GRADIENT,
            Self::Temperature => &TEMPERATURE,
            Self::KineticEnergy => &KINETIC_ENERGY,
            Self::StrainEnergy => &STRAIN_ENERGY,
            Self::Energy => &ENERGY,
            Self::Momentum => &MOMENTUM,
            Self::AngularMomentum => &ANGULAR_MOMENTUM,
            Self::RadiusOfGyration => &RADIUS_OF_GYRATION,
            Self::SemiAxis => &SEMI_AXIS,
            Self::Reaction => &REACTION,
        }
    }

    /// Returns the quantity with this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|known| known.name() == name)
    }

    /// Returns the name as written in running text.
    pub fn words(self) -> String {
        self.name().replace('_', " ")
    }

    /// Returns the unit; empty for a dimensionless quantity.
    pub fn unit(self) -> &'static str {
        self.declaration().unit
    }

    /// Whether the quantity is a primary unknown of a solver. Tables show the errors of primary
    /// unknowns.
    pub fn is_primary(self) -> bool {
        self.declaration().is_primary
    }

    /// Whether the quantity is defined only by some solvers and exact solutions.
    pub fn is_optional(self) -> bool {
        self.declaration().is_optional
    }

    /// Whether the quantity is defined only for moving bodies, not for heat conduction.
    pub fn is_of_motion(self) -> bool {
        self.declaration().is_of_motion
    }

    /// Whether a solver must store F for this quantity.
    pub fn needs_deformation_gradient(self) -> bool {
        self.declaration().needs_deformation_gradient
    }

    /// Whether the quantity is the stress, or is computed from the stress.
    pub fn is_stress(self) -> bool {
        self.unit() == "Pa"
    }

    /// Whether the quantity depends on the out-of-plane stress of a two-dimensional body.
    pub fn needs_stress_across(self) -> bool {
        matches!(self, Self::StressZz | Self::MeanStress | Self::DeviatoricStress)
    }

    /// Returns the names of the sample columns that the quantity is computed from in `dimension`
    /// dimensions; empty for a sum over the body, or if every solver reports the quantity.
    pub fn columns(self, dimension: usize) -> Vec<&'static str> {
        if !self.is_optional() || self.is_sum() {
            return Vec::new();
        }
        let across = (dimension == 2 && self.needs_stress_across()).then_some("stress_across");
        let own = match self {
            of if of.is_stress() => "stress",
            of if of.needs_deformation_gradient() => "deformation_gradient",
            of => of.name(),
        };
        [own].into_iter().chain(across).collect()
    }

    /// Whether the quantity is a sum over the body, whose error norms are over the instants.
    pub fn is_sum(self) -> bool {
        self.sum().is_some()
    }

    /// Returns the property that a sum requires in addition to a moving body; `None` for a field.
    pub fn sum_need(self) -> Option<SumNeed> {
        self.sum().map(|sum| sum.needs)
    }

    /// Formats a divisor of the error for captions, to four digits.
    pub fn shown_scale(self, scale: f64) -> String {
        if self.is_sum() { format!("{scale:.3e}") } else { format_number(scale) }
    }

    pub(super) fn sum(self) -> Option<SumDeclaration> {
        self.declaration().sum
    }

    /// Returns the magnitude of the stored numbers whose rounding limits the smallest possible
    /// error, for a body of length `length` (m); NaN if unknown.
    pub fn rounding_size(self, length: f64) -> f64 {
        (self.declaration().rounding_size)(length)
    }

    fn components(self, d: usize) -> usize {
        self.declaration().shape.components(d)
    }

    /// Returns the values in `samples`, label by label; empty if the solver reports none.
    pub fn computed(self, samples: &Samples) -> Cow<'_, [f64]> {
        (self.declaration().computed)(samples)
    }

    /// Writes the exact values at all labels. Returns false if they are not defined.
    fn exact_at_all(self, truth: &dyn Truth, samples: &Samples, t: f64, into: &mut [f64]) -> bool {
        let (d, declaration) = (samples.dimension, self.declaration());
        if let Some(exact_at_all) = declaration.exact_at_all {
            exact_at_all(truth, d, &samples.label, t, into);
            return true;
        }
        let mut places = samples.label.chunks(d).zip(into.chunks_mut(self.components(d)));
        places.all(|(label, into)| (declaration.exact)(truth, label, t, into))
    }

    /// Returns the largest magnitude of the exact values at `places` (m) and `times` (s). F is
    /// measured by its difference from the identity, and a temperature by its range. NaN if the
    /// quantity is not defined or zero everywhere.
    pub fn largest_exact(self, truth: &dyn Truth, places: &[Vec<f64>], times: &[f64]) -> f64 {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for place in places {
            for t in times {
                let Some(value) = self.magnitude(truth, place, *t) else { return f64::NAN };
                if !value.is_finite() {
                    return f64::NAN;
                }
                (low, high) = (low.min(value), high.max(value));
            }
        }
        let is_range = matches!(self.declaration().size, SolutionSize::Range);
        let size = if is_range { high - low } else { high };
        if size > 0.0 && size.is_finite() { size } else { f64::NAN }
    }

    /// Returns the magnitude at one point, or the value if the quantity is measured by its range.
    fn magnitude(self, truth: &dyn Truth, place: &[f64], t: f64) -> Option<f64> {
        let (d, declaration) = (place.len(), self.declaration());
        let mut exact = vec![0.0; self.components(d)];
        if !(declaration.exact)(truth, place, t, &mut exact) {
            return None;
        }
        match declaration.size {
            SolutionSize::Range => return exact.first().copied(),
            SolutionSize::FromIdentity => (0..d).for_each(|i| exact[i * d + i] -= 1.0),
            SolutionSize::Magnitude => {}
        }
        Some(exact.iter().fold(0.0, |all, x| libm::hypot(all, *x)))
    }

    /// Computes norms of `computed - exact` at the labels of `samples` at time `t`; all NaN if the
    /// solver or the exact solution does not define the quantity.
    pub fn errors(self, samples: &Samples, truth: &dyn Truth, t: f64) -> Norms {
        self.differences(samples, truth, t).map_or(Norms::NONE, |(components, error)| {
            let norms = Norms::of(&error, components, &samples.weight);
            norms.with_masses(&error, components, &samples.mass)
        })
    }

    /// Returns the number of components at each label, and `computed - exact` at the labels of
    /// `samples` at time `t`. `None` if the solver or the exact solution does not define the
    /// quantity.
    pub fn differences(
        self,
        samples: &Samples,
        truth: &dyn Truth,
        t: f64,
    ) -> Option<(usize, Vec<f64>)> {
        let components = self.components(samples.dimension);
        let computed = self.computed(samples);
        if components == 0 || computed.len() != components * samples.len() {
            return None;
        }
        let mut error = vec![0.0; computed.len()];
        if !self.exact_at_all(truth, samples, t, &mut error) {
            return None;
        }
        for (error, computed) in error.iter_mut().zip(computed.iter()) {
            *error = computed - *error;
        }
        Some((components, error))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use rstest::rstest;

    /// A plane body that moves along X under uniform shear stress, without exact F.
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

    /// Creates two labels whose errors are vectors of length 5 or tensors of norm 5.
    fn off_by_five() -> Samples {
        Samples {
            dimension: 2,
            label: vec![0.0, 0.0, 1.0, 0.0],
            displacement: vec![5.0, 4.0, 5.0, -4.0],
            velocity: vec![2.0, 5.0, -3.0, 0.0],
            weight: vec![1.0, 3.0],
            mass: Vec::new(),
            stress: vec![3.0, 7.0, 7.0, 4.0, 0.0, 10.0, 11.0, 0.0],
            stress_across: Vec::new(),
            deformation_gradient: vec![1.0; 8],
            temperature: vec![305.0, 295.0],
        }
    }

    #[test]
    fn every_component_counts() {
        use Quantity::{Displacement, Stress, Temperature, Velocity};
        for of in [Displacement, Velocity, Stress, Temperature] {
            let Norms { rms, l1, l2, linf, .. } = of.errors(&off_by_five(), &Sheared, 1.0);
            for norm in [rms, l1, l2, linf] {
                assert!((norm - 5.0).abs() < 5e-15, "{of:?}: {norm}");
            }
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
    fn incomparable_quantities_are_nan(#[case] samples: Samples, #[case] quantity: Quantity) {
        let norms = quantity.errors(&samples, &Sheared, 1.0);
        assert!(norms.rms.is_nan() && norms.linf.is_nan(), "{norms:?}");
    }

    /// Values by hand: p = -(sxx + syy + szz)/3, and q is the axial stress of uniaxial stress.
    #[rstest]
    #[case(2, &[-1.0, 7.0, 7.0, -2.0], &[-6.0], Quantity::MeanStress, 3.0)]
    #[case(2, &[-1.0, 0.0, 0.0, -1.0], &[-6.0], Quantity::DeviatoricStress, 5.0)]
    #[case(2, &[-1.0, 2.0, 2.0, -1.0], &[-1.0], Quantity::DeviatoricStress, libm::sqrt(12.0))]
    #[case(2, &[1.0, 2.0, 2.0, 3.0], &[4.0], Quantity::StressZz, 4.0)]
    #[case(2, &[1.0, 2.0, 2.0, 3.0], &[], Quantity::StressXy, 2.0)]
    #[case(2, &[1.0, 2.0, 2.0, 3.0], &[], Quantity::MeanStress, f64::NAN)]
    #[case(3, &[1.0, 4.0, 5.0, 4.0, 2.0, 6.0, 5.0, 6.0, 3.0], &[], Quantity::MeanStress, -2.0)]
    #[case(3, &[1.0, 4.0, 5.0, 4.0, 2.0, 6.0, 5.0, 6.0, 3.0], &[], Quantity::StressYz, 6.0)]
    #[case(3, &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -7.0], &[], Quantity::DeviatoricStress, 7.0)]
    #[case(1, &[-7.0], &[], Quantity::StressXx, -7.0)]
    #[case(1, &[-7.0], &[], Quantity::DeviatoricStress, f64::NAN)]
    fn functions_of_the_stress_are_those_in_space(
        #[case] dimension: usize,
        #[case] stress: &[f64],
        #[case] across: &[f64],
        #[case] of: Quantity,
        #[case] expected: f64,
    ) {
        let (stress, stress_across) = (stress.to_vec(), across.to_vec());
        let samples = Samples { dimension, stress, stress_across, ..Samples::default() };
        let [value] = of.computed(&samples)[..] else { panic!("one label") };
        assert!((value - expected).abs() < 1e-14 || (value.is_nan() && expected.is_nan()));
    }

    #[test]
    fn deformation_gradient_is_compared_with_the_exact_one() {
        let found = Quantity::DeformationGradient.errors(&off_by_five(), &Rod, 1.0);
        assert_relative_eq!(found.linf, 19.0_f64.sqrt(), max_relative = 1e-15);
    }

    /// A rod that is stretched and heated over time. The exact stress is not defined.
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
    fn undefined_size_is_nan(#[case] of: Quantity, #[case] until: f64) {
        assert!(of.largest_exact(&Rod, &[vec![1.0, 0.0]], &[0.0, until]).is_nan());
        assert!(of.largest_exact(&Rod, &[], &[until]).is_nan());
    }

    #[test]
    fn a_value_that_is_no_number_is_not_left_out() {
        let found = Quantity::Displacement.largest_exact(&Rod, &[vec![1.0, 0.0]], &[1.0, f64::NAN]);
        assert!(found.is_nan(), "{found}");
    }
}
