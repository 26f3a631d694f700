//! Nodal fields in the memory layout of the P2G and G2P loops.
//!
//! ```text
//! node                   lane 0   lane 1   lane 2   lane 3   lanes 4, 5, 6, 7
//!   P2G 1-D                 p_x      f_x        -        m
//!   P2G 2-D                 p_x      p_y        -        m   f_x  f_y   -   -
//!   P2G 3-D                 p_x      p_y      p_z        m   f_x  f_y  f_z  -
//!   2-D, 3-D, without f     p_x      p_y      p_z        m
//!   2-D, 3-D, f alone       f_x      f_y      f_z        -
//!   G2P 1-D                 v_x      a_x        -        -
//!   G2P 2-D                 v_x      v_y      a_x      a_y
//!   G2P 3-D                 v_x      v_y      v_z        -   and a second field for a
//!
//! row     | node 0 | node 1 | ... | node n-1 | MARGIN nodes |     x fastest, then y, then z
//! ```
//!
//! The margin of a periodic axis repeats the first nodes of the axis, so the nodes of a patch
//! always form a box. The margin of other axes is zero, and is read only by functions with weight
//! zero.
//!
//! After P2G, the nodal values are copied from this field to the arrays of the grid ([`Columns`]).

mod node;

use super::algebra::{Vector, array, pairs};
use super::grid::Grid;
use super::simd::components;
use super::threads::{FEW, RowChunks, join, split};
pub(in crate::mpm) use node::{
    FieldView, FieldViewMut, Layout, MARGIN, Node4, Node8, PackedNode, force_lane,
};
use std::ops::Range;

/// Number of nodes per task when a 1-D field is packed.
const PIECE: usize = 1 << 12;

#[derive(Debug, Default)]
pub(in crate::mpm) struct PackedField<N> {
    nodes: Vec<N>,
    layout: Layout,
}

/// Returns the number of nodes along each axis; one for axes that the grid does not have.
fn counts<const D: usize>(grid: &Grid<D>) -> [usize; 3] {
    array(1, |axis| if axis < D { grid.counts[axis] } else { 1 })
}

/// Returns the components of a vector in the first lanes of a node, and zero in the others.
#[inline(always)]
fn lanes<const D: usize>(vector: &Vector<D>) -> [f64; 4] {
    array(0.0, |lane| if lane < D { vector[lane] } else { 0.0 })
}

impl<N: PackedNode> PackedField<N> {
    /// Gives the field the shape of `grid`. The values of the nodes are undefined afterwards.
    pub(in crate::mpm) fn shaped<const D: usize>(&mut self, grid: &Grid<D>) -> FieldViewMut<'_, N> {
        let layout = Layout::new(grid);
        // `resize` would be called even if the length does not change.
        if self.nodes.len() != layout.strides[3] {
            self.nodes.resize(layout.strides[3], N::default());
        }
        self.layout = layout;
        FieldViewMut { nodes: &mut self.nodes, layout }
    }

    /// Adds the numbers in the margins of periodic axes to the nodes that the margins repeat.
    pub(in crate::mpm) fn fold<const D: usize>(&mut self, grid: &Grid<D>) {
        for axis in (0..D).rev().filter(|&axis| grid.periodic[axis]) {
            for (beyond, node) in self.seam(grid, axis) {
                let more = self.nodes[beyond];
                self.nodes[node].add(&more);
            }
        }
    }

    /// Lists the margin nodes of a periodic `axis`, each with the node that it repeats.
    fn seam<const D: usize>(
        &self,
        grid: &Grid<D>,
        axis: usize,
    ) -> impl Iterator<Item = (usize, usize)> + use<D, N> {
        let (stride, count) = (self.layout.strides[axis], grid.counts[axis]);
        let (length, total) = (stride * (count + MARGIN), self.nodes.len());
        (0..total).step_by(length).flat_map(move |block| {
            (0..MARGIN * stride).map(move |k| {
                let (layer, rest) = (k / stride, k % stride);
                let at = |layer: usize| block + layer * stride + rest;
                (at(count + layer), at(layer % count))
            })
        })
    }
}

