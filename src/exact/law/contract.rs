//! Interface of the constitutive laws of exact solutions.

use crate::exact::formula::Number;
use crate::exact::tensor::Tensor;

/// A law between the displacement gradient and the first Piola-Kirchhoff stress, written over any
/// [`Number`]: over slopes, the divergence of P follows by automatic differentiation.
pub(super) trait ConstitutiveLaw {
    /// Name of its equation of motion in suites.
    const NAME: &'static str;

    /// Its equation of motion, as reports write it.
    const EQUATION: &'static str;

    /// Whether stress depends on the history of the motion, unless loading never reverses.
    const HAS_HISTORY: bool = false;

    /// P (Pa) for the displacement gradient `grad[i][j] = du_i/dX_j`, at unit reference density if
    /// the law depends on it.
    fn piola<T: Number, const D: usize>(&self, grad: &Tensor<T, D>) -> Tensor<T, D>;

    /// The energy W (J/m3) with `P = dW/dF`, zero at rest or, in a gas, in the limit of infinite
    /// expansion; `None` for a law without energy, or with a history.
    fn energy(&self, grad: &Tensor<f64>) -> Option<f64> {
        let _ = grad;
        None
    }

    /// Stiffest modulus at rest (Pa), `lambda + 2 mu` of a solid: a bound for stresses of a given
    /// strain.
    fn modulus(&self) -> f64;

    /// Factor of P, of the energy and of the modulus at the reference density `density` (kg/m3), 1
    /// for a law that does not depend on it.
    fn density_factor<T: Number>(&self, density: T) -> T {
        let _ = density;
        T::from(1.0)
    }

    /// `3 lambda + 2 mu` (Pa), the stiffness against equal strain on all axes, for a law of small
    /// strains; `None` for a law of finite strains.
    fn small_strain_modulus(&self) -> Option<f64> {
        None
    }

    /// `F_33 - 1` of a plate in plane stress, sigma_33 = 0, for the displacement gradient in its
    /// plane; `None` if the law is not implemented there.
    fn free_gradient<T: Number>(&self, grad: &Tensor<T, 2>) -> Option<T> {
        let _ = grad;
        None
    }

    /// Whether a body in uniaxial strain flows plastically at the displacement gradient `grad`.
    fn flows(&self, grad: f64) -> bool {
        let _ = grad;
        false
    }

    /// Whether P holds of a motion in `dimension` dimensions, or of a state `at_rest`.
    ///
    /// # Errors
    /// The reason why not, and what a suite can state instead.
    fn admits(&self, dimension: usize, at_rest: bool) -> Result<(), [&'static str; 2]> {
        let _ = (dimension, at_rest);
        Ok(())
    }
}

/// Lame's parameters (Pa).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Lame {
    pub(crate) lambda: f64,
    pub(crate) mu: f64,
}

impl Lame {
    /// From Young's modulus (Pa) and Poisson's ratio.
    pub(crate) fn new(young: f64, poisson: f64) -> Self {
        let lambda = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
        Self { lambda, mu: young / (2.0 * (1.0 + poisson)) }
    }

    /// `lambda + 2 mu` (Pa).
    pub(super) fn modulus(&self) -> f64 {
        self.lambda + 2.0 * self.mu
    }

    /// `nu/(1 - nu)`: minus the strain across a plate in plane stress over its area strain.
    pub(super) fn thinning(&self) -> f64 {
        self.lambda / self.modulus()
    }
}
