//! A polytropic gas, `P = -p J F^-T`, `p = K (rho0/J)^g`, `W = K rho0^g J^(1-g)/(g - 1)`.
//!
//! Stress and energy are for unit density; `rho0^g` is [`ConstitutiveLaw::density_factor`].

use super::contract::ConstitutiveLaw;
use crate::exact::formula::Number;
use crate::exact::tensor::{Tensor, deformation, dilation, tensor};

/// A gas whose pressure is a power of the density.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PolytropicLaw {
    stiffness: f64,
    exponent: f64,
}

impl PolytropicLaw {
    /// Creates the law from the stiffness K (Pa (m3/kg)^g) and the exponent g.
    pub fn new(stiffness: f64, exponent: f64) -> Self {
        Self { stiffness, exponent }
    }
}

impl ConstitutiveLaw for PolytropicLaw {
    const NAME: &'static str = "polytropic";
    const EQUATION: &'static str =
        "polytropic gas, rho0 u_tt = Div P + rho0 b, P = -p J F^-T, p = K (rho0/J)^g";

    fn piola<T: Number, const D: usize>(&self, grad: &Tensor<T, D>) -> Tensor<T, D> {
        let (_, cofactor, det) = deformation(grad);
        let expansion = Number::pow(det, T::from(self.exponent));
        let tension = T::from(-self.stiffness) / expansion;
        tensor(|i, j| tension * cofactor[i][j])
    }

    fn energy(&self, grad: &Tensor<f64>) -> Option<f64> {
        let beyond = self.exponent - 1.0;
        let logarithm = libm::log1p(dilation(grad));
        Some(self.stiffness / beyond * libm::exp(-beyond * logarithm))
    }

    fn modulus(&self) -> f64 {
        self.exponent * self.stiffness
    }

    fn density_factor<T: Number>(&self, density: T) -> T {
        Number::pow(density, T::from(self.exponent))
    }
}
