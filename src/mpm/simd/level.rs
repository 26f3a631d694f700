//! Processor levels, each with its register.

use super::f64x4::{F64x4, LANES};
use super::plain::{Array, Plain};

/// Token of a processor level, proof that its registers exist.
pub trait Simd: Copy {
    /// Register of this level.
    type F64x4: F64x4;

    /// Loads an array.
    fn load(self, values: [f64; LANES]) -> Self::F64x4;

    /// Copies one value to all lanes.
    fn splat(self, value: f64) -> Self::F64x4;
}

impl Simd for Plain {
    type F64x4 = Array;

    #[inline(always)]
    fn load(self, values: [f64; LANES]) -> Array {
        Array(values)
    }

    #[inline(always)]
    fn splat(self, value: f64) -> Array {
        Array([value; LANES])
    }
}

#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
macro_rules! x86 {
    ($($level:ty)+) => {
        $(
            impl Simd for $level {
                type F64x4 = fearless_simd::f64x4<Self>;

                #[inline(always)]
                fn load(self, values: [f64; LANES]) -> Self::F64x4 {
                    fearless_simd::SimdInto::simd_into(values, self)
                }

                #[inline(always)]
                fn splat(self, value: f64) -> Self::F64x4 {
                    fearless_simd::SimdInto::simd_into(value, self)
                }
            }
        )+
    };
}

#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
x86!(fearless_simd::x86::Avx2 fearless_simd::x86::Avx512);
