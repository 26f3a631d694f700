//! The work on blocks of particles, shared among threads.
//!
//! The white blocks and the black ones between them make a tree: a black block comes after both its
//! neighbours, whatever thread they were on, and no other block sees its nodes. What no block to come will add to is
//! unpacked at once, while it is near.

use super::blocks::Block;
use crate::mpm::{
    grid::Grid,
    packed::{Columns, ViewMut, layers},
    threads::both,
};
use std::ops::Range;

/// Nodes that are mapped to: two packed fields, and the columns that they are unpacked to.
#[derive(Debug)]
pub(super) struct Target<'a, const D: usize> {
    pub(super) fields: [ViewMut<'a>; 2],
    pub(super) columns: Columns<'a, D>,
}

impl<const D: usize> Target<'_, D> {
    fn again(&mut self) -> Target<'_, D> {
        let fields = self.fields.each_mut().map(ViewMut::again);
        Target { fields, columns: self.columns.again() }
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

    fn unpack(&mut self, grid: &Grid<D>, layers: Range<usize>) {
        self.columns.unpack(grid, &self.fields, layers);
    }
}

/// Clears the nodes of `target`, calls `add` for all blocks, each with fields that hold its nodes, and
/// unpacks what they leave. Black block k stands between the white blocks k and k + 1, the last one after all.
pub(super) fn share<const D: usize>(
    grid: &Grid<D>,
    [white, black]: [&[Block]; 2],
    target: Target<'_, D>,
    add: &(impl Fn(&Block, [ViewMut<'_>; 2]) + Sync),
) {
    share_from(grid, (0, layers(grid).end), [white, black], target, add);
}

/// The same for blocks to which no other one adds from layer `free.0` on and before `free.1`.
fn share_from<const D: usize>(
    grid: &Grid<D>,
    free: (usize, usize),
    [white, black]: [&[Block]; 2],
    mut target: Target<'_, D>,
    add: &(impl Fn(&Block, [ViewMut<'_>; 2]) + Sync),
) {
    if white.len() > 1 {
        let middle = white.len() / 2;
        let ([white_left, white_right], [black_left, black_right]) =
            ([&white[..middle], &white[middle..]], [&black[..middle - 1], &black[middle..]]);
        let (layer, between) = (white[middle].layers.start, &black[middle - 1]);
        let (left, right) = target.again().split_at(grid, layer);
        let (from, to) = (between.layers.start, layer.max(between.layers.end));
        both(
            || share_from(grid, (free.0, from), [white_left, black_left], left, add),
            || share_from(grid, (to, free.1), [white_right, black_right], right, add),
        );
        add(between, target.again().fields);
        return target.unpack(grid, from..to);
    }
    let end = black.first().map_or(free.1, |black| black.layers.start);
    if let [white] = white {
        target.fields.iter_mut().for_each(ViewMut::clear);
        add(white, target.again().fields);
        target.unpack(grid, free.0..end);
    }
    if let [black] = black {
        add(black, target.again().fields);
        target.unpack(grid, end..free.1);
    }
}
