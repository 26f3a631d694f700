//! Four numbers at a time: the width in which the particle-node loops work.
//!
//! The loops are written once over [`Four`] and compiled over plain arrays and over the registers of
//! AVX2, some also over those of AVX-512, which are as wide here but more; the processor at hand decides. All
//! do the same IEEE operations on each lane, a product and a sum and never a fused one, so the bits are the
//! same; a test holds them to it.

mod plain;
#[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
mod registers;
mod width;

pub(in crate::mpm) use plain::Plain;
pub(in crate::mpm) use width::{FOUR, Four, LANES, Lanes, Width, part, parts};

use fearless_simd::Level;

/// A loop over fours. Whatever it calls must be `#[inline(always)]`, or it is compiled for any
/// processor and slow.
pub(in crate::mpm) trait Pass: Sized {
    /// Whether 16 registers are too few for it: the 32 of AVX-512 are used where there are any.
    const NEEDS_REGISTERS: bool;

    /// Runs it.
    fn run<W: Width>(self, width: W);
}

/// Runs `pass` in the best way that the processor has.
pub(in crate::mpm) fn run(pass: impl Pass) {
    run_at(Level::new(), pass);
}

/// Runs `pass` in the best way of this level.
pub(in crate::mpm) fn run_at<P: Pass>(level: Level, pass: P) {
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    {
        use fearless_simd::Simd as _;
        if P::NEEDS_REGISTERS
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

/// Levels below that of the processor at which it can run the loops as well.
#[cfg(test)]
pub(in crate::mpm) fn lower_levels() -> Vec<Level> {
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    if let Some(avx2) = Level::new().as_avx2() {
        return vec![Level::Avx2(avx2)];
    }
    Vec::new()
}
