//! Registers of four and eight `f64` with their arithmetic, and an array in place of a register on
//! processors without wide registers.

use crate::mpm::foundation::algebra::floor;
use std::ops::{Add, AddAssign, Mul, Sub};

pub(in crate::mpm) const LANES: usize = 4;

/// A register of several `f64`.
pub trait Register: Copy + Add<Output = Self> + AddAssign + Mul<f64, Output = Self> {
    /// Computes `self + a b`, rounded once (fusedMultiplyAdd of IEEE 754). Processors without this
    /// instruction give a bit-identical result.
    fn plus_product(self, a: Self, b: f64) -> Self;
}

/// Eight `f64` as a pair of registers of four.
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

/// A register of four `f64`.
pub trait F64x4:
    Register + Add<f64, Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Into<[f64; LANES]>
{
    /// Returns the largest integer not above each lane, for magnitudes up to 2^51.
    fn floor(self) -> Self;

    /// Whether all lanes are in `low..high`; false for NaN.
    fn are_in(self, low: f64, high: f64) -> bool;

    /// Returns the magnitude of each lane.
    fn abs(self) -> Self;

    /// Returns the maximum of each lane and `limit`; `limit` for NaN.
    fn at_least(self, limit: f64) -> Self;

    /// Returns the minimum of each lane and `limit`; `limit` for NaN.
    fn at_most(self, limit: f64) -> Self;

    /// Returns the reciprocal of each lane.
    fn inverse(self) -> Self;

    /// Returns the reciprocal of each lane; zero for lanes that do not exceed `smallest`.
    fn inverse_above(self, smallest: f64) -> Self;
}

/// Processor level without wide registers.
#[derive(Debug, Clone, Copy)]
pub(in crate::mpm) struct Plain;

/// Four `f64` in memory, in place of a register.
#[derive(Debug, Clone, Copy)]
pub(in crate::mpm) struct Array(pub(super) [f64; LANES]);

impl Array {
    #[inline(always)]
    fn map(self, f: impl Fn(f64) -> f64) -> Self {
        let [a, b, c, d] = self.0;
        Self([f(a), f(b), f(c), f(d)])
    }

    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        let ([a, b, c, d], [e, g, h, i]) = (self.0, other.0);
        Self([f(a, e), f(b, g), f(c, h), f(d, i)])
    }
}

/// Computes `a b + c`, rounded once. Uses the processor instruction if the target guarantees it,
/// and otherwise `libm::fma`, because some platform libraries round incorrectly.
#[inline(always)]
fn fused(a: f64, b: f64, c: f64) -> f64 {
    if cfg!(any(target_feature = "fma", target_arch = "aarch64")) {
        a.mul_add(b, c)
    } else {
        libm::fma(a, b, c)
    }
}

impl Add for Array {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
}

impl Add<f64> for Array {
    type Output = Self;

    #[inline(always)]
    fn add(self, term: f64) -> Self {
        self.map(|a| a + term)
    }
}

impl AddAssign for Array {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Sub for Array {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
}

impl Mul for Array {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }
}

impl Mul<f64> for Array {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        self.map(|a| a * factor)
    }
}

impl From<Array> for [f64; LANES] {
    #[inline(always)]
    fn from(Array(values): Array) -> Self {
        values
    }
}

impl Register for Array {
    #[inline(always)]
    fn plus_product(self, a: Self, b: f64) -> Self {
        self.zip(a, |sum, a| fused(a, b, sum))
    }
}

impl F64x4 for Array {
    #[inline(always)]
    fn floor(self) -> Self {
        self.map(floor)
    }

    #[inline(always)]
    fn are_in(self, low: f64, high: f64) -> bool {
        self.0.iter().all(|&x| x >= low && x < high)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.map(f64::abs)
    }

    #[inline(always)]
    fn at_least(self, limit: f64) -> Self {
        self.map(|x| if x > limit { x } else { limit })
    }

    #[inline(always)]
    fn at_most(self, limit: f64) -> Self {
        self.map(|x| if x < limit { x } else { limit })
    }

    #[inline(always)]
    fn inverse(self) -> Self {
        self.map(|x| 1.0 / x)
    }

    #[inline(always)]
    fn inverse_above(self, smallest: f64) -> Self {
        self.map(|x| if x > smallest { 1.0 / x } else { 0.0 })
    }
}
