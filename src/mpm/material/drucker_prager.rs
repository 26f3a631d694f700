//! Drucker-Prager plasticity: a cone about the axis of mean stress.
//!
//! The material yields if `sqrt(J2) + eta p > k`, with `p = tr(tau)/3` positive in tension and
//! `J2 = dev(tau) : dev(tau)/2`. The flow rule uses the coefficient of dilation `etab` instead of
//! `eta`. The return goes to the cone, or to its apex `p = k/eta` (de Souza Neto, Peric & Owen
//! 2008, section 8.3). [`plastic_flow`](super::plastic_flow) integrates the law.
//!
//! Without dilation, plastic flow does not change the mean stress. A return from a mean stress
//! above the apex is then a tension cut-off that is not part of the flow rule.

use super::contract::{Contradiction, YieldFunction};
use super::plastic_flow::{
    ElastoPlastic, LogElasticity, MARGIN, PrincipalStrain, YieldSurface, length_squared,
    modulus_of_invariants,
};
use crate::mpm::foundation::algebra::{Matrix, Vector, zeros};

/// Drucker-Prager elastoplasticity at finite strain, without hardening.
pub type DruckerPrager = ElastoPlastic<Cone>;

/// The cone of Drucker and Prager.
#[derive(Debug, Clone, PartialEq)]
pub struct Cone {
    elasticity: LogElasticity,
    friction: f64,
    dilation: f64,
    strength: f64,
}

impl DruckerPrager {
    /// Creates the law from Young's modulus (Pa), Poisson's ratio, the coefficients of friction eta
    /// and of dilation etab, and the strength k (Pa): sqrt(J2) at yield without mean stress.
    pub fn new(young: f64, poisson: f64, friction: f64, dilation: f64, strength: f64) -> Self {
        let elasticity = LogElasticity::new(young, poisson);
        Self::with_surface(Cone { elasticity, friction, dilation, strength })
    }
}

impl Cone {
    /// Returns `sqrt(J2)` and the yield function (Pa), from the mean strain and the squared length
    /// of the strain deviator.
    #[inline(always)]
    fn excess(&self, mean: f64, length_squared: f64) -> (f64, f64) {
        let Self { elasticity: LogElasticity { bulk, mu, .. }, friction, strength, .. } = *self;
        let shear = 2.0_f64.sqrt() * mu * length_squared.sqrt();
        (shear, shear + friction * 3.0 * bulk * mean - strength)
    }
}

impl YieldSurface for Cone {
    fn elasticity(&self) -> &LogElasticity {
        &self.elasticity
    }

    fn contradiction(&self) -> Option<Contradiction> {
        (self.dilation > self.friction).then_some(Contradiction {
            key: "dilation",
            reason: "the coefficient of dilation is above that of friction",
            explanation: "a flow that dilates more than friction allows does negative work",
        })
    }

    fn yield_function(&self, stress: &Vector<3>) -> YieldFunction {
        let mean = stress.sum() / 3.0;
        let shear = stress.add_scalar(-mean).norm() / 2.0_f64.sqrt();
        let friction = self.friction * mean;
        YieldFunction {
            value: shear + friction - self.strength,
            size: shear + friction.abs() + self.strength,
        }
    }

    #[inline]
    fn return_from(&self, trial: &PrincipalStrain, _: f64) -> Option<(PrincipalStrain, f64)> {
        let Self { elasticity: LogElasticity { bulk, mu, .. }, friction, dilation, strength } =
            *self;
        let (shear, excess) = self.excess(trial.mean, trial.deviator.norm_squared());
        if !(excess > 0.0) {
            return None;
        }
        let flow = excess / (mu + bulk * friction * dilation);
        let after = if mu * flow <= shear {
            PrincipalStrain {
                mean: trial.mean - dilation * flow / 3.0,
                deviator: trial.deviator * (1.0 - mu * flow / shear),
            }
        } else {
            // Here `friction` is above zero, because a cone without friction has no apex.
            PrincipalStrain { mean: strength / (3.0 * bulk * friction), deviator: zeros() }
        };
        Some((after, trial.distance(&after)))
    }

    #[inline(always)]
    fn encloses(&self, mean: f64, deviator: &Matrix<3>, _: f64) -> bool {
        let (shear, excess) = self.excess(mean, length_squared(deviator));
        excess <= -MARGIN * (shear + self.strength)
    }

