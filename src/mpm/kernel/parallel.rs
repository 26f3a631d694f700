//! The work on blocks of particles, shared among threads.
//!
//! The white blocks and the black ones between them make a tree: a black block comes after both its
//! neighbours, whatever thread they were on, and no other block sees its nodes. What no block to come will add to is
//! unpacked at once, while it is near.

use super::colouring::ParticleBlock;
use crate::mpm::{
    grid::Grid,
    packed_grid::{Columns, FieldViewMut, layers},
    threads::join,
};
use std::ops::Range;

/// Nodes that are mapped to: two packed fields, and the columns that they are unpacked to.
#[derive(Debug)]
pub(in crate::mpm) struct Target<'a, const D: usize> {
    pub(in crate::mpm) fields: [FieldViewMut<'a>; 2],
    pub(in crate::mpm) columns: Columns<'a, D>,
}

impl<const D: usize> Target<'_, D> {
    fn reborrow(&mut self) -> Target<'_, D> {
        let fields = self.fields.each_mut().map(FieldViewMut::reborrow);
        Target { fields, columns: self.columns.reborrow() }
    }

    /// The nodes before `layer`, and those from there on.
    fn split_at(self, grid: &Grid<D>, layer: usize) -> (Self, Self) {
        let [a, b] = self.fields.map(|field| field.split_at::<D>(layer));
        let columns = self.columns.split_at(grid, layer);
        (
            Self { fields: [a.0, b.0], columns: columns.0 },
            Self { fields: [a.1, b.1], columns: columns.1 },
        )
    }
}

/// Adds a block of particles to fields that hold its nodes.
type Add<'a> = dyn Fn(&ParticleBlock, [FieldViewMut<'_>; 2]) + Sync + 'a;

/// Clears the nodes of `target`, calls `add` for all blocks, each with fields that hold its nodes, and
/// unpacks what they leave. Black block k stands between the white blocks k and k + 1, the last one after all.
pub(in crate::mpm) fn two_colour_schedule<const D: usize>(
    grid: &Grid<D>,
    [white, black]: [&[ParticleBlock]; 2],
    target: Target<'_, D>,
    add: &Add<'_>,
) {
    let (between, last) = black.split_at(black.len().min(white.len().saturating_sub(1)));
    Schedule { grid, add }.tree(0..layers(grid).end, [white, between, last], target);
}

struct Schedule<'a, const D: usize> {
    grid: &'a Grid<D>,
    add: &'a Add<'a>,
}

impl<const D: usize> Schedule<'_, D> {
    /// White blocks, those between them, and perhaps one after the last. The layers in `own` are seen by none but
    /// these.
    fn tree(
        &self,
        own: Range<usize>,
        [white, black, last]: [&[ParticleBlock]; 3],
        mut target: Target<'_, D>,
    ) {
        let end = last.first().map_or(own.end, |last| last.layers.start);
        let middle = white.len() / 2;
        let (between, seen) = if middle == 0 {
            target.fields.iter_mut().for_each(FieldViewMut::clear);
            (white, own.start..end)
        } else {
            let (layer, between) = (white[middle].layers.start, &black[middle - 1..middle]);
            let seen = between[0].layers.start..layer.max(between[0].layers.end);
            let (low, high) = target.reborrow().split_at(self.grid, layer);
            let left = [&white[..middle], &black[..middle - 1], &[]];
            let right = [&white[middle..], &black[middle..], &[]];
            join(
                || self.tree(own.start..seen.start, left, low),
                || self.tree(seen.end..end, right, high),
            );
            (between, seen)
        };
        if middle == 0 || last.is_empty() {
            self.add(between, seen, target.reborrow());
            return self.add(last, end..own.end, target);
        }
        // Two of a colour: at once.
        let (low, high) = target.split_at(self.grid, end);
        join(|| self.add(between, seen, low), || self.add(last, end..own.end, high));
    }

    /// Adds a block, if there is one, and unpacks layers to which no other one will add.
    fn add(&self, block: &[ParticleBlock], done: Range<usize>, mut target: Target<'_, D>) {
        if let [block] = block {
            (self.add)(block, target.reborrow().fields);
        }
        target.columns.unpack(self.grid, &target.fields, done);
    }
}
