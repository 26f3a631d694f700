//! Columns of one batch of particles in memory.

use super::f64x4::F64x4;
use super::level::Simd;
use super::register::LANES;
use crate::mpm::foundation::algebra::{Vector, array};
use std::ops::Range;

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
