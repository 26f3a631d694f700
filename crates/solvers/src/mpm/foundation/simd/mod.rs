//! Registers of four and eight `f64`. The loops over particles and nodes are written once with
//! [`F64x4`] and [`Register`], and compiled for plain arrays, AVX2, and AVX-512. AVX-512 is used
//! for loops with registers of eight, or if 16 registers are too few.
//!
//! ```text
//! particles   0  1  2  3 | 4  5  6  7 | 8  9 10 11 | 12 13 14 15     one F64Batch: BATCH = 16
//! registers       0      |     1      |     2      |      3          F64x4 each:  LANES = 4
//!
//! weights:    one lane for each particle, so that four are computed at once
//! nodes:      one lane for each component of a node (packed_grid), one particle after another;
//!             nodes of eight numbers are two registers of AVX2 or one of AVX-512
//! ```
//!
//! Each lane performs the same IEEE operations at every level. Products and sums are fused only
//! where the source requests it, so results are bit-identical on every processor.

mod register;
use super::algebra::{Vector, array, zeros};
use fearless_simd::{Level, Select, SimdBase, SimdFloat, SimdMask};
use register::{Array, Pair};
pub(in crate::mpm) use register::{F64x4, LANES, Plain, Register};
use std::ops::Range;
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
use std::sync::LazyLock;

/// A loop that can be compiled for several kinds of registers. All functions called by the loop
/// must be `#[inline(always)]`. Other functions are compiled for the baseline processor.
pub trait SimdPass: Sized {
    /// Whether the loop is faster with AVX-512. AVX-512 has 32 registers instead of 16, and they
    /// are twice as wide as those of AVX2.
    const NEEDS_AVX512: bool;

    /// Runs the loop.
    fn run<S: Simd>(self, simd: S);

    /// Runs the loop on an x86 processor without AVX2. Such processors are rare, so the loop is
    /// compiled for all bases at once.
    fn run_plain(self);
}

/// Runs `pass` at `level`. [`Basis::run`](crate::mpm::Basis::run) describes where the loop is
/// compiled.
#[inline(always)]
pub(in crate::mpm) fn run<P: SimdPass>(level: Level, pass: P) {
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    {
        use fearless_simd::Simd as _;
        if const { P::NEEDS_AVX512 }
            && let Some(avx512) = level.as_avx512()
        {
            return avx512.vectorize(
                #[inline(always)]
                || pass.run(avx512),
            );
        }
        if let Some(avx2) = level.as_avx2() {
            return avx2.vectorize(
                #[inline(always)]
                || pass.run(avx2),
            );
        }
        pass.run_plain();
    }
    #[cfg(not(any(target_arch = "x86", target_arch = "x86_64")))]
    {
        let _ = level;
        pass.run(Plain);
    }
}

#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
static LEVEL: LazyLock<Level> = LazyLock::new(Level::new);

/// Runs `loops`, compiled for AVX2 if the processor supports it. The closure and all functions that
/// it calls must be `#[inline(always)]`.
#[inline(always)]
pub(in crate::mpm) fn vectorized<R>(loops: impl FnOnce() -> R) -> R {
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    {
        use fearless_simd::Simd as _;
        if let Some(avx2) = LEVEL.as_avx2() {
            return avx2.vectorize(loops);
        }
    }
    loops()
}

/// Token of a processor level: proof that its registers are available.
pub trait Simd: Copy {
    /// Register of four numbers.
    type F64x4: F64x4;
    /// Register of eight numbers, or a pair of registers of four.
    type F64x8: Register + Into<[f64; 2 * LANES]>;

    /// Loads four numbers.
    fn load(self, values: [f64; LANES]) -> Self::F64x4;

    /// Loads eight numbers.
    fn load_eight(self, values: [f64; 2 * LANES]) -> Self::F64x8;

    /// Copies one value to all lanes.
    fn splat(self, value: f64) -> Self::F64x4;

    /// Joins two registers of four numbers.
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

/// Implements the part of [`Simd`] for registers of four numbers, which is identical at both x86
/// levels.
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

/// Number of particles in a batch. All weights of a batch are computed before any of its nodes is
/// visited. The batch is large enough to amortise its set-up, and small enough to keep the weights
/// in the L1 cache.
pub(in crate::mpm) const BATCH: usize = 16;

const REGISTERS: usize = BATCH / LANES;

/// One number for each particle of a batch.
#[derive(Debug, Clone, Copy)]
#[repr(align(32))]
pub(in crate::mpm) struct F64Batch(pub(in crate::mpm) [f64; BATCH]);

impl F64Batch {
    pub(in crate::mpm) const ZERO: Self = Self([0.0; BATCH]);

    #[inline(always)]
    pub(in crate::mpm) fn get(&self, lane: usize) -> f64 {
        // `lane` is below BATCH. The remainder only avoids a bounds check.
        self.0[lane % BATCH]
    }

    #[inline(always)]
    pub(in crate::mpm) fn load<S: Simd>(&self, simd: S, register: usize) -> S::F64x4 {
        simd.load(array(0.0, |lane| self.0[register % REGISTERS * LANES + lane]))
    }

