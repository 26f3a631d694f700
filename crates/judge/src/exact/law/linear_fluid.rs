//! An inviscid fluid with linear compressibility, `P = -p J F^-T`, `p = -K (J - 1)`.

use super::contract::ConstitutiveLaw;
use crate::exact::formula::Number;
use crate::exact::tensor::{Tensor, deformation, dilation, tensor};

/// A fluid whose pressure is proportional to the dilation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearFluidLaw {
    bulk: f64,
}

impl LinearFluidLaw {
    /// Creates the law from the bulk modulus (Pa).
    pub fn new(bulk: f64) -> Self {
        Self { bulk }
    }
}

impl ConstitutiveLaw for LinearFluidLaw {
    const NAME: &'static str = "linear_fluid";
    const EQUATION: &'static str =
        "linear fluid, rho0 u_tt = Div P + rho0 b, P = -p J F^-T, p = -K (J - 1)";

    fn piola<T: Number, const D: usize>(&self, grad: &Tensor<T, D>) -> Tensor<T, D> {
        let (_, cofactor, det) = deformation(grad);
        let tension = T::from(self.bulk) * (det - T::from(1.0));
        tensor(|i, j| tension * cofactor[i][j])
    }

    fn energy(&self, grad: &Tensor<f64>) -> Option<f64> {
        let dilation = dilation(grad);
        Some(0.5 * self.bulk * dilation * dilation)
    }

    fn modulus(&self) -> f64 {
        self.bulk
    }
}