impl PackedField<Node4> {
    pub(in crate::mpm) fn view(&self) -> FieldView<'_> {
        FieldView { nodes: &self.nodes, layout: self.layout }
    }

    /// Packs a field of vectors and, optionally, the field `second` in the next lanes of each node.
    pub(in crate::mpm) fn pack<const D: usize>(
        &mut self,
        grid: &Grid<D>,
        field: &[Vector<D>],
        second: Option<&[Vector<D>]>,
    ) {
        self.shaped(grid);
        let ([across, rows, planes], [_, row, plane, _]) = (counts(grid), self.layout.strides);
        let piece = |k: usize| across.min(k * PIECE)..across.min((k + 1) * PIECE);
        let row_of_field = |k: usize| {
            let (j, k) = (k % (plane / row), k / (plane / row));
            let (from, is_there) = ((j + k * rows) * across, j < rows && k < planes);
            if is_there { from..from + across } else { 0..0 }
        };
        let length = if D == 1 { PIECE } else { row };
        RowChunks { length, few: FEW }.each(&mut self.nodes, &|k, here| {
            let there = if D == 1 { piece(k) } else { row_of_field(k) };
            let (here, beyond) = here.split_at_mut(there.len());
            pairs(here, &field[there.clone()], |Node4(here), value| *here = lanes(value));
            if let Some(second) = second {
                pairs(here, &second[there], |Node4(here), second| {
                    for axis in 0..D {
                        here[D + axis] = second[axis];
                    }
                });
            }
            // Functions with weight zero may read these nodes, so NaN from an earlier pass must be
            // removed.
            beyond.fill(Node4::default());
        });
        for axis in (0..D).filter(|&axis| grid.periodic[axis]) {
            for (beyond, node) in self.seam(grid, axis) {
                self.nodes[beyond] = self.nodes[node];
            }
        }
    }
}

/// Number of nodes that are copied at a time in 1-D: few enough for all arrays to stay in the
/// cache.
const COLUMN_PIECE: usize = 1 << 9;

/// Arrays of the grid that receive the values of a packed field, for all nodes or for some
/// layers of nodes. A layer is perpendicular to the last axis.
#[derive(Debug, Default)]
pub(in crate::mpm) struct Columns<'a, const D: usize> {
    /// Nodal mass, from the last of the four lanes.
    pub(in crate::mpm) mass: Option<&'a mut [f64]>,
    /// Nodal momentum, from the first lanes.
    pub(in crate::mpm) momentum: Option<&'a mut [Vector<D>]>,
    /// Nodal force, from the lanes after the momentum, or from the first lanes if there is no
    /// momentum.
    pub(in crate::mpm) force: Option<&'a mut [Vector<D>]>,
    /// Nodal vectors to which the first lanes are added. The other arrays are overwritten.
    pub(in crate::mpm) added: Option<&'a mut [Vector<D>]>,
    /// Number of grid nodes before the first node of these arrays.
    pub(in crate::mpm) before: usize,
}

/// Returns the indices of all node layers of a packed field, counted along the last axis.
pub(in crate::mpm) fn layers<const D: usize>(grid: &Grid<D>) -> Range<usize> {
    0..grid.counts[D - 1] + MARGIN
}

fn nodes_of_layer<const D: usize>(grid: &Grid<D>) -> usize {
    grid.counts[..D - 1].iter().product()
}

