//! Numbers of functions of patches, known to the compiler or counted when loops run.

use std::fmt::Debug;

/// Shape of the patches of a batch: a constant of the compiler ([`FixedShape`]), or numbers
/// ([`CountedShape`]).
pub trait PatchShape: Copy + Debug {
    /// Number of functions along each axis, at most 4.
    fn functions(self) -> usize;

    /// Whether the gradient of a function is its weight times a vector of the patch, as for the
    /// corners of [CPDI](super::Cpdi). Otherwise the gradient is the derivative of the function.
    fn is_outward(self) -> bool;
}

/// Shape for loops that the compiler unrolls.
#[derive(Debug, Clone, Copy, Default)]
pub struct FixedShape<const K: usize, const OUTWARD: bool = false>;

impl<const K: usize, const OUTWARD: bool> PatchShape for FixedShape<K, OUTWARD> {
    #[inline(always)]
    fn functions(self) -> usize {
        K
    }

    #[inline(always)]
    fn is_outward(self) -> bool {
        OUTWARD
    }
}

/// Shape for loops that are compiled once for all bases.
#[derive(Debug, Clone, Copy)]
pub struct CountedShape {
    functions: usize,
    is_outward: bool,
}

impl CountedShape {
    pub(in crate::mpm) fn new(shape: impl PatchShape) -> Self {
        Self { functions: shape.functions(), is_outward: shape.is_outward() }
    }
}

impl PatchShape for CountedShape {
    #[inline(always)]
    fn functions(self) -> usize {
        self.functions
    }

    #[inline(always)]
    fn is_outward(self) -> bool {
        self.is_outward
    }
}
