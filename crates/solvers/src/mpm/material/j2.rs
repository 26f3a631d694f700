//! J2 plasticity: von Mises yield surface with linear hardening.
//!
//! The material yields if `sqrt(3/2) |dev tau| > Y + H alpha`, with a radial return (de Souza Neto,
//! Peric & Owen 2008, chapters 7 and 14). [`plastic_flow`](super::plastic_flow) describes the
//! integration.

use super::contract::YieldFunction;
use super::plastic_flow::{
    ElastoPlastic, LogElasticity, MARGIN, PrincipalStrain, YieldSurface, length_squared,
    modulus_of_invariants,
};
use crate::mpm::foundation::algebra::{Matrix, Vector};

/// J2 elastoplasticity at finite strain with isotropic hardening.
pub type J2 = ElastoPlastic<VonMises>;

/// Von Mises yield surface with linear isotropic hardening.
#[derive(Debug, Clone, PartialEq)]
pub struct VonMises {
    elasticity: LogElasticity,
    yield_stress: f64,
    hardening: f64,
}

impl J2 {
    /// Creates the law from Young's modulus (Pa), Poisson's ratio, the yield stress in tension Y
    /// (Pa) and the hardening modulus H (Pa).
    pub fn new(young: f64, poisson: f64, yield_stress: f64, hardening: f64) -> Self {
        let elasticity = LogElasticity::new(young, poisson);
        Self::with_surface(VonMises { elasticity, yield_stress, hardening })
    }
}

impl VonMises {
    /// Returns the von Mises stress (Pa) from the squared length of the strain deviator.
    #[inline(always)]
    fn mises(&self, length_squared: f64) -> f64 {
        2.0 * self.elasticity.mu * 1.5_f64.sqrt() * length_squared.sqrt()
    }
}

impl YieldSurface for VonMises {
    fn elasticity(&self) -> &LogElasticity {
        &self.elasticity
    }

    fn yield_function(&self, stress: &Vector<3>) -> YieldFunction {
        let mises = 1.5_f64.sqrt() * stress.add_scalar(-stress.sum() / 3.0).norm();
        YieldFunction { value: mises - self.yield_stress, size: mises + self.yield_stress }
    }

    #[inline]
    fn return_from(&self, trial: &PrincipalStrain, flowed: f64) -> Option<(PrincipalStrain, f64)> {
        let mu = self.elasticity.mu;
        let mises = self.mises(trial.deviator.norm_squared());
        let excess = mises - (self.yield_stress + self.hardening * flowed);
        if !(excess > 0.0) {
            return None;
        }
        let flow = excess / (3.0 * mu + self.hardening);
        let deviator = trial.deviator * (1.0 - 3.0 * mu * flow / mises);
        Some((PrincipalStrain { deviator, ..*trial }, flow))
    }

    #[inline(always)]
    fn encloses(&self, _: f64, deviator: &Matrix<3>, flowed: f64) -> bool {
        let mises = self.mises(length_squared(deviator));
        mises <= (1.0 - MARGIN) * (self.yield_stress + self.hardening * flowed)
    }

    /// Returns the consistent tangent. On the yield surface, the stress deviator has the length
    /// `sqrt(2/3) (Y + H (alpha + flow))`. The slope of this length along the strain deviator is
    /// `2 mu H/(3 mu + H)`.
    fn modulus_of_return(&self, trial: &PrincipalStrain, flowed: f64) -> Option<Matrix<3>> {
        let (mu, hardening) = (self.elasticity.mu, self.hardening);
        let (_, flow) = self.return_from(trial, flowed)?;
        let size = trial.deviator.norm();
        let length = 2.0 * mu * size - 6.0_f64.sqrt() * mu * flow;
        let slope = trial.deviator * (2.0 * mu * hardening / (3.0 * mu + hardening) / size);
        let mean = Vector::from_element(self.elasticity.bulk);
        Some(modulus_of_invariants(trial, &mean, length, &slope))
    }
}

#[cfg(test)]
mod tests {
    use super::super::MaterialPlan;
    use super::super::linear_elastic::LinearElastic;
    use super::super::specimen::{SLOW, Specimen};
    use crate::mpm::foundation::algebra::Matrix;
    use approx::assert_relative_eq;
    use rstest::rstest;

    /// In uniaxial strain, the volume change is elastic, and the gap `tau_1 - tau_2` is the yield
    /// stress.
    #[rstest]
    fn unloading_is_elastic_until_yield_in_the_opposite_direction(
        #[values(0.0, 40.0)] hardening: f64,
    ) {
        pull::<1>(hardening);
        pull::<2>(hardening);
        pull::<3>(hardening);
    }

    fn pull<const D: usize>(hardening: f64) {
        let (young, poisson, strength) = (100.0, 0.3, 3.0);
        let plan = MaterialPlan::J2 { young, poisson, r#yield: strength, hardening };
        let LinearElastic { lambda, mu } = LinearElastic::new(young, poisson);
        let bulk = lambda + 2.0 / 3.0 * mu;
        let mut solid = Specimen::<D>::new(plan);
        let mut check = |eps: f64, step: f64, gap: f64| {
            let mut stretch = Matrix::identity();
            stretch[(0, 0)] = libm::exp(step);
            let sigma = solid.deform(&stretch, SLOW) * libm::exp(eps);
            assert_relative_eq!(sigma[(0, 0)], bulk * eps + 2.0 / 3.0 * gap, epsilon = 1e-11);
            if D > 1 {
                assert_relative_eq!(sigma[(0, 0)] - sigma[(D - 1, D - 1)], gap, epsilon = 1e-11);
            }
        };
        let (eps, back) = (0.16, 0.2);
        let flow = (2.0 * mu * eps - strength) / (3.0 * mu + hardening);
        let gap = strength + hardening * flow;
        check(eps, eps, gap);
        check(eps - 0.02, -0.02, gap - 2.0 * mu * 0.02);
        let more = (2.0 * mu * back - 2.0 * gap) / (3.0 * mu + hardening);
        check(eps - back, 0.02 - back, -(gap + hardening * more));
    }
}
