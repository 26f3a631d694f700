//! The flow of heat in a deformed body, seen from its reference configuration.
//!
//! Fourier's law holds where the body is now, `q = -k grad T` per current area. Per reference area
//! it is `Q = -k J C^-1 Grad T`, `C = F^T F` (Holzapfel 2000, *Nonlinear Solid Mechanics*, section
//! 7.1), and the balance is `rho0 c T_t = -Div Q + rho0 s`. A body at rest has F = I.

use super::field::TemperatureDerivatives;
use crate::exact::formula::{Number, Slope};
use crate::exact::motion::Derivatives;
use crate::exact::tensor::{Tensor, cofactor, det, sum, tensor, unit};

/// `J C^-1 Grad T` of a gradient of displacement and one of temperature.
fn pulled_back<T: Number, const D: usize>(grad_u: &Tensor<T, D>, grad: &[T; D]) -> [T; D] {
    let f: Tensor<T, D> = tensor(|i, j| grad_u[i][j] + unit(i, j));
    // F^-T = cof(F)/J.
    let cofactor: Tensor<T, D> = tensor(|i, j| cofactor(&f, i, j));
    let j = det(&f, &cofactor);
    let metric = |a: usize, b: usize| sum::<T, D>(|i| cofactor[i][a] * cofactor[i][b]) / j;
    std::array::from_fn(|a| sum::<T, D>(|b| metric(a, b) * grad[b]))
}

/// `J C^-1 Grad T` (K/m), what flows in through a reference area is k times it along the normal.
pub(super) fn slope(motion: &Derivatives, now: &TemperatureDerivatives) -> [f64; 3] {
    pulled_back::<f64, 3>(&motion.grad, &now.grad)
}

/// `Div (J C^-1 Grad T)` (K/m2), where nothing varies beyond the first `dimension` axes.
pub(super) fn divergence(
    dimension: usize,
    motion: &Derivatives,
    now: &TemperatureDerivatives,
) -> f64 {
    match dimension {
        1 => {
            let [x] = divergence_in(motion, now);
            x
        }
        2 => {
            let [x, y] = divergence_in(motion, now);
            x + y
        }
        _ => {
            let [x, y, z] = divergence_in(motion, now);
            x + y + z
        }
    }
}

/// The terms of the divergence in D dimensions.
fn divergence_in<const D: usize>(motion: &Derivatives, now: &TemperatureDerivatives) -> [f64; D] {
    let bent = |i: usize, j: usize| std::array::from_fn(|axis| motion.second[i][j][axis]);
    let grad_u: Tensor<Slope<D>, D> = tensor(|i, j| Slope::new(motion.grad[i][j], bent(i, j)));
    let curved = |a: usize| std::array::from_fn(|axis| now.second[a][axis]);
    let grad: [Slope<D>; D] = std::array::from_fn(|a| Slope::new(now.grad[a], curved(a)));
    let flow = pulled_back(&grad_u, &grad);
    std::array::from_fn(|a| flow[a].d(a))
}
