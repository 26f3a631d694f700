//! Drucker-Prager plasticity in uniaxial strain under monotonic loading.
//!
//! With the axial and the lateral stress a and l, and `s = -1` where a is the smallest stress,
//! `s = 1` where it is the largest, the yield condition is
//!
//! ```text
//! s (a - l)/sqrt(3) + eta (a + 2 l)/3 <= k
//! ```
//!
//! With `A = 2 mu/sqrt(3)`, a unit of flow reduces a by `K etab + s A` and l by `K etab - s A/2`.
//! The left side decreases by `D = mu + K eta etab`, so after yield, with `M = lambda + 2 mu`,
//! `d a/de = M - (K eta + s A)(K etab + s A)/D`.

use super::contract::Lame;
use super::uniaxial_flow::{UniaxialLaw, UniaxialPlasticity, UniaxialYield};

/// Drucker-Prager plasticity with Hencky elasticity in uniaxial strain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DruckerPragerLaw(UniaxialLaw);

impl DruckerPragerLaw {
    /// Creates the law from Young's modulus (Pa), Poisson's ratio, the coefficients of friction eta
    /// and of dilation etab, and the strength k (Pa).
    pub fn new(young: f64, poisson: f64, friction: f64, dilation: f64, strength: f64) -> Self {
        let lame = Lame::new(young, poisson);
        let bulk = lame.lambda + 2.0 / 3.0 * lame.mu;
        let shear = 2.0 / libm::sqrt(3.0) * lame.mu;
        let limit = |sign: f64| UniaxialYield {
            weights: [
                sign / libm::sqrt(3.0) + friction / 3.0,
                2.0 / 3.0 * friction - sign / libm::sqrt(3.0),
            ],
            relief: [bulk * dilation + sign * shear, bulk * dilation - 0.5 * sign * shear],
            strength,
            hardening: 0.0,
        };
        Self(UniaxialLaw { lame, limits: [limit(-1.0), limit(1.0)] })
    }
}

impl UniaxialPlasticity for DruckerPragerLaw {
    const MATERIAL: &'static str = "drucker_prager";
    const TEXT: &'static str = "Drucker-Prager in monotonic uniaxial strain, \
                                rho0 u_tt = Div P + rho0 b, P = tau F^-T, \
                                tau = lambda tr(eps_e) I + 2 mu eps_e, \
                                sqrt(J2) + eta p <= k for p = tr(tau)/3 and \
                                J2 = dev(tau) : dev(tau)/2";

    fn response(&self) -> &UniaxialLaw {
        &self.0
    }
}

#[cfg(test)]
mod tests {
    use super::super::contract::ConstitutiveLaw;
    use super::*;
    use approx::assert_relative_eq;
    use rstest::rstest;

    /// Compares with values from an independent program for K = 1e4 Pa and mu = 6e3 Pa.
    #[rstest]
    #[case::elastic(-0.002, -36.0)]
    #[case::compression(-0.01, -152.446_057_383_1)]
    #[case::large(-0.05, -724.590_901_326_6)]
    #[case::extension(0.0012, 19.191_532_825_0)]
    #[case::apex(0.005, 100.0 / 3.0)]
    fn stress_in_uniaxial_strain_matches_an_independent_program(
        #[case] strain: f64,
        #[case] tau: f64,
    ) {
        let law = DruckerPragerLaw::new(15e3, 0.25, 0.3, 0.1, 10.0);
        let [[piola]] = law.piola(&[[libm::expm1(strain)]]);
        assert_relative_eq!(piola * libm::exp(strain), tau, max_relative = 1e-10);
        assert_eq!(law.flows(libm::expm1(strain), &[[0.0; 3]; 3]), strain != -0.002);
    }

    #[test]
    fn a_steep_cone_is_elastic_in_compression() {
        let law = DruckerPragerLaw::new(15e3, 0.25, 0.7, 0.1, 10.0);
        let flows = |grad| law.flows(grad, &[[0.0; 3]; 3]);
        assert!(!flows(-0.5) && flows(0.5));
    }
}
