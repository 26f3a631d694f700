//! Arithmetic of a register of four `f64`.

use std::ops::{Add, AddAssign, Mul, Sub};

/// Numbers in a register.
pub(in crate::mpm) const LANES: usize = 4;

/// Four `f64`.
pub trait F64x4:
    Copy
    + Add<Output = Self>
    + Add<f64, Output = Self>
    + AddAssign
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Mul<f64, Output = Self>
    + Into<[f64; LANES]>
{
    /// `self + a b`, rounded once: IEEE 754's fusedMultiplyAdd, with the same bits on a processor
    /// that has no instruction for it.
    fn plus_product(self, a: Self, b: f64) -> Self;

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
