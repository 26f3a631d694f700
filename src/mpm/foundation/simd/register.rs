//! Arithmetic of sums over particles and nodes, in a register of any width.

use std::ops::{Add, AddAssign, Mul};

/// Numbers in a register of four.
pub(in crate::mpm) const LANES: usize = 4;

/// Several `f64`.
pub trait Register: Copy + Add<Output = Self> + AddAssign + Mul<f64, Output = Self> {
    /// `self + a b`, rounded once: IEEE 754's fusedMultiplyAdd, with the same bits on a processor
    /// that has no instruction for it.
    fn plus_product(self, a: Self, b: f64) -> Self;
}

/// Eight `f64` in two registers of four.
#[derive(Debug, Clone, Copy)]
pub struct Pair<F>(pub(super) F, pub(super) F);

impl<F: Register> Add for Pair<F> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0, self.1 + other.1)
    }
}

impl<F: Register> AddAssign for Pair<F> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<F: Register> Mul<f64> for Pair<F> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        Self(self.0 * factor, self.1 * factor)
    }
}

impl<F: Register> Register for Pair<F> {
    #[inline(always)]
    fn plus_product(self, a: Self, b: f64) -> Self {
        Self(self.0.plus_product(a.0, b), self.1.plus_product(a.1, b))
    }
}

impl<F: Into<[f64; LANES]>> From<Pair<F>> for [f64; 2 * LANES] {
    #[inline(always)]
    fn from(Pair(low, high): Pair<F>) -> Self {
        let ([a, b, c, d], [e, f, g, h]) = (low.into(), high.into());
        [a, b, c, d, e, f, g, h]
    }
}
