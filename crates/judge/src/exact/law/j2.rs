//! J2 plasticity with linear hardening under monotonic loading.
//!
//! While the logarithmic strain `eps` grows along one direction, the stress is a function of it
//! (Hencky 1924): `tau = K tr(eps) I + s dev(eps)`, with `s = 2 mu` up to `q = sqrt(3/2) |2 mu
//! dev(eps)| = Y`, and `q = Y + H alpha` and `3 mu alpha = q_elastic - q` after yield. The law is
//! used in uniaxial strain; `monotone_loading` checks that the loading never reverses.

use super::contract::{ConstitutiveLaw, Lame};
use super::uniaxial_flow::{UniaxialLaw, UniaxialYield};
use crate::exact::formula::Number;
use crate::exact::tensor::{Tensor, deformation, log_strain, product, sum, tensor, unit};

/// J2 plasticity with Hencky elasticity in uniaxial strain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct J2Law {
    lame: Lame,
    yield_stress: f64,
    hardening: f64,
}

impl J2Law {
    /// Creates the law from Young's modulus (Pa), Poisson's ratio, the yield stress in tension (Pa)
    /// and the hardening modulus (Pa).
    pub fn new(young: f64, poisson: f64, yield_stress: f64, hardening: f64) -> Self {
        Self { lame: Lame::new(young, poisson), yield_stress, hardening }
    }

    /// Returns the law in uniaxial strain, where `q = |axial - lateral|`. A unit of flow reduces
    /// the axial stress by 2 mu and the lateral stress by -mu if the axial stress is the largest.
    fn uniaxial(&self) -> UniaxialLaw {
        let Self { lame, yield_stress: strength, hardening } = *self;
        let limit = |sign: f64| UniaxialYield {
            weights: [sign, -sign],
            relief: [2.0 * sign * lame.mu, -sign * lame.mu],
            strength,
            hardening,
        };
        UniaxialLaw { lame, limits: [limit(-1.0), limit(1.0)] }
    }
}

impl ConstitutiveLaw for J2Law {
    const NAME: &'static str = "j2";
    const EQUATION: &'static str = "J2 under monotonic loading, rho0 u_tt = Div P + rho0 b, \
                                    P = tau F^-T, tau = K tr(eps) I + s dev(eps) with the secant \
                                    modulus s, eps = ln(F F^T)/2";
    const HAS_HISTORY: bool = true;

    fn piola<T: Number, const D: usize>(&self, grad: &Tensor<T, D>) -> Tensor<T, D> {
        let (f, cofactor, det) = deformation(grad);
        let tau = kirchhoff(&log_strain(&f), Number::ln(det), self);
        product(&tau, &tensor(|i, j| cofactor[i][j] / det))
    }

    fn modulus(&self) -> f64 {
        self.lame.modulus()
    }

    fn piola_from<T: Number>(&self, grad: &Tensor<T>, initial: &Tensor<T>) -> Option<Tensor<T>> {
        Some(self.uniaxial().piola_from(grad, initial))
    }

    fn flows(&self, grad: f64, initial: &Tensor<f64>) -> bool {
        self.uniaxial().flows(grad, initial)
    }
}

/// Computes the Kirchhoff stress (Pa) for the logarithmic strain `strain`, whose trace is `trace`.
fn kirchhoff<T: Number, const D: usize>(
    strain: &Tensor<T, D>,
    trace: T,
    law: &J2Law,
) -> Tensor<T, D> {
    let J2Law { lame: Lame { lambda, mu }, yield_stress, hardening } = *law;
    let third = trace * T::from(1.0 / 3.0);
    let deviator: Tensor<T, D> = tensor(|i, j| strain[i][j] - third * unit(i, j));
    let bulk = T::from(3.0 * lambda + 2.0 * mu);
    let elastic = mises(&deviator, third, mu);
    let shear = if elastic.value() > yield_stress {
        let flow = (elastic - T::from(yield_stress)) / T::from(3.0 * mu + hardening);
        T::from(2.0 * mu) * (T::from(1.0) - T::from(3.0 * mu) * flow / elastic)
    } else {
        T::from(2.0 * mu)
    };
    tensor(|i, j| bulk * third * unit(i, j) + shear * deviator[i][j])
}

/// Computes `sqrt(3/2) |2 mu dev(eps)|`; the deviator along the missing axes is `-third`.
fn mises<T: Number, const D: usize>(deviator: &Tensor<T, D>, third: T, mu: f64) -> T {
    let inside = sum::<T, D>(|i| sum::<T, D>(|j| deviator[i][j] * deviator[i][j]));
    let square = inside + third * third * T::from((3 - D) as f64);
    // The root has no derivative at zero strain, where there is no flow.
    if square.value() == 0.0 { square } else { Number::sqrt(square * T::from(6.0 * mu * mu)) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use rstest::rstest;

    /// `tau = K eps -+ 2/3 (Y + H alpha)` with `alpha = (2 mu |eps| - Y)/(3 mu + H)`.
    #[rstest]
    fn beyond_yield_the_stress_is_that_of_the_hardened_yield_stress(
        #[values(-0.2, -0.02, -0.001, 0.001, 0.02, 0.2)] strain: f64,
    ) {
        let law = J2Law::new(200.0, 0.25, 1.0, 30.0);
        let Lame { lambda, mu } = law.lame;
        let elastic = 2.0 * mu * strain.abs();
        let alpha = ((elastic - 1.0) / (3.0 * mu + 30.0)).max(0.0);
        let q = if alpha > 0.0 { 1.0 + 30.0 * alpha } else { elastic };
        assert_eq!(alpha > 0.0, law.flows(libm::expm1(strain), &[[0.0; 3]; 3]));
        let tau = (lambda + 2.0 / 3.0 * mu) * strain + 2.0 / 3.0 * q * strain.signum();
        let [[piola]] = law.piola(&[[libm::expm1(strain)]]);
        assert_relative_eq!(piola, tau / libm::exp(strain), max_relative = 1e-12);
    }
}
