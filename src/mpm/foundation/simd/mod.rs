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
//! Each lane does the same IEEE operations at every level, products and sums fused where the source
//! says so and nowhere else, so that results have the same bits on every processor (held by tests
//! in `tests/it/mpm/kernel`).

mod batch;
mod f64x4;
mod level;
mod logarithm;
mod plain;
mod register;
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
mod registers;

pub(in crate::mpm) use batch::{BATCH, F64Batch, components, registers_of};
pub(in crate::mpm) use f64x4::F64x4;
use fearless_simd::Level;
pub(in crate::mpm) use level::Simd;
pub(in crate::mpm) use logarithm::ln;
pub(in crate::mpm) use plain::Plain;
pub(in crate::mpm) use register::{LANES, Register};
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
use std::sync::LazyLock;

/// Loop over registers. All functions it calls must be `#[inline(always)]`: others are compiled
/// for the baseline processor.
pub trait SimdPass: Sized {
    /// Whether the loop runs faster with the registers of AVX-512, 32 in place of 16 and twice as
    /// wide.
    const NEEDS_AVX512: bool;

    /// Runs the loop.
    fn run<S: Simd>(self, simd: S);
}

/// Runs `pass` at `level`; [`Basis::run`](crate::mpm::Basis::run) says where it is compiled.
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

/// Runs `loops` that name no registers, compiled for those of AVX2 where the processor has them.
/// All functions they call must be `#[inline(always)]`, and so must they.
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
