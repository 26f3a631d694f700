//! Plastic flow in uniaxial strain under monotonic loading.
//!
//! Let `e` be the logarithmic strain of the driven axis, with elasticity linear in `e` and no
//! hardening. If the yield surface is a cone or consists of planes, the axial Kirchhoff stress is
//! piecewise linear in `e`. It is elastic up to yield, and then has the elastic-plastic modulus. At
//! an apex, where all principal stresses are equal, it is constant.

use super::contract::{ConstitutiveLaw, Lame};
use crate::exact::formula::Number;
use crate::exact::tensor::{Tensor, tensor};

/// A plasticity law that is implemented for uniaxial strain only.
pub(super) trait UniaxialPlasticity {
    /// See [`ConstitutiveLaw::NAME`].
    const MATERIAL: &'static str;

    /// See [`ConstitutiveLaw::EQUATION`].
    const TEXT: &'static str;

    /// Returns the axial stress as a function of the strain.
    fn response(&self) -> &UniaxialLaw;
}

impl<L: UniaxialPlasticity> ConstitutiveLaw for L {
    const NAME: &'static str = L::MATERIAL;
    const EQUATION: &'static str = L::TEXT;
    const HAS_HISTORY: bool = true;

    fn piola<T: Number, const D: usize>(&self, grad: &Tensor<T, D>) -> Tensor<T, D> {
        self.response().piola(grad)
    }

    fn modulus(&self) -> f64 {
        self.response().lame.modulus()
    }

    fn flows(&self, grad: f64) -> bool {
        self.response().flows(grad)
    }

    fn admits(&self, dimension: usize, _: bool) -> Result<(), [&'static str; 2]> {
        if dimension == 1 {
            return Ok(());
        }
        Err([
            "the stress is a function of the deformation in uniaxial strain only",
            "use a scene of dimension 1",
        ])
    }
}

/// Plastic flow in compression or in extension.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct UniaxialFlow {
    /// Magnitude of the strain at yield; infinite if the body never yields.
    pub(super) strain: f64,
    /// `d tau11/de` after yield (Pa).
    pub(super) modulus: f64,
    /// Strain from yield to the apex; infinite if the apex is never reached.
    pub(super) to_apex: f64,
}

impl UniaxialFlow {
    pub(super) const NONE: Self =
        Self { strain: f64::INFINITY, modulus: 0.0, to_apex: f64::INFINITY };
}

/// The axial stress of a law in uniaxial strain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct UniaxialLaw {
    pub(super) lame: Lame,
    pub(super) compression: UniaxialFlow,
    pub(super) extension: UniaxialFlow,
}

impl UniaxialLaw {
    fn sense(&self, strain: f64) -> (f64, &UniaxialFlow) {
        if strain < 0.0 { (-1.0, &self.compression) } else { (1.0, &self.extension) }
    }

    fn kirchhoff<T: Number>(&self, strain: T) -> T {
        let (sign, flow) = self.sense(strain.value());
        let elastic = self.lame.modulus();
        let beyond = sign * strain.value() - flow.strain;
        if !(beyond > 0.0) {
            return T::from(elastic) * strain;
        }
        let at_yield = T::from(sign * elastic * flow.strain);
        if beyond > flow.to_apex {
            return at_yield + T::from(sign * flow.modulus * flow.to_apex);
        }
        at_yield + T::from(flow.modulus) * (strain - T::from(sign * flow.strain))
    }

    /// Computes P (Pa) for the displacement gradient of uniaxial strain along the first axis.
    fn piola<T: Number, const D: usize>(&self, grad: &Tensor<T, D>) -> Tensor<T, D> {
        let stretch = T::from(1.0) + grad[0][0];
        let along = self.kirchhoff(Number::ln(stretch)) / stretch;
        tensor(|i, j| if i + j == 0 { along } else { T::from(0.0) })
    }

    fn flows(&self, grad: f64) -> bool {
        let strain = libm::log1p(grad);
        strain.abs() > self.sense(strain).1.strain
    }
}
