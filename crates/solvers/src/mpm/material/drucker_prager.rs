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
}
