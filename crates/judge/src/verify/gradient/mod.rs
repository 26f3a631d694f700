//! Judges the derivatives that a differentiable solver reports.

mod cause;
mod study;
mod sweep;
mod taylor;

pub use cause::{GradientEntry, GradientEvidence};
pub use study::{GradientLevel, GradientStudy, GradientTerms};
pub use sweep::{Sweep, SweepPoint};
pub use taylor::{FIRST_LEVEL, LAST_LEVEL, Perturbed, Taylor};

use mpm_subject::named;

named! {
    /// State of a reported derivative.
    pub enum GradientState {
        /// The derivative is correct, and the function has no jumps nearby.
        Smooth = "smooth",
        /// The derivative is correct at the point, and the function has jumps nearby.
        Jumps = "jumps",
        /// The derivative is correct, and the function is linear in the parameter.
        Linear = "linear",
        /// Rounding errors hide the remainder, so the derivative cannot be judged.
        AtRounding = "at_rounding",
        /// The reported derivative is not the derivative of the function.
        Wrong = "wrong",
    }
}

/// Two values of the functional that must agree.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ValueCheck {
    /// Value reported with the gradient.
    pub reported: f64,
    /// Value computed from the state of a run without derivatives.
    pub computed: f64,
    /// Maximum difference between both values.
    pub tolerance: f64,
}

impl ValueCheck {
    /// Whether both values agree.
    pub fn agrees(&self) -> bool {
        (self.reported - self.computed).abs() <= self.tolerance
    }
}
