//! Unmet expectations, and their codes.

use mpm_subject::named;
use std::fmt;

named! {
    /// Kind of an unmet expectation. The names are stable: `mpm-verify explain CODE` explains them.
    pub enum UnmetCode {
        /// A level did not run to its end.
        RunFailed = "run-failed",
        /// The verdict differs from the expected verdict.
        VerdictDiffers = "verdict-differs",
        /// The observed order is below the expected range, or may be.
        OrderTooLow = "order-too-low",
        /// The observed order is above the expected range, or may be.
        OrderTooHigh = "order-too-high",
        /// The case is expected to fail, but converges.
        LimitGone = "limit-gone",
        /// A measured value exceeds its bound.
        BoundExceeded = "bound-exceeded",
        /// A conserved sum drifts, or energy is gained or lost.
        NotConserved = "not-conserved",
        /// Particles change their cell, or do not, against the expectation.
        CrossingsDiffer = "crossings-differ",
        /// The error floor has another cause than expected.
        FloorDiffers = "floor-differs",
        /// A run of a stability study differs from its expectation.
        StabilityDiffers = "stability-differs",
        /// A wave differs from the closed form.
        SpectrumDiffers = "spectrum-differs",
        /// The internal force at a position differs from the prediction.
        ForceDiffers = "force-differs",
        /// A derivative that a solver reports is wrong.
        DerivativeDiffers = "derivative-differs",
    }
}

/// An unmet expectation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Unmet {
    /// Kind of the expectation.
    pub code: UnmetCode,
    /// The expectation and the measured result, in one line.
    pub text: String,
}

impl Unmet {
    /// Creates an unmet expectation.
    pub fn new(code: UnmetCode, text: impl Into<String>) -> Self {
        Self { code, text: text.into() }
    }
}

impl fmt::Display for Unmet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}
