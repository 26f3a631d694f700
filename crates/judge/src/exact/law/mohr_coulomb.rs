//! Mohr-Coulomb plasticity in uniaxial strain under monotonic loading.
//!
//! The two lateral stresses are equal, so the state is on an edge of the yield surface, where two
//! planes flow with the same multiplier `g`. With `s = sin(phi)`, `t = sin(psi)` and Lame's first
//! parameter L, the yield condition is `(1 + s) tau_high - (1 - s) tau_low = 2 c cos(phi)`. Per
//! unit strain, the flow changes the axial stress by `-g (4 L t + 4 mu (1 + t))` if it is the
//! largest stress, and by `g (4 mu (1 - t) - 4 L t)` if it is the smallest. The lateral stresses
//! change by half of the shear part, with opposite sign.

use super::contract::Lame;
use super::uniaxial_flow::{UniaxialLaw, UniaxialPlasticity, UniaxialYield};

/// Mohr-Coulomb plasticity with Hencky elasticity in uniaxial strain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MohrCoulombLaw(UniaxialLaw);

impl MohrCoulombLaw {
    /// Creates the law from Young's modulus (Pa), Poisson's ratio, the angles of friction and
    /// dilation (degrees), and the cohesion (Pa).
    pub fn new(
        young: f64,
        poisson: f64,
        friction_angle: f64,
        dilation_angle: f64,
        cohesion: f64,
    ) -> Self {
        let lame = Lame::new(young, poisson);
        let (phi, psi) = (friction_angle.to_radians(), dilation_angle.to_radians());
        let (s, t) = (libm::sin(phi), libm::sin(psi));
        let Lame { lambda, mu } = lame;
        let compression = UniaxialYield {
            weights: [-(1.0 - s), 1.0 + s],
            relief: [
                4.0 * lambda * t - 4.0 * mu * (1.0 - t),
                4.0 * lambda * t + 2.0 * mu * (1.0 + t),
            ],
            strength: 2.0 * cohesion * libm::cos(phi),
            hardening: 0.0,
        };
        let extension = UniaxialYield {
            weights: [1.0 + s, -(1.0 - s)],
            relief: [
                4.0 * lambda * t + 4.0 * mu * (1.0 + t),
                4.0 * lambda * t - 2.0 * mu * (1.0 - t),
            ],
            ..compression
        };
        Self(UniaxialLaw { lame, limits: [compression, extension] })
    }
}

impl UniaxialPlasticity for MohrCoulombLaw {
    const MATERIAL: &'static str = "mohr_coulomb";
    const TEXT: &'static str = "Mohr-Coulomb in monotonic uniaxial strain, \
                                rho0 u_tt = Div P + rho0 b, P = tau F^-T, \
                                tau = lambda tr(eps_e) I + 2 mu eps_e, \
                                (tau1 - tau3) + (tau1 + tau3) sin(phi) <= 2 c cos(phi) for the \
                                largest and smallest principal values tau1 and tau3 of tau";

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

    /// Compares with values of an independent program for K = 1e4 Pa, mu = 7.5e3 Pa, c = 10 Pa.
    #[rstest]
    #[case::compression([30.0, 10.0], -0.01, -196.127_569_232)]
    #[case::large([30.0, 10.0], -0.03, -570.914_763_447)]
    #[case::extension([30.0, 10.0], 0.001, 13.698_188_095)]
    #[case::apex([30.0, 10.0], 0.003, 17.320_508_076)]
    #[case::without_dilation([20.0, 0.0], -0.01, -165.612_145_902)]
    #[case::extension_without_dilation([20.0, 0.0], 0.001, 17.153_427_590)]
    #[case::tresca([0.0, 0.0], -0.01, -113.333_333_333)]
    fn stress_in_uniaxial_strain_matches_an_independent_program(
        #[case] angles: [f64; 2],
        #[case] strain: f64,
        #[case] tau: f64,
    ) {
        let law = MohrCoulombLaw::new(18e3, 0.2, angles[0], angles[1], 10.0);
        let [[piola]] = law.piola(&[[libm::expm1(strain)]]);
        assert_relative_eq!(piola * libm::exp(strain), tau, max_relative = 1e-10);
        assert!(law.flows(libm::expm1(strain), &[[0.0; 3]; 3]));
    }

    #[test]
    fn a_large_friction_angle_is_elastic_in_compression() {
        // The body never yields in compression: the elastic ratio of lateral to axial stress, nu/(1
        // - nu) = 1/4, is above the ratio at yield, (1 - s)/(1 + s) = 0.17.
        let law = MohrCoulombLaw::new(18e3, 0.2, 45.0, 0.0, 10.0);
        let flows = |grad| law.flows(grad, &[[0.0; 3]; 3]);
        assert!(!flows(-0.5) && flows(0.5));
    }
}
