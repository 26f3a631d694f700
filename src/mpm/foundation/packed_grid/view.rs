//! Views of packed fields: all of a field, or consecutive layers of it.

use super::node::{Node4, PackedNode};
use crate::mpm::foundation::grid::Grid;

/// Additional nodes of an axis: one fewer than the functions of a patch along it.
pub(in crate::mpm) const MARGIN: usize = 3;

/// Positions of nodes in a packed field.
#[derive(Debug, Clone, Copy, Default)]
pub struct Layout {
    /// Distance of neighbours along each axis, then the number of nodes.
    pub(in crate::mpm) strides: [usize; 4],
    /// Nodes of the field before the first one of the view.
    pub(in crate::mpm) before: usize,
}

impl Layout {
    /// Layout of a field on `grid`.
    pub(in crate::mpm) fn of<const D: usize>(grid: &Grid<D>) -> Self {
        let mut strides = [1; 4];
        for axis in 0..3 {
            let count = grid.counts.get(axis).map_or(1, |count| count + MARGIN);
            strides[axis + 1] = strides[axis] * count;
        }
        Self { strides, before: 0 }
    }

    /// Position of the node with these indices in the view; beyond its end for a node before it.
    #[inline(always)]
    pub(in crate::mpm) fn number<const D: usize>(&self, index: &[usize; D]) -> usize {
        let mut number = index[0];
        for axis in 1..D {
            number += index[axis] * self.strides[axis];
        }
        number.wrapping_sub(self.before)
    }

    /// Distance of row `j` of plane `k` from the first row.
    #[inline(always)]
    pub(in crate::mpm) fn row(&self, j: usize, k: usize) -> usize {
        j * self.strides[1] + k * self.strides[2]
    }
}

/// Field that a loop reads.
#[derive(Debug, Clone, Copy)]
pub struct FieldView<'a> {
    pub(in crate::mpm) nodes: &'a [Node4],
    pub(in crate::mpm) layout: Layout,
}

/// Field, or consecutive layers of it, to which a loop adds.
#[derive(Debug)]
pub struct FieldViewMut<'a, N> {
    pub(in crate::mpm) nodes: &'a mut [N],
    pub(in crate::mpm) layout: Layout,
}

impl FieldView<'_> {
    /// K nodes in a row.
    #[inline(always)]
    pub(in crate::mpm) fn row<const K: usize>(&self, start: usize) -> &[Node4] {
        &self.nodes[start..start + K]
    }
}

impl<N: PackedNode> FieldViewMut<'_, N> {
    /// Reborrowed view.
    #[inline(always)]
    pub(in crate::mpm) fn reborrow(&mut self) -> FieldViewMut<'_, N> {
        FieldViewMut { nodes: self.nodes, layout: self.layout }
    }

    /// K nodes in a row.
    #[inline(always)]
    pub(in crate::mpm) fn row<const K: usize>(&mut self, start: usize) -> &mut [N] {
        &mut self.nodes[start..start + K]
    }

    /// Zero everywhere.
    pub(in crate::mpm) fn clear(&mut self) {
        self.nodes.fill(N::default());
    }

    /// Nodes before a layer across the last of D axes, and nodes from there on.
    pub(in crate::mpm) fn split_at<const D: usize>(self, layer: usize) -> (Self, Self) {
        let Self { nodes, layout } = self;
        let before = layout.before.max(layer * layout.strides[D - 1]);
        let (low, high) = nodes.split_at_mut(nodes.len().min(before - layout.before));
        (Self { nodes: low, layout }, Self { nodes: high, layout: Layout { before, ..layout } })
    }
}
