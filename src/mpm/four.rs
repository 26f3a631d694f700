//! Four numbers at a time: the width in which the particle-node loops work.
//!
//! The loops are written once over [`Four`] and compiled twice: over plain arrays, and over the
//! registers of AVX2 where the processor at hand has them. Both do the same IEEE operations on each
//! lane, a product and a sum and never a fused one, so the bits are the same; a test holds them to it.

use fearless_simd::{Level, SimdInto};
use std::ops::{Add, AddAssign, Mul};

/// Four numbers.
pub trait Four:
    Copy + Add<Output = Self> + AddAssign + Mul<f64, Output = Self> + Into<[f64; 4]>
{
}

impl<T> Four for T where
    T: Copy + Add<Output = T> + AddAssign + Mul<f64, Output = T> + Into<[f64; 4]>
{
}

/// What makes fours of numbers: proof that the processor can.
pub trait Width: Copy {
    /// The four numbers.
    type Four: Four;

    /// Takes them from an array.
    fn four(self, values: [f64; 4]) -> Self::Four;
}

/// Arrays, for every processor.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plain;

/// An array of four.
#[derive(Debug, Clone, Copy)]
pub(super) struct Array([f64; 4]);

impl Add for Array {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let ([a, b, c, d], [e, f, g, h]) = (self.0, other.0);
        Self([a + e, b + f, c + g, d + h])
    }
}

impl AddAssign for Array {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Mul<f64> for Array {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        let [a, b, c, d] = self.0;
        Self([a * factor, b * factor, c * factor, d * factor])
    }
}

impl From<Array> for [f64; 4] {
    #[inline(always)]
    fn from(Array(values): Array) -> Self {
        values
    }
}

impl Width for Plain {
    type Four = Array;

    #[inline(always)]
    fn four(self, values: [f64; 4]) -> Array {
        Array(values)
    }
}

#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
impl Width for fearless_simd::x86::Avx2 {
    type Four = fearless_simd::f64x4<Self>;

    #[inline(always)]
    fn four(self, values: [f64; 4]) -> Self::Four {
        values.simd_into(self)
    }
}

/// A loop over fours. Whatever it calls must be `#[inline(always)]`, or it is compiled for any
/// processor and slow.
pub(super) trait Pass {
    /// Runs it.
    fn run<W: Width>(self, width: W);
}

/// Runs `pass` in the best way that the processor has.
pub(super) fn run(pass: impl Pass) {
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    if let Some(avx2) = Level::new().as_avx2() {
        use fearless_simd::Simd as _;
        return avx2.vectorize(
            #[inline(always)]
            || pass.run(avx2),
        );
    }
    pass.run(Plain);
}
