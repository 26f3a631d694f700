//! Fixed corotated elasticity, `P = 2 mu (F - R) + lambda (J - 1) J F^-T`, where R is the rotation
//! in `F = R U` (Stomakhin, Howes, Schroeder & Teran 2012).

use super::contract::{ConstitutiveLaw, Lame};
use crate::exact::formula::Number;
use crate::exact::tensor::{Tensor, deformation, dilation, rotation, sum, tensor, unit};

/// Fixed corotated elasticity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CorotatedLaw(Lame);

impl CorotatedLaw {
    /// Creates the law from Young's modulus (Pa) and Poisson's ratio.
    pub fn new(young: f64, poisson: f64) -> Self {
        Self(Lame::new(young, poisson))
    }
}

impl ConstitutiveLaw for CorotatedLaw {
    const NAME: &'static str = "corotated";
    const EQUATION: &'static str = "fixed corotated, rho0 u_tt = Div P + rho0 b, \
        P = 2 mu (F - R) + lambda (J - 1) J F^-T, F = R U";

    fn piola<T: Number, const D: usize>(&self, grad: &Tensor<T, D>) -> Tensor<T, D> {
        let (lambda, twice_mu) = (T::from(self.0.lambda), T::from(2.0 * self.0.mu));
        let (f, cofactor, det) = deformation(grad);
        let pressure = lambda * (det - T::from(1.0));
        let turn = rotation(&f);
        tensor(|i, j| {
            let stretch = grad[i][j] + (unit::<T>(i, j) - turn[i][j]);
            twice_mu * stretch + pressure * cofactor[i][j]
        })
    }

    /// Computes `W = mu |F - R|^2 + lambda/2 (J - 1)^2`.
    fn energy(&self, grad: &Tensor<f64>) -> Option<f64> {
        let Lame { lambda, mu } = self.0;
        let turn = rotation::<f64, 3>(&tensor(|i, j| grad[i][j] + unit::<f64>(i, j)));
        let stretch: Tensor<f64> = tensor(|i, j| grad[i][j] + (unit::<f64>(i, j) - turn[i][j]));
        let square = sum::<f64, 3>(|i| sum::<f64, 3>(|j| stretch[i][j] * stretch[i][j]));
        let dilation = dilation(grad);
        Some(0.5 * lambda * dilation * dilation + mu * square)
    }

    fn modulus(&self) -> f64 {
        self.0.modulus()
    }
}
