//! J2 plasticity with linear hardening, under loading that never reverses.
//!
//! As long as the logarithmic strain `eps` grows along one direction, what has flowed is a function of
//! it, and the law is one of the whole deformation (Hencky 1924; it is the flow theory's integral for
//! proportional loading): the Kirchhoff stress is `tau = K tr(eps) I + s dev(eps)`, `s = 2 mu` up to
//! `q = sqrt(3/2) |2 mu dev(eps)| = Y`, and beyond such that `q = Y + H alpha`,
//! `3 mu alpha = q_elastic - q`. In uniaxial strain, where this is used, all loading is along one
//! direction; that it never reverses is checked (`loading`).

use crate::exact::{
    formula::Number,
    tensor::{Tensor, sum, tensor, unit},
};

/// Yield stress in tension (Pa) and hardening modulus (Pa).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Yield {
    pub(crate) stress: f64,
    pub(crate) hardening: f64,
}

/// The Kirchhoff stress (Pa) for the logarithmic strain `strain`, whose trace is `trace`.
pub(crate) fn kirchhoff<T: Number, const D: usize>(
    (strain, trace): (&Tensor<T, D>, T),
    (lambda, mu): (f64, f64),
    limit: Yield,
) -> Tensor<T, D> {
    let third = trace * T::from(1.0 / 3.0);
    let deviator: Tensor<T, D> = tensor(|i, j| strain[i][j] - third * unit(i, j));
    let bulk = T::from(3.0 * lambda + 2.0 * mu);
    let elastic = mises(&deviator, third, mu);
    let shear = if elastic.value() > limit.stress {
        let flow = (elastic - T::from(limit.stress)) / T::from(3.0 * mu + limit.hardening);
        T::from(2.0 * mu) * (T::from(1.0) - T::from(3.0 * mu) * flow / elastic)
    } else {
        T::from(2.0 * mu)
    };
    tensor(|i, j| bulk * third * unit(i, j) + shear * deviator[i][j])
}

/// `sqrt(3/2) |2 mu dev(eps)|`; along the axes that are left out the deviator is `-third`.
fn mises<T: Number, const D: usize>(deviator: &Tensor<T, D>, third: T, mu: f64) -> T {
    let inside = sum::<T, D>(|i| sum::<T, D>(|j| deviator[i][j] * deviator[i][j]));
    let square = inside + third * third * T::from((3 - D) as f64);
    // Where nothing is strained the root has no slope, and nothing flows.
    if square.value() == 0.0 { square } else { Number::sqrt(square * T::from(6.0 * mu * mu)) }
}
