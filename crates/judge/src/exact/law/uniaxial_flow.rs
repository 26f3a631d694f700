//! Plastic flow in uniaxial strain under monotonic loading.
//!
//! The elasticity and the hardening are linear in the logarithmic strain `e` of the driven axis.
//! The lateral stresses are equal, so a yield surface of planes or a cone is two straight lines in
//! the plane of axial and lateral Kirchhoff stress. The stresses are piecewise linear in `e`:
//! elastic up to the first line, then along this line, and constant at an apex.
//!
//! A body with an initial stress starts at this stress instead of zero.
//!
//! The driven axis is that of the only non-zero component of the displacement gradient.

use super::contract::{ConstitutiveLaw, Lame};
use crate::exact::formula::Number;
use crate::exact::tensor::{Tensor, tensor};

/// A plasticity law that is implemented for uniaxial strain only.
pub(super) trait UniaxialPlasticity {
    const MATERIAL: &'static str;

    const TEXT: &'static str;

    fn response(&self) -> &UniaxialLaw;
}

impl<L: UniaxialPlasticity> ConstitutiveLaw for L {
    const NAME: &'static str = L::MATERIAL;
    const EQUATION: &'static str = L::TEXT;
    const HAS_HISTORY: bool = true;

    fn piola<T: Number, const D: usize>(&self, grad: &Tensor<T, D>) -> Tensor<T, D> {
        uniaxial_piola(grad, |strain, _| self.response().kirchhoff(strain, [T::from(0.0); 2]))
    }

    fn modulus(&self) -> f64 {
        self.response().lame.modulus()
    }

    fn piola_from<T: Number>(&self, grad: &Tensor<T>, initial: &Tensor<T>) -> Option<Tensor<T>> {
        Some(self.response().piola_from(grad, initial))
    }

    fn flows(&self, grad: f64, initial: &Tensor<f64>) -> bool {
        self.response().flows(grad, initial)
    }
}

/// Returns the axis of the only non-zero component of `grad` (0 for none), if on the diagonal.
pub(in crate::exact) fn strained_axis<T: Number, const D: usize>(
    grad: &Tensor<T, D>,
) -> Option<usize> {
    let is_zero = |i: usize, j: usize| grad[i][j] == T::from(0.0);
    let axis = (0..D).find(|i| !is_zero(*i, *i)).unwrap_or(0);
    let mut others = (0..D * D).map(|k| (k / D, k % D)).filter(|at| *at != (axis, axis));
    others.all(|(i, j)| is_zero(i, j)).then_some(axis)
}

/// Computes P (Pa) in uniaxial strain, where `kirchhoff` returns the axial and the lateral
/// Kirchhoff stress (Pa) at a logarithmic strain along an axis. NaN for any other deformation.
pub(super) fn uniaxial_piola<T: Number, const D: usize>(
    grad: &Tensor<T, D>,
    kirchhoff: impl FnOnce(T, usize) -> [T; 2],
) -> Tensor<T, D> {
    let Some(axis) = strained_axis(grad) else { return tensor(|_, _| T::from(f64::NAN)) };
    let stretch = T::from(1.0) + grad[axis][axis];
    let [axial, lateral] = kirchhoff(Number::ln(stretch), axis);
    tensor(|i, j| match (i == j, i == axis) {
        (true, true) => axial / stretch,
        (true, false) => lateral,
        (false, _) => T::from(0.0),
    })
}

/// A yield condition `weights . (axial, lateral) <= strength` on the Kirchhoff stresses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct UniaxialYield {
    pub(super) weights: [f64; 2],
    /// Decrease of the axial and the lateral stress per unit of flow (Pa).
    pub(super) relief: [f64; 2],
    /// Strength without flow (Pa).
    pub(super) strength: f64,
    /// Increase of the strength per unit of flow (Pa).
    pub(super) hardening: f64,
}

