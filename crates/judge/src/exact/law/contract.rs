//! Trait of the constitutive laws of exact solutions.

use crate::exact::formula::Number;
use crate::exact::tensor::Tensor;

/// A law for the first Piola-Kirchhoff stress P. It is generic over [`Number`], so automatic
/// differentiation gives the divergence of P.
pub(super) trait ConstitutiveLaw {
    /// Name of the equation of motion in suites.
    const NAME: &'static str;

    /// Equation of motion in reports.
    const EQUATION: &'static str;

    /// Whether the stress depends on the history of the motion if the loading is not monotonic.
    const HAS_HISTORY: bool = false;

    /// Computes P (Pa) for `grad[i][j] = du_i/dX_j`, at unit density if the law depends on it.
    fn piola<T: Number, const D: usize>(&self, grad: &Tensor<T, D>) -> Tensor<T, D>;

    /// Computes the energy W (J/m3) with `P = dW/dF`, zero at rest or, for a gas, at infinite
    /// expansion; `None` for a law without energy, or with history.
    fn energy(&self, grad: &Tensor<f64>) -> Option<f64> {
        let _ = grad;
        None
    }

    /// Returns the scale of stress per strain (Pa), the largest modulus at rest.
    fn modulus(&self) -> f64;

    /// Returns the ratio of P, energy and modulus at `density` (kg/m3) to those at unit density.
    fn density_factor<T: Number>(&self, density: T) -> T {
        let _ = density;
        T::from(1.0)
    }

    /// Returns `3 lambda + 2 mu` (Pa) for a small-strain law, `None` for a finite-strain law.
    fn small_strain_modulus(&self) -> Option<f64> {
        None
    }

    /// Computes `F_33 - 1` of a plate in plane stress; `None` if the law does not implement it.
    fn free_gradient<T: Number>(&self, grad: &Tensor<T, 2>) -> Option<T> {
        let _ = grad;
        None
    }

    /// Computes P (Pa) of a body in uniaxial strain with the initial stress `initial` (Pa), for a
    /// law whose yield condition limits the total stress; `None` for other laws.
    fn piola_from<T: Number>(&self, grad: &Tensor<T>, initial: &Tensor<T>) -> Option<Tensor<T>> {
        let _ = (grad, initial);
        None
    }

    /// Whether a body in uniaxial strain along the first axis yields at `grad`.
    fn flows(&self, grad: f64, initial: &Tensor<f64>) -> bool {
        let _ = (grad, initial);
        false
    }

    /// Checks that the law is valid for motions in `dimension` dimensions, or for a body `at_rest`.
    ///
    /// # Errors
    /// The reason why the law is not valid, and an alternative for the suite.
    fn admits(&self, dimension: usize, at_rest: bool) -> Result<(), [&'static str; 2]> {
        let _ = (dimension, at_rest);
        Ok(())
    }
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Lame {
    pub(crate) lambda: f64,
    pub(crate) mu: f64,
}

impl Lame {
    pub(crate) fn new(young: f64, poisson: f64) -> Self {
        let lambda = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
        Self { lambda, mu: young / (2.0 * (1.0 + poisson)) }
    }

    pub(super) fn modulus(&self) -> f64 {
        self.lambda + 2.0 * self.mu
    }

    /// Returns `nu/(1 - nu)`, minus the ratio of thickness to area strain in plane stress.
    pub(super) fn thinning(&self) -> f64 {
        self.lambda / self.modulus()
    }
}
