//! Automatic differentiation of first and second order.

use std::ops::{Add, Div, Mul, Neg, Sub};

use super::number::{Number, whole};
use super::unary::Unary;

/// A value with its first and second derivatives with respect to `N` variables, such as the
/// coordinates and the time.
///
/// The chain rule is applied exactly, without differences. `max`, `min`, `abs`, `sign`, `step` and
/// `floor` are differentiated on the selected branch, as if there were no kink or jump. Other
/// undefined derivatives, such as the derivative of `sqrt` at 0, are infinite or NaN.
pub type Jet<const N: usize> = Dual<N, [[f64; N]; N]>;

/// A value with its first derivatives along `N` directions, at a third of the cost of a [`Jet`].
///
/// Results are bit-identical to a jet, except that zero times an infinite derivative is NaN.
pub type Slope<const N: usize> = Dual<N, ()>;

/// A value with its first derivatives, and second derivatives of the type `H`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dual<const N: usize, H> {
    value: f64,
    gradient: [f64; N],
    hessian: H,
}

/// Second derivatives with respect to `N` variables, or `()` if they are not computed.
pub trait Hessian<const N: usize>: Copy + PartialEq {
    /// Whether second derivatives are computed.
    const IS_KNOWN: bool;

    /// Stores the derivatives that `second` returns for two variables; `second` is symmetric.
    fn build(second: impl Fn(usize, usize) -> f64) -> Self;

    /// Returns the derivative with respect to the variables `i` and `j`; 0 if it is not computed.
    fn at(&self, i: usize, j: usize) -> f64;
}

impl<const N: usize> Hessian<N> for [[f64; N]; N] {
    const IS_KNOWN: bool = true;

    #[inline]
    fn build(second: impl Fn(usize, usize) -> f64) -> Self {
        let mut hessian = [[0.0; N]; N];
        for i in 0..N {
            for j in 0..=i {
                let second = second(i, j);
                (hessian[i][j], hessian[j][i]) = (second, second);
            }
        }
        hessian
    }

    #[inline]
    fn at(&self, i: usize, j: usize) -> f64 {
        self[i][j]
    }
}

impl<const N: usize> Hessian<N> for () {
    const IS_KNOWN: bool = false;

    #[inline]
    fn build(_: impl Fn(usize, usize) -> f64) -> Self {}

    #[inline]
    fn at(&self, _: usize, _: usize) -> f64 {
        0.0
    }
}

impl<const N: usize> Jet<N> {
    /// Returns the second derivative with respect to the variables `i` and `j`.
    #[inline]
    pub fn dd(&self, i: usize, j: usize) -> f64 {
        self.hessian[i][j]
    }
}

impl<const N: usize> Slope<N> {
    /// Creates a value with the given `gradient`.
    #[inline]
    pub fn new(value: f64, gradient: [f64; N]) -> Self {
        Self { value, gradient, hessian: () }
    }
}

impl<const N: usize, H: Hessian<N>> Dual<N, H> {
    /// Creates the variable with this `index` and `value`.
    #[inline]
    pub fn variable(value: f64, index: usize) -> Self {
        let mut variable = Self::from(value);
        variable.gradient[index] = 1.0;
        variable
    }

    /// Creates a variable for each coordinate of `label`; missing coordinates are zero.
    pub(crate) fn place(label: &[f64]) -> [Self; N] {
        let coordinate = |axis: usize| label.get(axis).copied().unwrap_or(0.0);
        std::array::from_fn(|axis| Self::variable(coordinate(axis), axis))
    }

    /// Returns the value, without derivatives.
    #[inline]
    pub fn value(&self) -> f64 {
        self.value
    }

    /// Returns the first derivative with respect to the variable `i`.
    #[inline]
    pub fn d(&self, i: usize) -> f64 {
        self.gradient[i]
    }

    /// Combines a value and functions for its derivatives; `second` must be symmetric.
    #[inline]
    fn build(
        value: f64,
        first: impl Fn(usize) -> f64,
        second: impl Fn(usize, usize) -> f64,
    ) -> Self {
        let mut gradient = [0.0; N];
        for i in 0..N {
            gradient[i] = first(i);
        }
        Self { value, gradient, hessian: H::build(second) }
    }

    /// Applies the chain rule for a function with the derivatives `f1` and `f2` at `self`.
    #[inline]
    fn chain(&self, value: f64, f1: f64, f2: impl FnOnce() -> f64) -> Self {
        let f2 = if H::IS_KNOWN { f2() } else { 0.0 };
        let dual = Self::build(
            value,
            |i| f1 * self.gradient[i],
            |i, j| f2 * (self.gradient[i] * self.gradient[j]) + f1 * self.hessian.at(i, j),
        );
        let is_finite = f1.is_finite() && f2.is_finite();
        if is_finite || !H::IS_KNOWN { dual } else { dual.flattened(|i| self.is_flat(i)) }
    }

    fn is_flat(&self, i: usize) -> bool {
        self.gradient[i] == 0.0 && (0..N).all(|j| self.hessian.at(i, j) == 0.0)
    }

