//! Nodal fields as the particle-node loops see them: the components of a node side by side, four to a
//! node, in rows without a seam.
//!
//! A periodic axis goes on beyond its last node: its first nodes stand there once more, so that what
//! a particle sees is always a box of neighbours. All axes are longer by [`MARGIN`], also where
//! nothing goes on: functions of weight zero may stand there.

use super::{algebra::Vector, grid::Grid};
use std::ops::Range;

/// Nodes by which an axis is longer: one fewer than the functions that a patch has along an axis.
pub(super) const MARGIN: usize = 3;

/// One node: four numbers that share a cache line.
#[derive(Debug, Clone, Copy, Default)]
#[repr(align(32))]
pub(super) struct Node(pub(super) [f64; 4]);

/// A field of nodes.
#[derive(Debug, Default)]
pub(super) struct Packed {
    nodes: Vec<Node>,
    strides: [usize; 3],
}

/// A field as a loop reads it.
#[derive(Debug, Clone, Copy)]
pub struct View<'a> {
    nodes: &'a [Node],
    /// Distance of neighbours along each axis.
    pub(super) strides: [usize; 3],
}

/// A field as a loop adds to it.
#[derive(Debug)]
pub struct ViewMut<'a> {
    nodes: &'a mut [Node],
    /// Distance of neighbours along each axis.
    pub(super) strides: [usize; 3],
}

impl View<'_> {
    /// K nodes in a row.
    #[inline(always)]
    pub(super) fn row<const K: usize>(&self, start: usize) -> &[Node] {
        &self.nodes[start..start + K]
    }
}

impl ViewMut<'_> {
    /// K nodes in a row.
    #[inline(always)]
    pub(super) fn row<const K: usize>(&mut self, start: usize) -> &mut [Node] {
        &mut self.nodes[start..start + K]
    }
}

/// Number of the node with these indices.
#[inline(always)]
pub(super) fn number<const D: usize>(index: &[usize; D], strides: &[usize; 3]) -> usize {
    let mut number = index[0];
    for axis in 1..D {
        number += index[axis] * strides[axis];
    }
    number
}

/// Nodes along each axis, one where there is no axis.
fn counts<const D: usize>(grid: &Grid<D>) -> [usize; 3] {
    std::array::from_fn(|axis| grid.counts.get(axis).copied().unwrap_or(1))
}

impl Packed {
    /// Takes the shape of `grid`, with zero everywhere.
    pub(super) fn clear<const D: usize>(&mut self, grid: &Grid<D>) {
        if self.shape(grid) {
            self.nodes.fill(Node::default());
        }
    }

    /// Takes the shape of `grid` and returns whether it had it before; if not, there is zero
    /// everywhere.
    fn shape<const D: usize>(&mut self, grid: &Grid<D>) -> bool {
        let (mut total, before) = (1, (self.nodes.len(), self.strides));
        for axis in 0..D {
            self.strides[axis] = total;
            total *= grid.counts[axis] + MARGIN;
        }
        self.strides[D..].fill(total);
        if before == (total, self.strides) {
            return true;
        }
        self.nodes.clear();
        self.nodes.resize(total, Node::default());
        false
    }

