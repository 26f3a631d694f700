//! Processor levels, each with its registers.

use super::f64x4::F64x4;
use super::plain::{Array, Plain};
use super::register::{LANES, Pair, Register};

/// Token of a processor level, proof that its registers exist.
pub trait Simd: Copy {
    /// Register of four numbers.
    type F64x4: F64x4;
    /// Register of eight, or two of four.
    type F64x8: Register + Into<[f64; 2 * LANES]>;

    /// Loads an array.
    fn load(self, values: [f64; LANES]) -> Self::F64x4;

    /// Loads an array.
    fn load_eight(self, values: [f64; 2 * LANES]) -> Self::F64x8;

    /// Copies one value to all lanes.
    fn splat(self, value: f64) -> Self::F64x4;

    /// Eight numbers, four and four.
    fn join(self, low: Self::F64x4, high: Self::F64x4) -> Self::F64x8;
}

impl Simd for Plain {
    type F64x4 = Array;
    type F64x8 = Pair<Array>;

    #[inline(always)]
    fn load(self, values: [f64; LANES]) -> Array {
        Array(values)
    }

    #[inline(always)]
    fn load_eight(self, [a, b, c, d, e, f, g, h]: [f64; 2 * LANES]) -> Pair<Array> {
        Pair(Array([a, b, c, d]), Array([e, f, g, h]))
    }

    #[inline(always)]
    fn splat(self, value: f64) -> Array {
        Array([value; LANES])
    }

    #[inline(always)]
    fn join(self, low: Array, high: Array) -> Pair<Array> {
        Pair(low, high)
    }
}

/// Registers of four, the same at both levels of x86.
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
macro_rules! four {
    () => {
        type F64x4 = fearless_simd::f64x4<Self>;

        #[inline(always)]
        fn load(self, values: [f64; LANES]) -> Self::F64x4 {
            fearless_simd::SimdInto::simd_into(values, self)
        }

        #[inline(always)]
        fn splat(self, value: f64) -> Self::F64x4 {
            fearless_simd::SimdInto::simd_into(value, self)
        }
    };
}

#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
impl Simd for fearless_simd::x86::Avx2 {
    four!();

    type F64x8 = Pair<Self::F64x4>;

    #[inline(always)]
    fn load_eight(self, [a, b, c, d, e, f, g, h]: [f64; 2 * LANES]) -> Self::F64x8 {
        Pair(self.load([a, b, c, d]), self.load([e, f, g, h]))
    }

    #[inline(always)]
    fn join(self, low: Self::F64x4, high: Self::F64x4) -> Self::F64x8 {
        Pair(low, high)
    }
}

#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
impl Simd for fearless_simd::x86::Avx512 {
    four!();

    type F64x8 = fearless_simd::f64x8<Self>;

    #[inline(always)]
    fn load_eight(self, values: [f64; 2 * LANES]) -> Self::F64x8 {
        fearless_simd::SimdInto::simd_into(values, self)
    }

    #[inline(always)]
    fn join(self, low: Self::F64x4, high: Self::F64x4) -> Self::F64x8 {
        fearless_simd::Simd::combine_f64x4(self, low, high)
    }
}