impl UniaxialYield {
    fn dot<T: Number>(&self, [axial, lateral]: [T; 2]) -> T {
        T::from(self.weights[0]) * axial + T::from(self.weights[1]) * lateral
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct UniaxialLaw {
    pub(super) lame: Lame,
    pub(super) limits: [UniaxialYield; 2],
}

impl UniaxialLaw {
    /// Returns the slopes of axial and lateral stress (Pa); `sign` is -1 in compression, else 1.
    fn rates(&self, sign: f64) -> [f64; 2] {
        [sign * self.lame.modulus(), sign * self.lame.lambda]
    }

    /// Returns the yield condition that a path from `start` (Pa) reaches first, and the magnitude
    /// of the strain at yield.
    fn first_yield<T: Number>(&self, sign: f64, start: [T; 2]) -> Option<(&UniaxialYield, T)> {
        let reached = self.limits.iter().filter_map(|limit| {
            let towards = limit.dot(self.rates(sign));
            let distance = (T::from(limit.strength) - limit.dot(start)) / T::from(towards);
            (towards > 0.0).then_some((limit, distance))
        });
        reached.min_by(|(_, a), (_, b)| a.value().total_cmp(&b.value()))
    }

    /// Computes the axial and lateral Kirchhoff stress (Pa) at the `strain`, from `start` (Pa).
    fn kirchhoff<T: Number>(&self, strain: T, start: [T; 2]) -> [T; 2] {
        let sign = if strain.value() < 0.0 { -1.0 } else { 1.0 };
        let (size, rates) = (T::from(sign) * strain, self.rates(sign));
        let moduli = [self.lame.modulus(), self.lame.lambda];
        let elastic = std::array::from_fn(|i| start[i] + T::from(moduli[i]) * strain);
        let Some((limit, at_yield)) = self.first_yield(sign, start) else { return elastic };
        let beyond = size - at_yield;
        if !(beyond.value() > 0.0) {
            return elastic;
        }
        let flow = limit.dot(rates) / (limit.dot(limit.relief) + limit.hardening);
        let slopes: [f64; 2] = std::array::from_fn(|i| rates[i] - flow * limit.relief[i]);
        let stress: [T; 2] = std::array::from_fn(|i| start[i] + T::from(rates[i]) * at_yield);
        let (gap, closing) = (stress[0] - stress[1], slopes[1] - slopes[0]);
        let to_apex = gap / T::from(closing);
        let closes = limit.hardening == 0.0 && to_apex.value() > 0.0;
        let after = |flow: T| std::array::from_fn(|i| stress[i] + T::from(slopes[i]) * flow);
        if !(closes && beyond.value() > to_apex.value()) {
            return after(beyond);
        }
        // A path that could leave the apex again is not implemented: NaN makes the check fail.
        let stays = sign * gap.value() > 0.0;
        if stays { after(to_apex) } else { [T::from(f64::NAN); 2] }
    }

    pub(super) fn piola_from<T: Number>(&self, grad: &Tensor<T>, initial: &Tensor<T>) -> Tensor<T> {
        uniaxial_piola(grad, |strain, axis| {
            self.kirchhoff(strain, [initial[axis][axis], initial[(axis + 1) % 3][(axis + 1) % 3]])
        })
    }

    pub(super) fn flows(&self, grad: f64, initial: &Tensor<f64>) -> bool {
        let strain = libm::log1p(grad);
        let reached = self.first_yield(strain.signum(), [initial[0][0], initial[1][1]]);
        reached.is_some_and(|(_, at_yield)| strain.abs() > at_yield)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::law::{DruckerPragerLaw, J2Law, MohrCoulombLaw};
    use approx::assert_relative_eq;
    use rstest::rstest;

    fn drucker_prager() -> DruckerPragerLaw {
        DruckerPragerLaw::new(15e3, 0.25, 0.3, 0.1, 10.0)
    }

    fn mohr_coulomb() -> MohrCoulombLaw {
        MohrCoulombLaw::new(18e3, 0.2, 30.0, 10.0, 10.0)
    }

    /// Returns the axial Kirchhoff stress (Pa) at the `strain` from `start`, and whether it yields.
    fn stress(law: &impl ConstitutiveLaw, strain: f64, [axial, lateral]: [f64; 2]) -> (f64, bool) {
        let (mut grad, mut initial) = ([[0.0; 3]; 3], [[0.0; 3]; 3]);
        grad[0][0] = libm::expm1(strain);
        (initial[0][0], initial[1][1], initial[2][2]) = (axial, lateral, lateral);
        let piola = law.piola_from(&grad, &initial).expect("a law with a yield surface");
        (piola[0][0] * libm::exp(strain), law.flows(grad[0][0], &initial))
    }

    /// The axial stress is the same along every axis, and undefined for other deformations.
    #[rstest]
    fn uniaxial_strain_has_the_same_stress_along_every_axis(
        #[values(-0.03, -1e-4, 0.0012, 0.003)] grad: f64,
        #[values(0, 1, 2)] axis: usize,
    ) {
        let law = mohr_coulomb();
        let [[along]] = law.piola(&[[grad]]);
        let mut tensor = [[0.0; 3]; 3];
        tensor[axis][axis] = grad;
        let piola = law.piola(&tensor);
        let (tau, lateral) = (along * (1.0 + grad), piola[(axis + 1) % 3][(axis + 1) % 3]);
        assert_eq!((piola[axis][axis], lateral), (along, piola[(axis + 2) % 3][(axis + 2) % 3]));
        let limit = usize::from(grad >= 0.0);
        let excess = law.response().limits[limit].dot([tau, lateral]) - 20.0 * libm::sqrt(0.75);
        let elastic = 5e3 * libm::log1p(grad);
        assert!(excess.abs() < 1e-9 || (excess < 0.0 && (lateral - elastic).abs() < 1e-12));
        tensor[(axis + 1) % 3][axis] = 1e-12;
        assert!(law.piola(&tensor)[axis][axis].is_nan());
    }

    /// A start at the stress of an elastic strain continues the path from zero stress.
    #[rstest]
    fn elastic_start_continues_the_path(
        #[values(-0.03, -0.01, 1e-4, 0.0012, 0.003)] strain: f64,
        #[values(0.0, 0.25, 0.9)] share: f64,
    ) {
        fn hold(law: &impl ConstitutiveLaw, lame: Lame, strain: f64, first: f64) {
            let start = [lame.modulus() * first, lame.lambda * first];
            let (tau, _) = stress(law, strain - first, start);
            let [[piola]] = law.piola(&[[libm::expm1(strain)]]);
            assert_relative_eq!(tau, piola * libm::exp(strain), max_relative = 1e-10);
        }
        // All laws are elastic up to this strain.
        let first = share * strain.clamp(-1.3e-3, 6e-4);
        hold(&drucker_prager(), Lame::new(15e3, 0.25), strain, first);
        hold(&mohr_coulomb(), Lame::new(18e3, 0.2), strain, first);
        hold(&J2Law::new(18e3, 0.2, 20.0, 500.0), Lame::new(18e3, 0.2), strain, first);
    }

    /// Compression from K0 states against closed forms of the yield strain and the later slope.
    #[test]
    fn compression_from_a_lateral_stress_yields_at_the_closed_form() {
        let (start, s) = ([-40.0, -20.0], 0.5);
        // K = 1e4, mu = 7.5e3, lambda = 5000, M = 20000; angles 30 and 10 degrees.
        let at_yield = (20.0 * libm::cos(core::f64::consts::PI / 6.0) - (1.0 - s) * 40.0
            + (1.0 + s) * 20.0)
            / ((1.0 - s) * 20e3 - (1.0 + s) * 5e3);
        let law = mohr_coulomb();
        let (tau, flows) = stress(&law, -0.999 * at_yield, start);
        assert_relative_eq!(tau, -40.0 - 20e3 * 0.999 * at_yield, max_relative = 1e-10);
        assert!(!flows);
        let (tau, flows) = stress(&law, -at_yield - 0.01, start);
        let expected = -40.0 - 20e3 * at_yield - 18_739.359_711 * 0.01;
        assert_relative_eq!(tau, expected, max_relative = 1e-10);
        assert!(flows);
        // K = 1e4, mu = 6e3: (l - a)/sqrt(3) + eta (a + 2 l)/3 = k.
        let towards = 2.0 * 6e3 / 3.0_f64.sqrt() - 0.3 * 1e4;
        let at_yield = (10.0 - 20.0 / 3.0_f64.sqrt() + 0.3 * 80.0 / 3.0) / towards;
        let (tau, flows) = stress(&drucker_prager(), -at_yield - 0.01, start);
        let expected = -40.0 - 18e3 * at_yield - 14_303.621_098_588 * 0.01;
        assert_relative_eq!(tau, expected, max_relative = 1e-10);
        assert!(flows);
    }

    /// From 40 Pa in compression, extension first removes the stress difference.
    #[test]
    fn extension_yields_on_the_other_side() {
        let law = J2Law::new(18e3, 0.2, 20.0, 0.0);
        let (lateral, at_yield) = (-25.0, (20.0 + 15.0) / 15e3);
        assert!(!stress(&law, 0.999 * at_yield, [-40.0, lateral]).1);
        // After yield, d tau/de = K.
        let (tau, flows) = stress(&law, at_yield + 0.01, [-40.0, lateral]);
        assert_relative_eq!(tau, -40.0 + 20e3 * at_yield + 1e4 * 0.01, max_relative = 1e-10);
        assert!(flows);
    }
}
