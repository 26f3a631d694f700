//! Registers of four and of eight `f64`: the loops over particles and nodes are written once over
//! [`F64x4`] and [`Register`], and compiled for plain arrays, AVX2, and AVX-512 (where registers of
//! eight are used, or 16 registers are too few).
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
//! Each lane does the same IEEE operations at every level. Products and sums are fused only where
//! the source requests it, so that results have the same bits on every processor (tested in
//! `tests/it/mpm/kernel`).
//!
//! Processor levels, each with its registers.
//!
//! Columns of one batch of particles in memory.

mod logarithm;
mod register;
use super::algebra::{Vector, array};
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
use fearless_simd::{Level, Select, SimdBase, SimdFloat, SimdMask};
pub(in crate::mpm) use logarithm::ln;
use register::{Array, Pair};
pub(in crate::mpm) use register::{F64x4, LANES, Plain, Register};
use std::ops::Range;
use std::sync::LazyLock;
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]

/// Loop over registers. All functions that it calls must be `#[inline(always)]`: other functions
/// are compiled for the baseline processor.
pub trait SimdPass: Sized {
    /// Whether the loop runs faster with the registers of AVX-512, 32 in place of 16 and twice as
    /// wide.
    const NEEDS_AVX512: bool;

    /// Runs the loop.
    fn run<S: Simd>(self, simd: S);
}

/// Runs `pass` at `level`; see [`Basis::run`](crate::mpm::Basis::run) for where it is compiled.
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
    }
    let _ = level;
    pass.run(Plain);
}

/// The best level of this processor.
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
static LEVEL: LazyLock<Level> = LazyLock::new(Level::new);

/// Runs `loops` without explicit registers, compiled for AVX2 if the processor has it. The closure
/// and all functions that it calls must be `#[inline(always)]`.
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

/// Particles of a batch, whose weights are computed before any of their nodes is visited: enough
/// to spread the set-up of a batch, few enough that the weights stay in the nearest cache.
pub(in crate::mpm) const BATCH: usize = 16;

/// Registers of a batch.
const REGISTERS: usize = BATCH / LANES;

/// One number for each particle of a batch.
#[derive(Debug, Clone, Copy)]
#[repr(align(32))]
pub(in crate::mpm) struct F64Batch(pub(in crate::mpm) [f64; BATCH]);

impl F64Batch {
    /// All zero.
    pub(in crate::mpm) const ZERO: Self = Self([0.0; BATCH]);

    /// The number of particle `lane` of the batch.
    #[inline(always)]
    pub(in crate::mpm) fn get(&self, lane: usize) -> f64 {
        // The remainder saves the bounds check: lanes are below BATCH.
        self.0[lane % BATCH]
    }

    /// Loads a register.
    #[inline(always)]
    pub(in crate::mpm) fn load<S: Simd>(&self, simd: S, register: usize) -> S::F64x4 {
        simd.load(array(0.0, |lane| self.0[register % REGISTERS * LANES + lane]))
    }

    /// Stores a register.
    #[inline(always)]
    pub(in crate::mpm) fn store<F: F64x4>(&mut self, register: usize, values: F) {
        self.0[register % REGISTERS * LANES..][..LANES].copy_from_slice(&values.into());
    }
}

/// The registers that hold these particles of a batch.
#[inline(always)]
pub(in crate::mpm) fn registers_of(lanes: &Range<usize>) -> Range<usize> {
    lanes.start / LANES..lanes.end.div_ceil(LANES)
}

/// The D lanes from `first` on as a vector.
#[inline(always)]
pub(in crate::mpm) fn components<const D: usize>(
    register: impl Into<[f64; LANES]>,
    first: usize,
) -> Vector<D> {
    let lanes = register.into();
    let mut vector = Vector::zeros();
    for axis in 0..D {
        vector[axis] = lanes[(first + axis) % LANES];
    }
    vector
}

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
