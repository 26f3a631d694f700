//! Four numbers, and what makes them.

use crate::mpm::algebra::{Vector, array};
use std::ops::{Add, AddAssign, Mul, Range, Sub};

/// Numbers in a register.
pub(in crate::mpm) const FOUR: usize = 4;

/// Particles whose weights are computed before the nodes of the first are seen: so many that what is
/// done once for all of them costs little, so few that their weights stay near.
pub(in crate::mpm) const LANES: usize = 16;

/// Registers for as many.
const PARTS: usize = LANES / FOUR;

/// A number for each of so many particles.
#[derive(Debug, Clone, Copy)]
#[repr(align(32))]
pub(in crate::mpm) struct Lanes(pub(in crate::mpm) [f64; LANES]);

impl Lanes {
    /// All zero.
    pub(in crate::mpm) const ZERO: Self = Self([0.0; LANES]);

    /// One of them.
    #[inline(always)]
    pub(in crate::mpm) fn get(&self, lane: usize) -> f64 {
        // The remainder proves to the compiler what callers keep to.
        self.0[lane % LANES]
    }

    /// Four of them.
    #[inline(always)]
    pub(in crate::mpm) fn four<W: Width>(&self, width: W, part: usize) -> W::Four {
        width.four(array(0.0, |lane| self.0[part % PARTS * FOUR + lane]))
    }

    /// Puts four of them.
    #[inline(always)]
    pub(in crate::mpm) fn put<F: Four>(&mut self, part: usize, four: F) {
        self.0[part % PARTS * FOUR..][..FOUR].copy_from_slice(&four.into());
    }
}

/// The parts in which these lanes are.
#[inline(always)]
pub(in crate::mpm) fn parts(lanes: &Range<usize>) -> Range<usize> {
    lanes.start / FOUR..lanes.end.div_ceil(FOUR)
}

/// D of four numbers, from `first` on.
#[inline(always)]
pub(in crate::mpm) fn part<const D: usize>(
    four: impl Into<[f64; FOUR]>,
    first: usize,
) -> Vector<D> {
    let lanes = four.into();
    let mut vector = Vector::zeros();
    for axis in 0..D {
        vector[axis] = lanes[(first + axis) % FOUR];
    }
    vector
}

/// Four numbers.
pub trait Four:
    Copy
    + Add<Output = Self>
    + Add<f64, Output = Self>
    + AddAssign
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Mul<f64, Output = Self>
    + Into<[f64; FOUR]>
{
    /// The whole numbers next below, up to 2^51.
    fn floor(self) -> Self;

    /// Whether all of them are in `low..high`. NaN is not.
    fn are_in(self, low: f64, high: f64) -> bool;

    /// Their magnitudes.
    fn abs(self) -> Self;

    /// They, or `limit` in place of those that are not above it.
    fn at_least(self, limit: f64) -> Self;

    /// They, or `limit` in place of those that are not below it.
    fn at_most(self, limit: f64) -> Self;

    /// Their reciprocals.
    fn inverse(self) -> Self;

    /// Their reciprocals, zero for those that do not exceed `smallest`.
    fn inverse_above(self, smallest: f64) -> Self;
}

/// What makes fours of numbers: proof that the processor can.
pub trait Width: Copy {
    /// The four numbers.
    type Four: Four;

    /// Takes them from an array.
    fn four(self, values: [f64; FOUR]) -> Self::Four;

    /// Four times the same.
    fn all(self, value: f64) -> Self::Four;
}
