//! Fours in the registers of x86.

use super::width::{FOUR, Four, Width};
use fearless_simd::{Select, SimdBase, SimdFloat, SimdInto, SimdMask};

/// Registers that hold four numbers, of one family of processors.
macro_rules! registers {
    ($processor:ty) => {
        impl Four for fearless_simd::f64x4<$processor> {
            #[inline(always)]
            fn floor(self) -> Self {
                SimdFloat::floor(self)
            }

            #[inline(always)]
            fn are_in(self, low: f64, high: f64) -> bool {
                // Each by itself: their conjunction is a call that the compiler does not take in.
                self.simd_ge(low).all_true() && self.simd_lt(high).all_true()
            }

            #[inline(always)]
            fn abs(self) -> Self {
                SimdBase::abs(self)
            }

            #[inline(always)]
            fn at_least(self, limit: f64) -> Self {
                self.simd_gt(limit).select(self, Self::splat(self.simd, limit))
            }

            #[inline(always)]
            fn at_most(self, limit: f64) -> Self {
                self.simd_lt(limit).select(self, Self::splat(self.simd, limit))
            }

            #[inline(always)]
            fn inverse(self) -> Self {
                Self::splat(self.simd, 1.0) / self
            }

            #[inline(always)]
            fn inverse_above(self, smallest: f64) -> Self {
                let (zero, one) = (Self::splat(self.simd, 0.0), Self::splat(self.simd, 1.0));
                self.simd_gt(smallest).select(one / self, zero)
            }
        }

        impl Width for $processor {
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
    };
}

registers!(fearless_simd::x86::Avx2);
registers!(fearless_simd::x86::Avx512);