    #[inline(always)]
    pub(in crate::mpm) fn store<F: F64x4>(&mut self, register: usize, values: F) {
        if let Some(four) = self.0[register % REGISTERS * LANES..].first_chunk_mut() {
            *four = values.into();
        }
    }
}

#[inline(always)]
pub(in crate::mpm) fn registers_of(lanes: &Range<usize>) -> Range<usize> {
    lanes.start / LANES..lanes.end.div_ceil(LANES)
}

#[inline(always)]
pub(in crate::mpm) fn components<const D: usize>(
    register: impl Into<[f64; LANES]>,
    first: usize,
) -> Vector<D> {
    let lanes = register.into();
    let mut vector = zeros();
    for axis in 0..D {
        vector[axis] = lanes[(first + axis) % LANES];
    }
    vector
}

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
                // Each comparison is checked separately, because a combined check would not be
                // inlined.
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

/// Leading 32 bits of sqrt(1/2). The logarithm splits a number into `2^k` and a factor from
/// sqrt(1/2) to sqrt(2).
const ROOT_OF_HALF: u64 = 0x3fe6_a09e << 32;
const ONE: u64 = 0x3ff0_0000 << 32;
const MANTISSA: u64 = (1 << 52) - 1;
/// Bits of 2^52. The last bit of the mantissa of this number has the value one, so an integer in
/// the mantissa is added to 2^52.
const COUNTING: u64 = 0x4330_0000 << 32;

const LN2_HIGH: f64 = 6.931_471_803_691_238e-1;
const LN2_LOW: f64 = 1.908_214_929_270_587_7e-10;
const LG1: f64 = 6.666_666_666_666_735e-1;
const LG2: f64 = 3.999_999_999_940_942e-1;
const LG3: f64 = 2.857_142_874_366_239e-1;
const LG4: f64 = 2.222_219_843_214_978_4e-1;
const LG5: f64 = 1.818_357_216_161_805e-1;
const LG6: f64 = 1.531_383_769_920_937_3e-1;
const LG7: f64 = 1.479_819_860_511_658_6e-1;

/// Computes `ln x` of each number, bit-identical to `libm::log`.
#[inline(always)]
#[allow(
    clippy::manual_range_contains,
    clippy::needless_bitwise_bool,
    reason = "a lazy operator is a branch"
)]
pub(in crate::mpm) fn ln(x: &F64Batch) -> F64Batch {
    let mut result = F64Batch::ZERO;
    let mut all_normal = true;
    for lane in 0..BATCH {
        let x = x.0[lane];
        all_normal &= (x >= f64::MIN_POSITIVE) & (x <= f64::MAX);
        result.0[lane] = ln_of_normal(x);
    }
    if all_normal { result } else { one_by_one(x) }
}

#[inline(always)]
fn ln_of_normal(x: f64) -> f64 {
    let shifted = x.to_bits().wrapping_add(ONE - ROOT_OF_HALF);
    let k = f64::from_bits(shifted >> 52 | COUNTING) - (f64::from_bits(COUNTING) + 1023.0);
    let f = f64::from_bits((shifted & MANTISSA).wrapping_add(ROOT_OF_HALF)) - 1.0;
    let half_square = 0.5 * f * f;
    let s = f / (2.0 + f);
    let z = s * s;
    let w = z * z;
    let even = w * (LG2 + w * (LG4 + w * LG6));
    let odd = z * (LG1 + w * (LG3 + w * (LG5 + w * LG7)));
    s * (half_square + (odd + even)) + k * LN2_LOW - half_square + f + k * LN2_HIGH
}

/// Computes `ln x` lane by lane, for batches with a number that is zero, negative, subnormal or not
/// finite.
#[cold]
#[inline(never)]
fn one_by_one(x: &F64Batch) -> F64Batch {
    F64Batch(x.0.map(libm::log))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn holds(numbers: [f64; BATCH]) {
        let found = ln(&F64Batch(numbers)).0.map(f64::to_bits);
        assert_eq!(found, numbers.map(|x| libm::log(x).to_bits()), "{numbers:?}");
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        #[test]
        fn logarithms_are_bit_identical_to_the_library(bits in any::<[u64; BATCH]>()) {
            // All numbers of each batch are positive and normal, so that the fast path is used.
            holds(bits.map(|bits| f64::from_bits(bits % (0x7fe << 52) + (1 << 52))));
        }

        #[test]
        fn logarithms_near_one_are_bit_identical_to_the_library(
            x in proptest::array::uniform16(0.5_f64..2.0),
        ) {
            holds(x);
        }
    }

    #[test]
    fn logarithms_of_extremes_are_bit_identical_to_the_library() {
        let bounds = [f64::MIN_POSITIVE, f64::MAX, f64::INFINITY, f64::NAN];
        let near_root_of_half = [ROOT_OF_HALF, ROOT_OF_HALF - 1].map(f64::from_bits);
        for x in [&[0.0, -0.0, -1.0, 1e-310, 1.0][..], &bounds, &near_root_of_half].concat() {
            let mut numbers = [1.5; BATCH];
            numbers[5] = x;
            holds(numbers);
            holds([x; BATCH]);
        }
    }
}
