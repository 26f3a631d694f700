//! Linear elasticity with the Jaumann rate in simple shear.
//!
//! In simple shear by gamma, the spin per unit gamma is constant. The rate integrates to the
//! oscillating `tau12 = mu sin(gamma)`, `tau11 = -tau22 = mu (1 - cos(gamma))` (Dienes 1979).

use super::contract::{ConstitutiveLaw, Lame};
use super::simple_shear::{admit_a_plane, piola_in_simple_shear};
use crate::exact::formula::Number;
use crate::exact::tensor::Tensor;

/// Linear elasticity with the Jaumann rate in simple shear.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JaumannLaw(Lame);

impl JaumannLaw {
    /// Creates the law from Young's modulus (Pa) and Poisson's ratio.
    pub fn new(young: f64, poisson: f64) -> Self {
        Self(Lame::new(young, poisson))
    }
}

impl ConstitutiveLaw for JaumannLaw {
    const NAME: &'static str = "jaumann";
    const EQUATION: &'static str = "linear elastic law for the Kirchhoff stress tau with the \
                                    Jaumann rate in simple shear, \
                                    rho0 u_tt = Div P + rho0 b, P = tau F^-T, \
                                    tau12 = mu sin(gamma), tau11 = -tau22 = mu (1 - cos(gamma))";

    fn piola<T: Number, const D: usize>(&self, grad: &Tensor<T, D>) -> Tensor<T, D> {
        let mu = T::from(self.0.mu);
        piola_in_simple_shear(grad, |gamma| {
            [mu * (T::from(1.0) - Number::cos(gamma)), mu * Number::sin(gamma)]
        })
    }

    fn modulus(&self) -> f64 {
        self.0.modulus()
    }

    fn admits(&self, dimension: usize, _: bool) -> Result<(), [&'static str; 2]> {
        admit_a_plane(dimension)
    }
}
