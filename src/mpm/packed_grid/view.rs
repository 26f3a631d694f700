//! PackedField fields as loops see them: all of a field, or a stretch of it.

use crate::mpm::grid::Grid;

/// Nodes by which an axis is longer: one fewer than the functions that a patch has along an axis.
pub(in crate::mpm) const MARGIN: usize = 3;

/// One node: four numbers that share a cache line.
#[derive(Debug, Clone, Copy, Default)]
#[repr(align(32))]
pub(in crate::mpm) struct PackedNode(pub(in crate::mpm) [f64; 4]);

/// Where nodes are in a packed field.
#[derive(Debug, Clone, Copy, Default)]
pub struct Layout {
    /// Distance of neighbours along each axis, and at last the number of nodes.
    pub(in crate::mpm) strides: [usize; 4],
    /// Nodes of the field that come before the first one at hand.
    pub(in crate::mpm) before: usize,
}

impl Layout {
    /// That of a field on `grid`.
    pub(in crate::mpm) fn of<const D: usize>(grid: &Grid<D>) -> Self {
        let mut strides = [1; 4];
        for axis in 0..3 {
            let count = grid.counts.get(axis).map_or(1, |count| count + MARGIN);
            strides[axis + 1] = strides[axis] * count;
        }
        Self { strides, before: 0 }
    }

    /// Number of the node with these indices among those at hand. One that is not has a number
    /// beyond any.
    #[inline(always)]
    pub(in crate::mpm) fn number<const D: usize>(&self, index: &[usize; D]) -> usize {
        let mut number = index[0];
        for axis in 1..D {
            number += index[axis] * self.strides[axis];
        }
        number.wrapping_sub(self.before)
    }

    /// How far row `j` of plane `k` is from the first row.
    #[inline(always)]
    pub(in crate::mpm) fn row(&self, j: usize, k: usize) -> usize {
        j * self.strides[1] + k * self.strides[2]
    }
}

/// A field as a loop reads it.
#[derive(Debug, Clone, Copy)]
pub struct FieldView<'a> {
    pub(in crate::mpm) nodes: &'a [PackedNode],
    pub(in crate::mpm) layout: Layout,
}

/// A field, or a stretch of it, as a loop adds to it.
#[derive(Debug)]
pub struct FieldViewMut<'a> {
    pub(in crate::mpm) nodes: &'a mut [PackedNode],
    pub(in crate::mpm) layout: Layout,
}

impl FieldView<'_> {
    /// K nodes in a row.
    #[inline(always)]
    pub(in crate::mpm) fn row<const K: usize>(&self, start: usize) -> &[PackedNode] {
        &self.nodes[start..start + K]
    }
}

impl FieldViewMut<'_> {
    /// No field.
    pub(in crate::mpm) fn none() -> Self {
        Self { nodes: &mut [], layout: Layout::default() }
    }

    /// The same field.
    #[inline(always)]
    pub(in crate::mpm) fn reborrow(&mut self) -> FieldViewMut<'_> {
        FieldViewMut { nodes: self.nodes, layout: self.layout }
    }

    /// K nodes in a row.
    #[inline(always)]
    pub(in crate::mpm) fn row<const K: usize>(&mut self, start: usize) -> &mut [PackedNode] {
        &mut self.nodes[start..start + K]
    }

    /// Zero everywhere.
    pub(in crate::mpm) fn clear(&mut self) {
        self.nodes.fill(PackedNode::default());
    }

    /// The nodes before a layer across the last of D axes, and those from there on.
    pub(in crate::mpm) fn split_at<const D: usize>(self, layer: usize) -> (Self, Self) {
        let Self { nodes, layout } = self;
        let before = layout.before.max(layer * layout.strides[D - 1]);
        let (low, high) = nodes.split_at_mut(nodes.len().min(before - layout.before));
        (Self { nodes: low, layout }, Self { nodes: high, layout: Layout { before, ..layout } })
    }
}
