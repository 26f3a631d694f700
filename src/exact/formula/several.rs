//! Some numbers side by side.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::number::Number;
use super::unary::Unary;

/// So many numbers: enough that reading an instruction costs little beside what it does with them.
const MANY: usize = 8;

/// The values of one formula at some places and times. A formula that is evaluated over them reads
/// each of its instructions once for all, and the compiler does sums and products two at a time or
/// more. The operations on each number, and so its bits, are those of `f64`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NumberBatch([f64; MANY]);

impl NumberBatch {
    /// How many.
    pub const LEN: usize = MANY;

    /// Takes the number of each lane from `number`.
    #[inline]
    pub fn new(number: impl FnMut(usize) -> f64) -> Self {
        Self(std::array::from_fn(number))
    }

    /// The number of one lane.
    ///
    /// # Panics
    /// If `lane` is not below [`NumberBatch::LEN`].
    #[inline]
    pub fn get(&self, lane: usize) -> f64 {
        self.0[lane]
    }

    #[inline]
    fn zip(self, other: Self, both: impl Fn(f64, f64) -> f64) -> Self {
        Self::new(|lane| both(self.0[lane], other.0[lane]))
    }
}

impl From<f64> for NumberBatch {
    #[inline]
    fn from(value: f64) -> Self {
        Self([value; MANY])
    }
}

impl Neg for NumberBatch {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self(self.0.map(|a| -a))
    }
}

impl Add for NumberBatch {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
}

impl Sub for NumberBatch {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
}

impl Mul for NumberBatch {
    type Output = Self;

    #[inline]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }
}

impl Div for NumberBatch {
    type Output = Self;

    #[inline]
    fn div(self, other: Self) -> Self {
        self.zip(other, |a, b| a / b)
    }
}

impl Number for NumberBatch {
    /// That of the first lane: what formulas branch on, the index of a sum, is the same in all.
    #[inline]
    fn value(&self) -> f64 {
        self.0[0]
    }

    fn unary(self, function: Unary) -> Self {
        Self(self.0.map(|a| function.value(a)))
    }

    fn atan2(self, x: Self) -> Self {
        self.zip(x, Number::atan2)
    }

    #[inline]
    fn powi(self, exponent: i32) -> Self {
        Self(self.0.map(|a| Number::powi(a, exponent)))
    }

    fn pow(self, exponent: Self) -> Self {
        self.zip(exponent, Number::pow)
    }

    #[inline]
    fn min(self, other: Self) -> Self {
        self.zip(other, Number::min)
    }

    #[inline]
    fn max(self, other: Self) -> Self {
        self.zip(other, Number::max)
    }
}
