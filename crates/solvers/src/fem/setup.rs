//! Set-up of a bar and its validation, and the laws `P(F)` of the bar in uniaxial strain. The laws
//! are implemented independently of the MPM material laws and of the exact solutions.

use super::Element;
use mpm_subject::named;
use mpm_subject::{Failure, Start};
use thiserror::Error;

/// A function of the reference position X or of the deformation gradient F.
pub type ScalarFunction = Box<dyn Fn(f64) -> f64 + Send>;
/// A function of time t.
pub type TimeFunction = Box<dyn Fn(f64) -> f64 + Send>;
/// A body force as a function of time, reference position and displacement, evaluated at many
/// positions per call. The arguments are the time t (s), the positions X (m) and displacements u
/// (m), and the output array. The positions are the same in every call.
pub type BarLoad = Box<dyn FnMut(f64, (&[f64], &[f64]), &mut [f64]) + Send>;

/// Creates a load with the value `f(X, t)` at each position.
pub fn pointwise(f: impl Fn(f64, f64) -> f64 + Send + 'static) -> BarLoad {
    Box::new(move |t, (places, _), values| {
        for (value, x) in values.iter_mut().zip(places) {
            *value = f(*x, t);
        }
    })
}

named! {
    /// Kind of mass matrix.
    pub enum Mass {
        /// Diagonal: the sums of the rows of the consistent matrix.
        Lumped = "lumped",
        /// `int rho0 N_i N_j dX`.
        Consistent = "consistent",
    }
}

named! {
    /// Points at which the state is sampled.
    pub enum Sampling {
        /// At four points inside each element, which are not superconvergent.
        Inside = "inside",
        /// At the nodes, where the error of a smooth solution may be of a higher order.
        Nodes = "nodes",
    }
}

/// A bar on `[from, to]` (m): its law, loads and discretisation.
pub struct BarSetup {
    /// Reference position of the left end (m).
    pub from: f64,
    /// Reference position of the right end (m).
    pub to: f64,
    /// Number of elements. All elements have equal lengths.
    pub cells: usize,
    /// Kind of element, which determines the shape functions.
    pub element: Element,
    /// Kind of mass matrix.
    pub mass: Mass,
    /// Reference density rho0 (kg/m3).
    pub density: f64,
    /// First Piola-Kirchhoff stress `P(F)` (Pa).
    pub law: ScalarFunction,
    /// Whether the left and right ends are fixed at zero displacement. The initial fields are not
    /// evaluated at fixed ends.
    pub fixed: [bool; 2],
    /// Body force `b(X, t, u)` per unit mass (m/s2), if any.
    pub body_force: Option<BarLoad>,
    /// Piola stress `p0(t)` (Pa) on the left and right ends; tension is positive at both. Only a
    /// free end can have a traction.
    pub traction: [Option<TimeFunction>; 2],
    /// Displacement `u(X)` at t = 0 (m).
    pub initial_displacement: ScalarFunction,
    /// Velocity `v(X)` at t = 0 (m/s), interpolated at the nodes like the displacement.
    /// Interpolation is accurate to order k + 1, the order of the element.
    pub initial_velocity: ScalarFunction,
    /// Meaning of `initial_velocity` in the first step.
    pub start: Start,
    /// Points at which the state is sampled.
    pub sampling: Sampling,
}

/// Maximum number of elements; a larger number is probably a mistake.
pub(super) const MOST_CELLS: usize = 1 << 24;

/// Reason why the set-up is invalid.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum SetupError {
    /// The number of elements is zero or too large.
    #[error("{0} elements; a bar has 1 to {MOST_CELLS} of them")]
    Cells(usize),
    /// The ends are not in order, or their distance is not finite.
    #[error("the bar from {from} m to {to} m has no finite, positive length")]
    Interval {
        /// Left end.
        from: f64,
        /// Right end.
        to: f64,
    },
    /// The density is not a finite, positive number.
    #[error("the density {0} kg/m3 is not finite and positive")]
    Density(f64),
    /// A traction acts on an end with a prescribed displacement.
    #[error("the {0} end is fixed and cannot take a traction")]
    TractionAtFixedEnd(&'static str),
    /// The initial state is invalid, or the mass matrix cannot be factorised.
    #[error("before the first step: {0}")]
    Initial(#[from] Failure),
}

impl BarSetup {
    /// Checks the values of the set-up; NaN is rejected.
    pub(super) fn check(&self) -> Result<(), SetupError> {
        let Self { from, to, cells, density, .. } = *self;
        if !(1..=MOST_CELLS).contains(&cells) {
            return Err(SetupError::Cells(cells));
        }
        if !(from < to && (to - from).is_finite()) {
            return Err(SetupError::Interval { from, to });
        }
        if !(density > 0.0 && density.is_finite()) {
            return Err(SetupError::Density(density));
        }
        for (end, name) in ["left", "right"].into_iter().enumerate() {
            if self.fixed[end] && self.traction[end].is_some() {
                return Err(SetupError::TractionAtFixedEnd(name));
            }
        }
        Ok(())
    }
}

named! {
    /// Law of the bar in uniaxial strain.
    pub enum BarLaw {
        /// `P = M (F - 1)`, `M = lambda + 2 mu`.
        SmallStrain = "small_strain",
        /// `P = M ln F`, the integral of the rate form of linear elasticity in 1-D.
        LogStrain = "log_strain",
        /// `P = lambda ln(F)/F + mu (F - 1/F)`.
        NeoHookean = "neo_hookean",
        /// `P = M ln(F)/F`.
        Hencky = "hencky",
    }
}

impl BarLaw {
    /// Returns the law with this name, if it exists.
    pub fn find(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|law| law.name() == name)
    }

    /// Returns P(F) (Pa), from Young's modulus (Pa) and Poisson's ratio.
    pub fn piola(self, young: f64, poisson: f64) -> ScalarFunction {
        let lambda = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
        let mu = young / (2.0 * (1.0 + poisson));
        let modulus = lambda + 2.0 * mu;
        match self {
            Self::SmallStrain => Box::new(move |f| modulus * (f - 1.0)),
            Self::LogStrain => Box::new(move |f| modulus * libm::log(f)),
            Self::NeoHookean => Box::new(move |f| lambda * libm::log(f) / f + mu * (f - 1.0 / f)),
            Self::Hencky => Box::new(move |f| modulus * libm::log(f) / f),
        }
    }
}
