//! A fluid at rest, `P = -p J F^-T` with Tait's equation of state in Cole's form,
//! `p = K/7 (J^-7 - 1)` (Cole 1948).

use super::contract::ConstitutiveLaw;
use crate::exact::formula::Number;
use crate::exact::tensor::{Tensor, cofactor, det, tensor, unit};

/// Tait's equation of state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TaitLaw {
    bulk: f64,
    viscosity: f64,
}

impl TaitLaw {
    /// From the bulk modulus at rest (Pa) and the viscosity (Pa s), which stresses a fluid in
    /// motion.
    pub fn new(bulk: f64, viscosity: f64) -> Self {
        Self { bulk, viscosity }
    }
}

impl ConstitutiveLaw for TaitLaw {
    const NAME: &'static str = "tait";
    const EQUATION: &'static str =
        "Tait, rho0 u_tt = Div P + rho0 b, P = -p J F^-T, p = K/7 (J^-7 - 1)";

    fn piola<T: Number, const D: usize>(&self, grad: &Tensor<T, D>) -> Tensor<T, D> {
        let f: Tensor<T, D> = tensor(|i, j| grad[i][j] + unit(i, j));
        let cofactor: Tensor<T, D> = tensor(|i, j| cofactor(&f, i, j));
        let excess = Number::powi(det(&f, &cofactor), -7) - T::from(1.0);
        let pressure = T::from(self.bulk) * excess * T::from(1.0 / 7.0);
        tensor(|i, j| -(pressure * cofactor[i][j]))
    }

    fn modulus(&self) -> f64 {
        self.bulk
    }

    fn admits(&self, _: usize, at_rest: bool) -> Result<(), [&'static str; 2]> {
        if at_rest || !(self.viscosity > 0.0) {
            return Ok(());
        }
        Err([
            "the stress of a viscous fluid in motion depends on its velocity",
            "state an `equilibrium`, or a motion without viscosity",
        ])
    }
}
