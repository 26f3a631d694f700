//! Arithmetic of a register of four `f64`.

use super::register::{LANES, Register};
use std::ops::{Add, Mul, Sub};

/// Four `f64`.
pub trait F64x4:
    Register + Add<f64, Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Into<[f64; LANES]>
{
    /// Largest integer not above each, for magnitudes up to 2^51.
    fn floor(self) -> Self;

    /// Whether all lanes are in `low..high`; false for NaN.
    fn are_in(self, low: f64, high: f64) -> bool;

    /// Magnitudes.
    fn abs(self) -> Self;

    /// Each lane, or `limit` where it is not above it.
    fn at_least(self, limit: f64) -> Self;

    /// Each lane, or `limit` where it is not below it.
    fn at_most(self, limit: f64) -> Self;

    /// Reciprocals.
    fn inverse(self) -> Self;

    /// Reciprocals, zero for lanes that do not exceed `smallest`.
    fn inverse_above(self, smallest: f64) -> Self;
}
