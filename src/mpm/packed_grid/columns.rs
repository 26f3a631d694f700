//! Columns of nodes to which packed fields are unpacked.

use super::view::FieldViewMut;
use super::{FEW, MARGIN};
use crate::mpm::algebra::Vector;
use crate::mpm::grid::Grid;
use crate::mpm::simd::components;
use crate::mpm::threads::{join, split};
use std::ops::Range;

/// Nodes of a piece of a 1-D grid, few enough to stay in the cache for all columns.
const PIECE: usize = 1 << 9;

/// Targets of unpacking two fields: all nodes, or those of some layers across the last axis.
#[derive(Debug, Default)]
pub(in crate::mpm) struct Columns<'a, const D: usize> {
    /// From the last lane of the first field.
    pub(in crate::mpm) mass: Option<&'a mut [f64]>,
    /// From the first field.
    pub(in crate::mpm) momentum: Option<&'a mut [Vector<D>]>,
    /// From the second field, or from the lanes after the momentum where there is one field.
    pub(in crate::mpm) force: Option<&'a mut [Vector<D>]>,
    /// Whether one field holds all.
    pub(in crate::mpm) is_one_field: bool,
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
        let Self { mass, momentum, force, is_one_field, before } = self;
        let (mass, momentum, force) =
            (mass.as_deref_mut(), momentum.as_deref_mut(), force.as_deref_mut());
        Columns { mass, momentum, force, is_one_field: *is_one_field, before: *before }
    }

    /// Nodes before `layer` of the grid, and nodes from there on.
    pub(in crate::mpm) fn split_at(self, grid: &Grid<D>, layer: usize) -> (Self, Self) {
        let Self { is_one_field, before, .. } = self;
        let from = layer.min(grid.counts[D - 1]) * nodes_of_layer(grid);
        let count = from.saturating_sub(before);
        let mass = split(self.mass, count);
        let momentum = split(self.momentum, count);
        let force = split(self.force, count);
        let part =
            |mass, momentum, force, before| Self { mass, momentum, force, is_one_field, before };
        (
            part(mass.0, momentum.0, force.0, before),
            part(mass.1, momentum.1, force.1, before + count),
        )
    }

    /// Unpacks these layers, which must be part of the columns.
    pub(in crate::mpm) fn unpack(
        &mut self,
        grid: &Grid<D>,
        fields: &[FieldViewMut<'_>; 2],
        layers: Range<usize>,
    ) {
        let end = layers.end.min(grid.counts[D - 1]);
        let mut index = [0; D];
        if D == 1 {
            for start in (layers.start..end).step_by(PIECE) {
                index[0] = start;
                self.unpack_row(fields, &index, start, PIECE.min(end - start));
            }
            return;
        }
        let (across, rows) = (grid.counts[0], nodes_of_layer(grid) / grid.counts[0]);
        for layer in layers.start..end {
            for row in 0..rows {
                index[1] = row;
                index[D - 1] = layer;
                self.unpack_row(fields, &index, (layer * rows + row) * across, across);
            }
        }
    }

    /// Unpacks all layers, on several threads.
    pub(in crate::mpm) fn unpack_all(mut self, grid: &Grid<D>, fields: &[FieldViewMut<'_>; 2]) {
        self.par_split(grid, fields, layers(grid));
    }

    fn par_split(&mut self, grid: &Grid<D>, fields: &[FieldViewMut<'_>; 2], layers: Range<usize>) {
        if layers.len() < 2 || layers.len() * nodes_of_layer(grid) <= FEW {
            return self.unpack(grid, fields, layers);
        }
        let middle = layers.start + layers.len() / 2;
        let (mut left, mut right) = self.reborrow().split_at(grid, middle);
        join(
            || left.par_split(grid, fields, layers.start..middle),
            || right.par_split(grid, fields, middle..layers.end),
        );
    }

    /// Unpacks `count` nodes in a row, from the one with this index, number `to` of the grid.
    fn unpack_row(
        &mut self,
        fields: &[FieldViewMut<'_>; 2],
        index: &[usize; D],
        to: usize,
        count: usize,
    ) {
        let to = to - self.before..to - self.before + count;
        let lanes = |field: usize| {
            let from = fields[field].layout.number(index);
            fields[field].nodes[from..from + count].iter().map(|node| node.0)
        };
        if let Some(mass) = &mut self.mass {
            mass[to.clone()].iter_mut().zip(lanes(0)).for_each(|(m, lanes)| *m = lanes[3]);
        }
        if let Some(momentum) = &mut self.momentum {
            let column = momentum[to.clone()].iter_mut();
            column.zip(lanes(0)).for_each(|(value, lanes)| *value = components(lanes, 0));
        }
        let Some(force) = &mut self.force else { return };
        let column = force[to].iter_mut();
        // Two branches, so that the lane is a constant in each.
        if self.is_one_field {
            column.zip(lanes(0)).for_each(|(value, lanes)| *value = components(lanes, D));
        } else {
            column.zip(lanes(1)).for_each(|(value, lanes)| *value = components(lanes, 0));
        }
    }
}