    /// The field, to be read.
    pub(super) fn view(&self) -> View<'_> {
        View { nodes: &self.nodes, strides: self.strides }
    }

    /// The field, to be added to.
    pub(super) fn view_mut(&mut self) -> ViewMut<'_> {
        ViewMut { nodes: &mut self.nodes, strides: self.strides }
    }

    /// Where each row of nodes of the grid is here, in the order of nodes.
    fn places<const D: usize>(
        &self,
        grid: &Grid<D>,
    ) -> impl Iterator<Item = Range<usize>> + use<D> {
        let ([across, rows, planes], [_, row, plane]) = (counts(grid), self.strides);
        (0..rows * planes).map(move |k| {
            let start = k % rows * row + k / rows * plane;
            start..start + across
        })
    }

    /// The rows of nodes of the grid, in order.
    pub(super) fn rows<const D: usize>(&self, grid: &Grid<D>) -> impl Iterator<Item = &[Node]> {
        self.places(grid).map(|place| &self.nodes[place])
    }

    /// Takes over a field of vectors.
    pub(super) fn pack<const D: usize>(&mut self, grid: &Grid<D>, field: &[Vector<D>]) {
        self.shape(grid);
        let ([across, rows, planes], [_, row, plane]) = (counts(grid), self.strides);
        for (k, here) in self.nodes.chunks_exact_mut(row).enumerate() {
            let (j, k) = (k % (plane / row), k / (plane / row));
            let is_there = j < rows && k < planes;
            let there = if is_there { &field[(j + k * rows) * across..][..across] } else { &[] };
            let (here, beyond) = here.split_at_mut(there.len());
            for (Node(lanes), value) in here.iter_mut().zip(there) {
                *lanes = [0.0; 4];
                lanes[..D].copy_from_slice(value.as_slice());
            }
            // A function of weight zero may stand here, and must not meet what an earlier pass left.
            beyond.fill(Node::default());
        }
        for axis in (0..D).filter(|&axis| grid.periodic[axis]) {
            for (beyond, node) in self.seam(grid, axis) {
                self.nodes[beyond] = self.nodes[node];
            }
        }
    }

    /// Adds what lies beyond the ends of periodic axes to the nodes that it belongs to.
    pub(super) fn fold<const D: usize>(&mut self, grid: &Grid<D>) {
        for axis in (0..D).rev().filter(|&axis| grid.periodic[axis]) {
            for (beyond, node) in self.seam(grid, axis) {
                let Node(more) = self.nodes[beyond];
                for (sum, more) in self.nodes[node].0.iter_mut().zip(more) {
                    *sum += more;
                }
            }
        }
    }

    /// The nodes beyond the end of `axis`, each with the one that it is.
    fn seam<const D: usize>(
        &self,
        grid: &Grid<D>,
        axis: usize,
    ) -> impl Iterator<Item = (usize, usize)> + use<D> {
        let (stride, count) = (self.strides[axis], grid.counts[axis]);
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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn grid(counts: [usize; 2], periodic: [bool; 2]) -> Grid<2> {
        Grid::new(Vector::zeros(), 1.0, counts, periodic, counts)
    }

    proptest! {
        /// Every place of the packed field stands for one node of the grid: what is put there is
        /// read back there, and what is left there is found there.
        #[test]
        fn packing_and_folding_are_transposes(
            counts in [1_usize..6, 1..6],
            periodic in [any::<bool>(), any::<bool>()],
        ) {
            let grid = grid(counts, periodic);
            let field: Vec<_> = (0..grid.nodes()).map(|i| Vector::<2>::new(i as f64, 1.0)).collect();
            let mut packed = Packed::default();
            packed.pack(&grid, &field);
            let reach = |axis: usize| counts[axis] + if periodic[axis] { MARGIN } else { 0 };
            for (i, j) in (0..reach(1)).flat_map(|j| (0..reach(0)).map(move |i| (i, j))) {
                let at = number(&[i, j], &packed.strides);
                let node = grid.node(&[i % counts[0], j % counts[1]]);
                prop_assert_eq!(packed.view().row::<1>(at)[0].0, [node as f64, 1.0, 0.0, 0.0]);

                let mut one = Packed::default();
                one.clear(&grid);
                one.view_mut().row::<1>(at)[0].0[3] = 1.0;
                one.fold(&grid);
                let found: Vec<f64> = one.rows(&grid).flatten().map(|node| node.0[3]).collect();
                let expected: Vec<_> = (0..grid.nodes()).map(|i| f64::from(u8::from(i == node))).collect();
                prop_assert_eq!(found, expected);
            }
        }
    }
}