    /// Returns the consistent tangent. A trial strain increment deps causes
    /// `dp = K (tr deps - etab dg)` and `d sqrt(J2) = mu (sqrt(2) n : deps - dg)`, with the flow
    /// `g = (sqrt(J2) + eta p - k)/(mu + K eta etab)` and the direction n of the deviator (de Souza
    /// Neto et al. 2008, section 8.3).
    fn modulus_of_return(&self, trial: &PrincipalStrain, flowed: f64) -> Option<Matrix<3>> {
        let Self { elasticity: LogElasticity { bulk, mu, .. }, friction, dilation, .. } = *self;
        let (after, _) = self.return_from(trial, flowed)?;
        let (size, length) = (trial.deviator.norm(), 2.0 * mu * after.deviator.norm());
        if length == 0.0 {
            // At the apex, the stress does not depend on the strain.
            return Some(zeros());
        }
        let one = Vector::<3>::from_element(1.0);
        let shear_slope = trial.deviator * (2.0_f64.sqrt() * mu / size);
        let flow_slope =
            (shear_slope + one * (friction * bulk)) / (mu + bulk * friction * dilation);
        let mean_slope = one * bulk - flow_slope * (bulk * dilation);
        let length_slope = (shear_slope - flow_slope * mu) * 2.0_f64.sqrt();
        Some(modulus_of_invariants(trial, &mean_slope, length, &length_slope))
    }

    /// Returns stresses whose invariants `p` and `sqrt(J2)` are linear in the strain (de Souza Neto
    /// et al. 2008, eq. 8.113).
    #[cfg(test)]
    fn isochoric(&self, e: f64) -> [f64; 2] {
        let Self { elasticity: LogElasticity { bulk, mu, .. }, friction, dilation, strength } =
            *self;
        let stiffness = mu + bulk * friction * dilation;
        let beyond = e - strength / (2.0 * mu);
        let mean = -2.0 * mu * bulk * dilation / stiffness * beyond;
        let shear = strength + 2.0 * mu * bulk * friction * dilation / stiffness * beyond;
        [mean + shear, mean - shear]
    }
}

#[cfg(test)]
mod tests {
    use super::super::MaterialPlan;
    use super::super::specimen::{isotropic, principal};
    use rstest::rstest;

    /// The expected principal Kirchhoff stresses at the end of each path are closed forms, computed
    /// by an independent program.
    #[rstest]
    #[case::elastic(&[[-0.002, 0.0, 0.0]], [-36.0, -12.0, -12.0])]
    #[case::compression(&[[-0.01, 0.0, 0.0]], [-152.446_057_383_1, -80.748_883_761_5, -80.748_883_761_5])]
    #[case::in_two_steps(
        &[[-0.007, 0.0, 0.0], [-0.02, 0.0, 0.0]],
        [-295.482_268_369_0, -168.583_643_102_5, -168.583_643_102_5]
    )]
    #[case::unloading(
        &[[-0.02, 0.0, 0.0], [-0.017, 0.0, 0.0]],
        [-241.482_268_369_0, -150.583_643_102_5, -150.583_643_102_5]
    )]
    #[case::further(
        &[[-0.02, 0.0, 0.0], [-0.017, 0.0, 0.0], [-0.01, 0.0, 0.0]],
        [-115.482_268_369_0, -108.583_643_102_5, -108.583_643_102_5]
    )]
    #[case::large(&[[-0.05, 0.0, 0.0]], [-724.590_901_326_6, -432.087_921_125_7, -432.087_921_125_7])]
    #[case::extension(&[[0.0012, 0.0, 0.0]], [19.191_532_825_0, 7.948_556_474_1, 7.948_556_474_1])]
    #[case::apex(&[[0.005, 0.0, 0.0]], [100.0 / 3.0; 3])]
    #[case::apex_in_steps(&[[0.0012, 0.0, 0.0], [0.003, 0.0, 0.0], [0.005, 0.0, 0.0]], [100.0 / 3.0; 3])]
    #[case::isochoric(&[[0.01, -0.01, 0.0]], [-2.222_222_222_2, -32.698_412_698_4, -17.460_317_460_3])]
    #[case::isochoric_in_steps(
        &[[0.004, -0.004, 0.0], [0.01, -0.01, 0.0], [0.03, -0.03, 0.0]],
        [-28.888_888_888_9, -82.222_222_222_2, -55.555_555_555_6]
    )]
    fn stress_at_the_end_of_a_path_matches_the_closed_form(
        #[case] path: &[[f64; 3]],
        #[case] expected: [f64; 3],
    ) {
        let (young, poisson) = isotropic(1e4, 6e3);
        let plan = MaterialPlan::DruckerPrager {
            young,
            poisson,
            friction: 0.3,
            dilation: 0.1,
            strength: 10.0,
        };
        principal(plan, path, expected);
    }
}