    /// Clears the derivatives of variables on which the argument does not depend (`flat`). They
    /// would be NaN (infinity times 0) if the function has an infinite derivative.
    fn flattened(&self, flat: impl Fn(usize) -> bool) -> Self {
        Self::build(
            self.value,
            |i| if flat(i) { 0.0 } else { self.gradient[i] },
            |i, j| if flat(i) || flat(j) { 0.0 } else { self.hessian.at(i, j) },
        )
    }
}

impl<const N: usize, H: Hessian<N>> From<f64> for Dual<N, H> {
    #[inline]
    fn from(value: f64) -> Self {
        Self { value, gradient: [0.0; N], hessian: H::build(|_, _| 0.0) }
    }
}

impl<const N: usize, H: Hessian<N>> Neg for Dual<N, H> {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        Self::build(-self.value, |i| -self.gradient[i], |i, j| -self.hessian.at(i, j))
    }
}

impl<const N: usize, H: Hessian<N>> Add for Dual<N, H> {
    type Output = Self;

    #[inline]
    fn add(self, b: Self) -> Self {
        Self::build(
            self.value + b.value,
            |i| self.gradient[i] + b.gradient[i],
            |i, j| self.hessian.at(i, j) + b.hessian.at(i, j),
        )
    }
}

impl<const N: usize, H: Hessian<N>> Sub for Dual<N, H> {
    type Output = Self;

    #[inline]
    fn sub(self, b: Self) -> Self {
        Self::build(
            self.value - b.value,
            |i| self.gradient[i] - b.gradient[i],
            |i, j| self.hessian.at(i, j) - b.hessian.at(i, j),
        )
    }
}

#[allow(clippy::suspicious_arithmetic_impl)]
impl<const N: usize, H: Hessian<N>> Mul for Dual<N, H> {
    type Output = Self;

    #[inline]
    fn mul(self, b: Self) -> Self {
        Self::build(
            self.value * b.value,
            |i| self.value * b.gradient[i] + b.value * self.gradient[i],
            |i, j| {
                let mixed = self.gradient[i] * b.gradient[j] + self.gradient[j] * b.gradient[i];
                self.value * b.hessian.at(i, j) + b.value * self.hessian.at(i, j) + mixed
            },
        )
    }
}

#[allow(clippy::suspicious_arithmetic_impl)]
impl<const N: usize, H: Hessian<N>> Div for Dual<N, H> {
    type Output = Self;

    /// The quotient q satisfies q*b = a. This equation is differentiated and solved for q' and q''.
    /// A tiny quotient far from a pulse such as `1/cosh(x)^2` counts as constant.
    #[inline]
    fn div(self, b: Self) -> Self {
        let value = self.value / b.value;
        // Derivatives would be computed as infinity divided by infinity.
        if b.value.abs() > 1.0 / TINY && value.abs() < TINY {
            return Self::from(value);
        }
        let mut gradient = [0.0; N];
        for i in 0..N {
            gradient[i] = (self.gradient[i] - value * b.gradient[i]) / b.value;
        }
        Self::build(
            value,
            |i| gradient[i],
            |i, j| {
                let mixed = gradient[i] * b.gradient[j] + gradient[j] * b.gradient[i];
                (self.hessian.at(i, j) - value * b.hessian.at(i, j) - mixed) / b.value
            },
        )
    }
}

impl<const N: usize, H: Hessian<N>> Number for Dual<N, H> {
    #[inline]
    fn value(&self) -> f64 {
        self.value
    }

    #[inline]
    fn unary(self, function: Unary) -> Self {
        let value = function.value(self.value);
        let (first, second) = function.derivatives(self.value, value);
        self.chain(value, first, || second)
    }

    fn atan2(self, x: Self) -> Self {
        // Derivatives are those of atan(y/x), or of -atan(x/y) if that is numerically safer.
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
        // For x^0 and x^1, the general rule would give 0 times infinity at x = 0.
        let first = if exponent == 0 { 0.0 } else { n * power(self.value, n - 1.0) };
        self.chain(value, first, || match exponent {
            0 | 1 => 0.0,
            _ => n * (n - 1.0) * power(self.value, n - 2.0),
        })
    }

    fn pow(self, exponent: Self) -> Self {
        let (a, b) = (self.value, exponent.value);
        if (0..N).all(|i| exponent.is_flat(i)) {
            if let Some(exponent) = whole(b) {
                return self.powi(exponent);
            }
            let first = b * power(a, b - 1.0);
            return self.chain(power(a, b), first, || b * (b - 1.0) * power(a, b - 2.0));
        }
        // a^b = exp(b*ln(a)); every derivative of the exponential equals its value.
        let value = power(a, b);
        (exponent * self.unary(Unary::Ln)).chain(value, value, || value)
    }
}

/// Quotients below this magnitude count as constant if their derivatives could overflow.
const TINY: f64 = 1e-140;

/// Computes a power over `f64`, so the value of a jet is bit-identical to a plain evaluation.
fn power(base: f64, exponent: f64) -> f64 {
    Number::pow(base, exponent)
}
