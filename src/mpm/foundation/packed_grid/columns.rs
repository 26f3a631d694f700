//! Columns of nodes to which packed fields are unpacked.

use super::node::{PackedNode, force_lane};
use super::view::{FieldViewMut, MARGIN};
use crate::mpm::foundation::algebra::Vector;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::simd::components;
use crate::mpm::foundation::threads::{FEW, join, split};
use std::ops::Range;

/// Nodes of a piece of a 1-D grid, few enough to stay in the cache for all columns.
const PIECE: usize = 1 << 9;

/// Targets of unpacking a field: all nodes, or those of some layers across the last axis.
#[derive(Debug, Default)]
pub(in crate::mpm) struct Columns<'a, const D: usize> {
    /// From the last lane of four.
    pub(in crate::mpm) mass: Option<&'a mut [f64]>,
    /// From the first lanes.
    pub(in crate::mpm) momentum: Option<&'a mut [Vector<D>]>,
    /// From the lanes after it, or from the first ones where they hold nothing else.
    pub(in crate::mpm) force: Option<&'a mut [Vector<D>]>,
    /// Nodes of the grid before the first one of these columns.
    pub(in crate::mpm) before: usize,
}

/// Layers of nodes across the last axis of a packed field.
pub(in crate::mpm) fn layers<const D: usize>(grid: &Grid<D>) -> Range<usize> {
    0..grid.counts[D - 1] + MARGIN
}

/// Nodes of a layer of the grid.
fn nodes_of_layer<const D: usize>(grid: &Grid<D>) -> usize {
    grid.counts[..D - 1].iter().product()
}

impl<const D: usize> Columns<'_, D> {
    /// The same columns.
    pub(in crate::mpm) fn reborrow(&mut self) -> Columns<'_, D> {
        let Self { mass, momentum, force, before } = self;
        let (mass, momentum, force) =
            (mass.as_deref_mut(), momentum.as_deref_mut(), force.as_deref_mut());
        Columns { mass, momentum, force, before: *before }
    }

    /// Nodes before `layer` of the grid, and nodes from there on.
    pub(in crate::mpm) fn split_at(self, grid: &Grid<D>, layer: usize) -> (Self, Self) {
        let before = self.before;
        let from = layer.min(grid.counts[D - 1]) * nodes_of_layer(grid);
        let count = from.saturating_sub(before);
        let mass = split(self.mass, count);
        let momentum = split(self.momentum, count);
        let force = split(self.force, count);
        (
            Self { mass: mass.0, momentum: momentum.0, force: force.0, before },
            Self { mass: mass.1, momentum: momentum.1, force: force.1, before: before + count },
        )
    }

    /// Unpacks these layers, which must be part of the columns.
    pub(in crate::mpm) fn unpack<N: PackedNode>(
        &mut self,
        grid: &Grid<D>,
        field: &FieldViewMut<'_, N>,
        layers: Range<usize>,
    ) {
        let end = layers.end.min(grid.counts[D - 1]);
        let mut index = [0; D];
        if D == 1 {
            for start in (layers.start..end).step_by(PIECE) {
                index[0] = start;
                self.unpack_row(field, &index, start, PIECE.min(end - start));
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

    /// Unpacks all layers, on several threads.
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

    /// Unpacks `count` nodes in a row, from the one with this index, number `to` of the grid.
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
            mass[to.clone()].iter_mut().zip(nodes).for_each(|(m, node)| *m = node.inertia()[3]);
        }
        if let Some(momentum) = &mut self.momentum {
            let column = momentum[to.clone()].iter_mut();
            column.zip(nodes).for_each(|(value, node)| *value = components(node.inertia(), 0));
        }
        if let Some(force) = &mut self.force {
            let column = force[to].iter_mut().zip(nodes);
            column.for_each(|(value, node)| *value = components(node.force(), force_lane(D)));
        }
    }
}
