//! Data and arithmetic for all methods: vectors, registers, threads, the grid, the particles, and
//! the macros that register members of families. This module does not depend on the basis, the
//! kernel or the step.

pub(in crate::mpm) mod algebra;
pub(in crate::mpm) mod family;
pub(in crate::mpm) mod finite_check;
pub(in crate::mpm) mod grid;
pub(in crate::mpm) mod moments;
pub(in crate::mpm) mod packed_grid;
pub(in crate::mpm) mod particles;
pub(in crate::mpm) mod simd;
pub(in crate::mpm) mod threads;
