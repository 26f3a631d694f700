//! Linear elasticity with the Green-Naghdi rate in simple shear.
//!
//! The rotation angle beta of `F = R U` satisfies `tan(beta) = gamma/2`. The rate then integrates
//! to (Dienes 1979)
//!
//! ```text
//! tau12 = 2 mu cos(2 beta) (2 beta - 2 tan(2 beta) ln(cos(beta)) - tan(beta))
//! tau11 = -tau22 = 4 mu (cos(2 beta) ln(cos(beta)) + beta sin(2 beta) - sin(beta)^2)
//! ```

use super::contract::{ConstitutiveLaw, Lame};
use super::simple_shear::{admit_a_plane, piola_in_simple_shear};
use crate::exact::formula::Number;
use crate::exact::tensor::Tensor;

/// Linear elasticity with the Green-Naghdi rate in simple shear.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GreenNaghdiLaw(Lame);

impl GreenNaghdiLaw {
    /// Creates the law from Young's modulus (Pa) and Poisson's ratio.
    pub fn new(young: f64, poisson: f64) -> Self {
        Self(Lame::new(young, poisson))
    }
}

impl ConstitutiveLaw for GreenNaghdiLaw {
    const NAME: &'static str = "green_naghdi";
    const EQUATION: &'static str = "linear elastic law for the Kirchhoff stress tau with the \
                                    Green-Naghdi rate in simple shear, \
                                    rho0 u_tt = Div P + rho0 b, P = tau F^-T, \
                                    tau_dot = lambda tr(d) I + 2 mu d + W tau - tau W, \
                                    W = R_dot R^T";

    fn piola<T: Number, const D: usize>(&self, grad: &Tensor<T, D>) -> Tensor<T, D> {
        let mu = T::from(self.0.mu);
        piola_in_simple_shear(grad, |gamma| {
            let beta = Number::atan(gamma * T::from(0.5));
            let double = beta + beta;
            let (cos, sin) = (Number::cos(double), Number::sin(double));
            let log = Number::ln(Number::cos(beta));
            let (half, square) = (Number::tan(beta), Number::sin(beta) * Number::sin(beta));
            // cos(2 beta) tan(2 beta) is written as sin(2 beta): the tangent may be infinite.
            let shear = T::from(2.0) * (cos * (double - half) - T::from(2.0) * sin * log);
            [T::from(4.0) * mu * (cos * log + beta * sin - square), mu * shear]
        })
    }

    fn modulus(&self) -> f64 {
        self.0.modulus()
    }

    fn admits(&self, dimension: usize, _: bool) -> Result<(), [&'static str; 2]> {
        admit_a_plane(dimension)
    }
}
