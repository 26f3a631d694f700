//! Number types over which formulas are evaluated: single numbers and batches.

use super::unary::Unary;
use std::ops::{Add, Div, Mul, Neg, Sub};

macro_rules! elementary {
    ($($doc:literal $name:ident $variant:ident;)*) => {
        $(
            #[doc = $doc]
            #[must_use]
            fn $name(self) -> Self {
                self.unary(Unary::$variant)
            }
        )*
    };
}

/// A number type over which formulas can be evaluated.
///
/// Inherent methods of `f64` take precedence and are not bit-identical on all platforms: call the
/// trait methods in code generic over `Number`, or as `Number::sin(x)`.
pub trait Number:
    Copy
    + PartialEq
    + From<f64>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Returns the value, without derivatives.
    fn value(&self) -> f64;

    /// Applies a function of one argument.
    #[must_use]
    fn unary(self, function: Unary) -> Self;

    /// Returns the angle of the point (`x`, `self`).
    #[must_use]
    fn atan2(self, x: Self) -> Self;

    /// Computes an integer power by repeated multiplication, also for a negative or zero base.
    #[must_use]
    fn powi(self, exponent: i32) -> Self;

    /// Computes a power. For an integer exponent without derivatives, calls [`powi`].
    ///
    /// [`powi`]: Number::powi
    #[must_use]
    fn pow(self, exponent: Self) -> Self;

    /// Returns the smaller number; `self` if both are equal, NaN if either is NaN.
    #[inline]
    #[must_use]
    fn min(self, other: Self) -> Self {
        if self.value() <= other.value() || self.value().is_nan() { self } else { other }
    }

    /// Returns the larger number; `self` if both are equal, NaN if either is NaN.
    #[inline]
    #[must_use]
    fn max(self, other: Self) -> Self {
        if self.value() >= other.value() || self.value().is_nan() { self } else { other }
    }

    elementary! {
        "Sine." sin Sin;
        "Cosine." cos Cos;
        "Tangent." tan Tan;
        "Inverse sine." asin Asin;
        "Inverse cosine." acos Acos;
        "Inverse tangent." atan Atan;
        "Hyperbolic sine." sinh Sinh;
        "Hyperbolic cosine." cosh Cosh;
        "Hyperbolic tangent." tanh Tanh;
        "Inverse hyperbolic sine." asinh Asinh;
        "Exponential." exp Exp;
        "Natural logarithm." ln Ln;
        "Square root." sqrt Sqrt;
        "Absolute value." abs Abs;
        "-1, 0 or 1." sign Sign;
        "0 for x < 0, 1 for x >= 0." step Step;
        "Largest whole number not above x." floor Floor;
        "Bessel function of the first kind, of order 0." bessel_j0 BesselJ0;
        "Bessel function of the first kind, of order 1." bessel_j1 BesselJ1;
        "Principal branch of Lambert's W, for x >= -1/e." lambert_w LambertW;
    }
}

impl Number for f64 {
    #[inline]
    fn value(&self) -> f64 {
        *self
    }

    #[inline]
    fn unary(self, function: Unary) -> Self {
        function.value(self)
    }

    fn atan2(self, x: Self) -> Self {
        libm::atan2(self, x)
    }

    #[inline]
    fn powi(self, exponent: i32) -> Self {
        let power = whole_power(self, exponent.unsigned_abs());
        if exponent < 0 { 1.0 / power } else { power }
    }

    #[inline]
    fn pow(self, exponent: Self) -> Self {
        match whole(exponent) {
            Some(exponent) => Number::powi(self, exponent),
            None => libm::pow(self, exponent),
        }
    }
}

/// Converts `exponent` to an `i32`, if its value is an integer in this range.
#[inline]
pub(super) fn whole(exponent: f64) -> Option<i32> {
    let fits = exponent % 1.0 == 0.0 && libm::fabs(exponent) <= f64::from(i32::MAX);
    fits.then_some(exponent as i32)
}

/// Computes an integer power of `base` by repeated squaring; any base to the power 0 is 1.
#[inline]
fn whole_power(mut base: f64, mut exponent: u32) -> f64 {
    let mut power = 1.0;
    loop {
        if exponent % 2 == 1 {
            power *= base;
        }
        exponent /= 2;
        if exponent == 0 {
            return power;
        }
        base *= base;
    }
}

/// One formula at several positions and times, bit-identical to evaluations in `f64`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NumberBatch([f64; NumberBatch::LEN]);

impl NumberBatch {
    /// Number of values per batch, so many that decoding an instruction costs little.
    pub const LEN: usize = 8;

    /// Creates a batch; `number` returns the value of each lane.
    #[inline]
    pub fn new(mut number: impl FnMut(usize) -> f64) -> Self {
        let mut batch = [0.0; Self::LEN];
        for lane in 0..Self::LEN {
            batch[lane] = number(lane);
        }
        Self(batch)
    }

    /// Returns the value of one lane.
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
        Self([value; Self::LEN])
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
    /// Returns the value of the first lane: formulas branch only on the index of a sum, which is
    /// equal in all lanes.
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
