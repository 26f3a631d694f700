//! Where patches add to nodes. Along one axis the sums of the nodes at hand are kept in registers from
//! particle to particle.
//!
//! Neighbours in memory mostly see the same few nodes. In several dimensions other nodes are added to while
//! the sum of one is on its way to memory and back; along one axis there are none, and each particle would wait
//! for the one before. The sums are the same, in the same order.

use crate::mpm::{
    algebra::array,
    packed_grid::{FieldViewMut, PackedNode},
    simd::Simd,
};

/// A field that is added to, and the sums of K nodes in a row.
#[derive(Debug)]
pub struct NodeAccumulator<'a, S: Simd, const K: usize> {
    pub(in crate::mpm) simd: S,
    pub(in crate::mpm) field: FieldViewMut<'a>,
    /// The first of the nodes whose sums are at hand, if there are any.
    start: usize,
    sums: [S::F64x4; K],
}

/// No node.
const NONE: usize = usize::MAX;

impl<'a, S: Simd, const K: usize> NodeAccumulator<'a, S, K> {
    #[inline(always)]
    pub(in crate::mpm) fn new(simd: S, field: FieldViewMut<'a>) -> Self {
        Self { simd, field, start: NONE, sums: [simd.splat(0.0); K] }
    }

    /// Adds to row `j` of plane `k` of the box of nodes from `start` on.
    #[inline(always)]
    pub(in crate::mpm) fn add(
        &mut self,
        start: usize,
        (j, k): (usize, usize),
        term: impl Fn(usize) -> S::F64x4,
    ) {
        let row = self.field.row::<K>(start + self.field.layout.row(j, k));
        for (i, PackedNode(node)) in row.iter_mut().enumerate() {
            *node = (self.simd.load(*node) + term(i)).into();
        }
    }

    /// Adds to the nodes from `start` on, in registers: [`flush`](Self::flush) must follow the last.
    #[inline(always)]
    pub(in crate::mpm) fn add_in_registers(&mut self, start: usize, terms: [S::F64x4; K]) {
        if start != self.start {
            self.flush();
            let row = self.field.row::<K>(start);
            self.sums = array(terms[0], |i| self.simd.load(row[i].0));
            self.start = start;
        }
        for i in 0..K {
            self.sums[i] += terms[i];
        }
    }

    /// Puts the sums at hand to their nodes.
    #[inline(always)]
    pub(in crate::mpm) fn flush(&mut self) {
        if self.start != NONE {
            let row = self.field.row::<K>(self.start);
            for i in 0..K {
                row[i].0 = self.sums[i].into();
            }
            self.start = NONE;
        }
    }
}
