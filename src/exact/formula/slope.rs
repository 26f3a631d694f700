//! First-order automatic differentiation.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::jet::{TINY, is_overflow};
use super::number::{Number, whole};
use super::unary::Unary;

/// A value with its first derivatives along `N` directions: a [`Jet`](super::Jet) without second
/// derivatives, at a third of the cost.
///
/// Results are bit-identical to those of a jet, with one exception: if the derivative of a function
/// is infinite, a gradient component of zero becomes NaN.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slope<const N: usize> {
    value: f64,
    gradient: [f64; N],
}

impl<const N: usize> Slope<N> {
    /// Creates a value with the given `gradient`.
    #[inline]
    pub fn new(value: f64, gradient: [f64; N]) -> Self {
        Self { value, gradient }
    }

    /// Creates the variable with this `index` and `value`.
    ///
    /// # Panics
    /// If `index` is not below `N`.
    #[inline]
    pub fn variable(value: f64, index: usize) -> Self {
        let mut slope = Self::from(value);
        slope.gradient[index] = 1.0;
        slope
    }

    /// Returns the derivative along the direction `i`.
    ///
    /// # Panics
    /// If `i` is not below `N`.
    #[inline]
    pub fn d(&self, i: usize) -> f64 {
        self.gradient[i]
    }

    #[inline]
    fn build(value: f64, first: impl Fn(usize) -> f64) -> Self {
        let mut slope = Self::from(value);
        for i in 0..N {
            slope.gradient[i] = first(i);
        }
        slope
    }

    #[inline]
    fn chain(&self, value: f64, f1: f64) -> Self {
        Self::build(value, |i| f1 * self.gradient[i])
    }
}

impl<const N: usize> From<f64> for Slope<N> {
    #[inline]
    fn from(value: f64) -> Self {
        Self { value, gradient: [0.0; N] }
    }
}

impl<const N: usize> Neg for Slope<N> {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self::build(-self.value, |i| -self.gradient[i])
    }
}

impl<const N: usize> Add for Slope<N> {
    type Output = Self;

    #[inline]
    fn add(self, b: Self) -> Self {
        Self::build(self.value + b.value, |i| self.gradient[i] + b.gradient[i])
    }
}

impl<const N: usize> Sub for Slope<N> {
    type Output = Self;

    #[inline]
    fn sub(self, b: Self) -> Self {
        Self::build(self.value - b.value, |i| self.gradient[i] - b.gradient[i])
    }
}

#[allow(clippy::suspicious_arithmetic_impl)]
impl<const N: usize> Mul for Slope<N> {
    type Output = Self;

    #[inline]
    fn mul(self, b: Self) -> Self {
        let slope = |i: usize| self.value * b.gradient[i] + b.value * self.gradient[i];
        Self::build(self.value * b.value, slope)
    }
}

#[allow(clippy::suspicious_arithmetic_impl)]
impl<const N: usize> Div for Slope<N> {
    type Output = Self;

    #[inline]
    fn div(self, b: Self) -> Self {
        let value = self.value / b.value;
        if is_overflow(b.value, value) {
            return Self::from(value);
        }
        Self::build(value, |i| (self.gradient[i] - value * b.gradient[i]) / b.value)
    }
}

impl<const N: usize> Number for Slope<N> {
    #[inline]
    fn value(&self) -> f64 {
        self.value
    }

    #[inline]
    fn unary(self, function: Unary) -> Self {
        let value = function.value(self.value);
        let (first, _) = function.derivatives(self.value, value);
        self.chain(value, first)
    }

    fn atan2(self, x: Self) -> Self {
        // The derivatives are computed as those of atan(y/x), or of -atan(x/y) if that is
        // numerically safer.
        let quotient = if libm::fabs(x.value) >= libm::fabs(self.value) {
            (self / x).unary(Unary::Atan)
        } else {
            -(x / self).unary(Unary::Atan)
        };
        Self { value: libm::atan2(self.value, x.value), ..quotient }
    }

    #[inline]
    fn powi(self, exponent: i32) -> Self {
        let n = f64::from(exponent);
        let value = Number::powi(self.value, exponent);
        if exponent < 0 && value.abs() < TINY {
            return Self::from(value);
        }
        let first = if exponent == 0 { 0.0 } else { n * Number::pow(self.value, n - 1.0) };
        self.chain(value, first)
    }

    fn pow(self, exponent: Self) -> Self {
        let (a, b) = (self.value, exponent.value);
        if exponent.gradient.iter().all(|&slope| slope == 0.0) {
            if let Some(exponent) = whole(b) {
                return self.powi(exponent);
            }
            return self.chain(Number::pow(a, b), b * Number::pow(a, b - 1.0));
        }
        // a^b = exp(b*ln(a)); the derivative of the exponential equals its value.
        let value = Number::pow(a, b);
        (exponent * self.unary(Unary::Ln)).chain(value, value)
    }
}
