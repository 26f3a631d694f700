//! A fluid, `P = -p J F^-T`, with Tait's equation of state `p = K/7 (J^-7 - 1)` (Cole 1948).

use super::contract::ConstitutiveLaw;
use crate::exact::formula::Number;
use crate::exact::tensor::{Tensor, deformation, dilation, tensor};

/// Tait's equation of state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TaitLaw {
    bulk: f64,
    viscosity: f64,
}

impl TaitLaw {
    /// Creates the law from bulk modulus (Pa) and viscosity (Pa s). Viscous fluids must be at rest.
    pub fn new(bulk: f64, viscosity: f64) -> Self {
        Self { bulk, viscosity }
    }
}

impl ConstitutiveLaw for TaitLaw {
    const NAME: &'static str = "tait";
    const EQUATION: &'static str =
        "Tait, rho0 u_tt = Div P + rho0 b, P = -p J F^-T, p = K/7 (J^-7 - 1)";

    fn piola<T: Number, const D: usize>(&self, grad: &Tensor<T, D>) -> Tensor<T, D> {
        let (_, cofactor, det) = deformation(grad);
        let excess = Number::powi(det, -7) - T::from(1.0);
        let pressure = T::from(self.bulk) * excess * T::from(1.0 / 7.0);
        tensor(|i, j| -(pressure * cofactor[i][j]))
    }

    /// Computes `W = K/7 (J^-6/6 + J - 7/6)` from `J - 1`.
    fn energy(&self, grad: &Tensor<f64>) -> Option<f64> {
        let dilation = dilation(grad);
        let power = libm::expm1(-6.0 * libm::log1p(dilation));
        Some(self.bulk / 7.0 * (power / 6.0 + dilation))
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_viscous_fluid_has_a_state_of_rest_only() {
        let viscous = TaitLaw::new(50.0, 1e-3);
        assert!(viscous.admits(2, true).is_ok() && viscous.admits(2, false).is_err());
        assert!(TaitLaw::new(50.0, 0.0).admits(2, false).is_ok());
    }
}
