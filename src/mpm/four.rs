//! Four numbers at a time: the width in which the particle-node loops work.
//!
//! The loops are written once over [`Four`] and compiled twice: over plain arrays, and over the
//! registers of AVX2 where the processor at hand has them. Both do the same IEEE operations on each
//! lane, a product and a sum and never a fused one, so the bits are the same; a test holds them to it.

use super::{algebra::array, grid::floor};
use fearless_simd::{Level, SimdInto};
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
use fearless_simd::{Select, SimdBase, SimdFloat, SimdMask};
use std::ops::{Add, AddAssign, Mul, Range, Sub};

/// Numbers in a register.
pub(super) const FOUR: usize = 4;

/// Particles whose weights are computed before the nodes of the first are seen: so many that what is
/// done once for all of them costs little, so few that their weights stay near.
pub(super) const LANES: usize = 16;

/// Registers for as many.
const PARTS: usize = LANES / FOUR;

/// A number for each of so many particles.
#[derive(Debug, Clone, Copy)]
#[repr(align(32))]
pub(super) struct Lanes(pub(super) [f64; LANES]);

impl Lanes {
    /// All zero.
    pub(super) const ZERO: Self = Self([0.0; LANES]);

    /// One of them.
    #[inline(always)]
    pub(super) fn get(&self, lane: usize) -> f64 {
        // The remainder proves to the compiler what callers keep to.
        debug_assert!(lane < LANES);
        self.0[lane % LANES]
    }

    /// Four of them.
    #[inline(always)]
    pub(super) fn four<W: Width>(&self, width: W, part: usize) -> W::Four {
        width.four(array(0.0, |lane| self.0[part % PARTS * FOUR + lane]))
    }

    /// Puts four of them.
    #[inline(always)]
    pub(super) fn put<F: Four>(&mut self, part: usize, four: F) {
        self.0[part % PARTS * FOUR..][..FOUR].copy_from_slice(&four.into());
    }
}

/// The parts in which these lanes are.
#[inline(always)]
pub(super) fn parts(lanes: &Range<usize>) -> Range<usize> {
    lanes.start / FOUR..lanes.end.div_ceil(FOUR)
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

/// Arrays, for every processor.
#[derive(Debug, Clone, Copy)]
pub(super) struct Plain;

/// An array of four.
#[derive(Debug, Clone, Copy)]
pub(super) struct Array([f64; FOUR]);

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

impl From<Array> for [f64; FOUR] {
    #[inline(always)]
    fn from(Array(values): Array) -> Self {
        values
    }
}

impl Four for Array {
    #[inline(always)]
    fn floor(self) -> Self {
        self.map(floor)
    }

    #[inline(always)]
    fn are_in(self, low: f64, high: f64) -> bool {
        self.0.iter().all(|&x| x >= low && x < high)
    }

    #[inline(always)]
    fn inverse_above(self, smallest: f64) -> Self {
        self.map(|x| if x > smallest { 1.0 / x } else { 0.0 })
    }
}

impl Width for Plain {
    type Four = Array;

    #[inline(always)]
    fn four(self, values: [f64; FOUR]) -> Array {
        Array(values)
    }

    #[inline(always)]
    fn all(self, value: f64) -> Array {
        Array([value; FOUR])
    }
}

#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
impl Four for fearless_simd::f64x4<fearless_simd::x86::Avx2> {
    #[inline(always)]
    fn floor(self) -> Self {
        SimdFloat::floor(self)
    }

    #[inline(always)]
    fn are_in(self, low: f64, high: f64) -> bool {
        (self.simd_ge(low) & self.simd_lt(high)).all_true()
    }

    #[inline(always)]
    fn inverse_above(self, smallest: f64) -> Self {
        let (zero, one) = (Self::splat(self.simd, 0.0), Self::splat(self.simd, 1.0));
        self.simd_gt(smallest).select(one / self, zero)
    }
}

#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
impl Width for fearless_simd::x86::Avx2 {
    type Four = fearless_simd::f64x4<Self>;

    #[inline(always)]
    fn four(self, values: [f64; FOUR]) -> Self::Four {
        values.simd_into(self)
    }

    #[inline(always)]
    fn all(self, value: f64) -> Self::Four {
        value.simd_into(self)
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