impl<const D: usize> Columns<'_, D> {
    #[inline]
    pub(in crate::mpm) fn reborrow(&mut self) -> Columns<'_, D> {
        let Self { mass, momentum, force, added, before } = self;
        let (mass, momentum) = (mass.as_deref_mut(), momentum.as_deref_mut());
        let (force, added) = (force.as_deref_mut(), added.as_deref_mut());
        Columns { mass, momentum, force, added, before: *before }
    }

    /// Splits the arrays at the first node of grid layer `layer`.
    pub(in crate::mpm) fn split_at(self, grid: &Grid<D>, layer: usize) -> (Self, Self) {
        let before = self.before;
        let from = layer.min(grid.counts[D - 1]) * nodes_of_layer(grid);
        let count = from.saturating_sub(before);
        let mass = split(self.mass, count);
        let momentum = split(self.momentum, count);
        let force = split(self.force, count);
        let added = split(self.added, count);
        let parts =
            |mass, momentum, force, added, before| Self { mass, momentum, force, added, before };
        (
            parts(mass.0, momentum.0, force.0, added.0, before),
            parts(mass.1, momentum.1, force.1, added.1, before + count),
        )
    }

    /// Copies these layers, which must be within the arrays, from the packed field.
    pub(in crate::mpm) fn unpack<N: PackedNode>(
        &mut self,
        grid: &Grid<D>,
        field: &FieldViewMut<'_, N>,
        layers: Range<usize>,
    ) {
        let end = layers.end.min(grid.counts[D - 1]);
        let mut index = [0; D];
        if D == 1 {
            for start in (layers.start..end).step_by(COLUMN_PIECE) {
                index[0] = start;
                self.unpack_row(field, &index, start, COLUMN_PIECE.min(end - start));
            }
            return;
        }
        let (across, rows) = (grid.counts[0], nodes_of_layer(grid) / grid.counts[0]);
        for layer in layers.start..end {
            for row in 0..rows {
                index[1] = row;
                index[D - 1] = layer;
                self.unpack_row(field, &index, (layer * rows + row) * across, across);
            }
        }
    }

    /// Copies all layers on several threads.
    pub(in crate::mpm) fn unpack_all<N: PackedNode>(
        mut self,
        grid: &Grid<D>,
        field: &FieldViewMut<'_, N>,
    ) {
        self.par_split(grid, field, layers(grid));
    }

    fn par_split<N: PackedNode>(
        &mut self,
        grid: &Grid<D>,
        field: &FieldViewMut<'_, N>,
        layers: Range<usize>,
    ) {
        if layers.len() < 2 || layers.len() * nodes_of_layer(grid) <= FEW {
            return self.unpack(grid, field, layers);
        }
        let middle = layers.start + layers.len() / 2;
        let (mut left, mut right) = self.reborrow().split_at(grid, middle);
        join(
            || left.par_split(grid, field, layers.start..middle),
            || right.par_split(grid, field, middle..layers.end),
        );
    }

    /// Copies `count` nodes of a row, starting at `index` in the field, to grid nodes starting at
    /// number `to`.
    fn unpack_row<N: PackedNode>(
        &mut self,
        field: &FieldViewMut<'_, N>,
        index: &[usize; D],
        to: usize,
        count: usize,
    ) {
        let to = to - self.before..to - self.before + count;
        let from = field.layout.number(index);
        let nodes = &field.nodes[from..from + count];
        if let Some(mass) = &mut self.mass {
            pairs(&mut mass[to.clone()], nodes, |m, node| *m = node.inertia()[3]);
        }
        if let Some(momentum) = &mut self.momentum {
            pairs(&mut momentum[to.clone()], nodes, |value, node| {
                *value = components(node.inertia(), 0);
            });
        }
        if let Some(force) = &mut self.force {
            pairs(&mut force[to.clone()], nodes, |value, node| {
                *value = components(node.force(), force_lane(D));
            });
        }
        if let Some(added) = &mut self.added {
            pairs(&mut added[to], nodes, |value, node| {
                *value += components::<D>(node.inertia(), 0);
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn grid(counts: [usize; 2], periodic: [bool; 2]) -> Grid<2> {
        Grid::new(Vector::zeros(), 1.0, counts, periodic, counts)
    }

    proptest! {
        /// Every position in the packed field represents one node of the grid: packing copies the
        /// nodal value to this position, and folding adds the value at this position to the node.
        #[test]
        fn packing_and_folding_are_transposes(
            counts in [1_usize..6, 1..6],
            periodic in [any::<bool>(), any::<bool>()],
        ) {
            let grid = grid(counts, periodic);
            let field: Vec<_> = (0..grid.nodes()).map(|i| Vector::<2>::new(i as f64, 1.0)).collect();
            let mut packed = PackedField::<Node4>::default();
            packed.pack(&grid, &field, Some(&field));
            let reach = |axis: usize| counts[axis] + if periodic[axis] { MARGIN } else { 0 };
            for (i, j) in (0..reach(1)).flat_map(|j| (0..reach(0)).map(move |i| (i, j))) {
                let at = packed.layout.number(&[i, j]);
                let node = grid.node(&[i % counts[0], j % counts[1]]);
                let there = packed.view().row(at, 1)[0].0;
                prop_assert_eq!(there, [node as f64, 1.0, node as f64, 1.0]);

                let mut one = PackedField::<Node4>::default();
                let mut view = one.shaped(&grid);
                view.clear();
                view.row(at, 1)[0].0[3] = 1.0;
                one.fold(&grid);
                let mut found = vec![0.0; grid.nodes()];
                let columns = Columns { mass: Some(&mut found), ..Columns::default() };
                columns.unpack_all(&grid, &one.shaped(&grid));
                let expected: Vec<_> = (0..grid.nodes()).map(|i| f64::from(u8::from(i == node))).collect();
                prop_assert_eq!(found, expected);
            }
        }
    }
}
