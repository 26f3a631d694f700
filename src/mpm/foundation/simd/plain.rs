//! Register emulated by an array, for every processor.

use super::f64x4::F64x4;
use super::register::{LANES, Register};
use crate::mpm::foundation::algebra::floor;
use std::ops::{Add, AddAssign, Mul, Sub};

/// Level without wide registers.
#[derive(Debug, Clone, Copy)]
pub(in crate::mpm) struct Plain;

/// Four `f64` in memory.
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

/// `a b + c`, rounded once. Where every processor of the target has an instruction for it, that;
/// elsewhere the library's, since not every platform's own is right.
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
