//! Accumulation of particle terms at nodes. In 1-D the sums stay in registers from particle to
//! particle.
//!
//! Neighbours in memory mostly have the same few nodes. In 2-D and 3-D the load of one node
//! overlaps with the additions to other nodes of the particle. In 1-D there are too few nodes for
//! this, and each particle would wait for the store of the previous one. Registers change neither
//! the terms nor their order.

use crate::mpm::foundation::algebra::array;
use crate::mpm::foundation::packed_grid::{FieldViewMut, PackedNode};
use crate::mpm::foundation::simd::Simd;

/// Field that receives the sums, with those of K consecutive nodes in registers.
#[derive(Debug)]
pub(super) struct NodeAccumulator<'a, S: Simd, N: PackedNode, const K: usize> {
    pub(in crate::mpm) simd: S,
    pub(in crate::mpm) field: FieldViewMut<'a, N>,
    /// First of the nodes whose sums are in registers, or [`NONE`].
    start: usize,
    sums: [N::Lanes<S>; K],
}

/// No node.
const NONE: usize = usize::MAX;

impl<'a, S: Simd, N: PackedNode, const K: usize> NodeAccumulator<'a, S, N, K> {
    #[inline(always)]
    pub(in crate::mpm) fn new(simd: S, field: FieldViewMut<'a, N>) -> Self {
        Self { simd, field, start: NONE, sums: [N::zero(simd); K] }
    }

    /// Adds to row `j` of plane `k` of the box of nodes from `start` on, in D dimensions.
    /// [`flush`](Self::flush) must follow the last call.
    #[inline(always)]
    pub(in crate::mpm) fn add<const D: usize>(
        &mut self,
        start: usize,
        j: usize,
        k: usize,
        with_term: impl Fn(usize, N::Lanes<S>) -> N::Lanes<S>,
    ) {
        if D == 1 {
            return self.add_in_registers(start, with_term);
        }
        let row = self.field.row::<K>(start + self.field.layout.row(j, k));
        for (i, node) in row.iter_mut().enumerate() {
            node.store::<S>(with_term(i, node.load(self.simd)));
        }
    }

    #[inline(always)]
    fn add_in_registers(
        &mut self,
        start: usize,
        with_term: impl Fn(usize, N::Lanes<S>) -> N::Lanes<S>,
    ) {
        if start != self.start {
            self.flush();
            let row = self.field.row::<K>(start);
            self.sums = array(self.sums[0], |i| row[i].load(self.simd));
            self.start = start;
        }
        for i in 0..K {
            self.sums[i] = with_term(i, self.sums[i]);
        }
    }

    /// Stores the sums in registers to their nodes.
    #[inline(always)]
    pub(in crate::mpm) fn flush(&mut self) {
        if self.start != NONE {
            let row = self.field.row::<K>(self.start);
            for i in 0..K {
                row[i].store::<S>(self.sums[i]);
            }
            self.start = NONE;
        }
    }
}
