//! Registers of x86.

use super::register::{F64x4, Register};
use fearless_simd::{Select, SimdBase, SimdFloat, SimdMask};

/// Implements [`Register`].
macro_rules! sums {
    ($register:ty) => {
        impl Register for $register {
            #[inline(always)]
            fn plus_product(self, a: Self, b: f64) -> Self {
                a.mul_add_precise(Self::splat(self.simd, b), self)
            }
        }
    };
}

/// Implements [`F64x4`] for the 256-bit registers of a processor level.
macro_rules! registers {
    ($processor:ty) => {
        sums!(fearless_simd::f64x4<$processor>);

        impl F64x4 for fearless_simd::f64x4<$processor> {
            #[inline(always)]
            fn floor(self) -> Self {
                SimdFloat::floor(self)
            }

            #[inline(always)]
            fn are_in(self, low: f64, high: f64) -> bool {
                // Not the conjunction of the masks: that is a call which is not inlined.
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
    };
}

registers!(fearless_simd::x86::Avx2);
registers!(fearless_simd::x86::Avx512);
sums!(fearless_simd::f64x8<fearless_simd::x86::Avx512>);
