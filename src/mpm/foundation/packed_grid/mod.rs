//! Nodal fields in the layout of the loops of P2G and G2P.
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
//! The margin of a periodic axis repeats its first nodes, so that a patch is always a box of
//! neighbours. Elsewhere it is zero: functions of weight zero may belong to it.

mod columns;
mod node;
mod view;

use super::algebra::Vector;
use super::grid::Grid;
use super::threads::{FEW, RowChunks};
pub(in crate::mpm) use columns::{Columns, layers};
pub(in crate::mpm) use node::{Node4, Node8, PackedNode, force_lane};
pub(in crate::mpm) use view::{FieldView, FieldViewMut, Layout, MARGIN};

/// Nodes of a piece of a 1-D grid.
const PIECE: usize = 1 << 12;

/// Packed field of nodes.
#[derive(Debug, Default)]
pub(in crate::mpm) struct PackedField<N> {
    nodes: Vec<N>,
    layout: Layout,
}

/// Nodes along each axis, one where there is no axis.
fn counts<const D: usize>(grid: &Grid<D>) -> [usize; 3] {
    std::array::from_fn(|axis| grid.counts.get(axis).copied().unwrap_or(1))
}

/// Vector in the first lanes of a node.
#[inline(always)]
fn lanes<const D: usize>(vector: &Vector<D>) -> [f64; 4] {
    std::array::from_fn(|lane| if lane < D { vector[lane] } else { 0.0 })
}

impl<N: PackedNode> PackedField<N> {
    /// The field in the shape of `grid`, with undefined values.
    pub(in crate::mpm) fn shaped<const D: usize>(&mut self, grid: &Grid<D>) -> FieldViewMut<'_, N> {
        let layout = Layout::of(grid);
        self.nodes.resize(layout.strides[3], N::default());
        self.layout = layout;
        FieldViewMut { nodes: &mut self.nodes, layout }
    }

    /// Adds the margins of periodic axes to the nodes that they repeat.
    pub(in crate::mpm) fn fold<const D: usize>(&mut self, grid: &Grid<D>) {
        for axis in (0..D).rev().filter(|&axis| grid.periodic[axis]) {
            for (beyond, node) in self.seam(grid, axis) {
                let more = self.nodes[beyond];
                self.nodes[node].add(&more);
            }
        }
    }

    /// Nodes of the margin of a periodic `axis`, each with the node that it repeats.
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
    /// Shared view of the field.
    pub(in crate::mpm) fn view(&self) -> FieldView<'_> {
        FieldView { nodes: &self.nodes, layout: self.layout }
    }

    /// Packs a field of vectors and, in the lanes `beside` it, perhaps another one.
    pub(in crate::mpm) fn pack<const D: usize>(
        &mut self,
        grid: &Grid<D>,
        field: &[Vector<D>],
        beside: Option<&[Vector<D>]>,
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
            let values = here.iter_mut().zip(&field[there.clone()]);
            if let Some(beside) = beside {
                for ((Node4(here), value), beside) in values.zip(&beside[there]) {
                    *here = lanes(value);
                    here[D..2 * D].copy_from_slice(beside.as_slice());
                }
            } else {
                values.for_each(|(Node4(here), value)| *here = lanes(value));
            }
            // Functions of weight zero may belong here: no NaN of an earlier pass may remain.
            beyond.fill(Node4::default());
        });
        for axis in (0..D).filter(|&axis| grid.periodic[axis]) {
            for (beyond, node) in self.seam(grid, axis) {
                self.nodes[beyond] = self.nodes[node];
            }
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
        /// Every place of the packed field stands for one node of the grid: packing writes the
        /// value of that node there, and folding adds it back.
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
                let there = packed.view().row::<1>(at)[0].0;
                prop_assert_eq!(there, [node as f64, 1.0, node as f64, 1.0]);

                let mut one = PackedField::<Node4>::default();
                let mut view = one.shaped(&grid);
                view.clear();
                view.row::<1>(at)[0].0[3] = 1.0;
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
