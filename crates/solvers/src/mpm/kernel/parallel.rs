//! Two-colour schedule of P2G on threads, and the division of G2P particles among threads.
//!
//! Even blocks and the odd blocks between them form a binary tree of joins. An odd block runs on
//! any thread after both its neighbours. The sums at the nodes are copied from the packed field of
//! P2G to the arrays of the grid. A layer of nodes is copied as soon as no later block adds to it,
//! while its nodes are in the cache.

use super::colouring::ParticleBlock;
use super::contract::G2pRequest;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::packed_grid::{Columns, FieldViewMut, PackedNode, layers};
use crate::mpm::foundation::simd::BATCH;
use crate::mpm::foundation::threads::{FEW, join, split};
use std::ops::Range;

/// Target of P2G: the packed field in which nodal values are summed, and the arrays of the grid to
/// which the sums are copied (see `packed_grid`).
#[derive(Debug)]
pub(in crate::mpm) struct Target<'a, const D: usize, N> {
    pub(in crate::mpm) field: FieldViewMut<'a, N>,
    pub(in crate::mpm) columns: Columns<'a, D>,
}

impl<const D: usize, N: PackedNode> Target<'_, D, N> {
    fn reborrow(&mut self) -> Target<'_, D, N> {
        Target { field: self.field.reborrow(), columns: self.columns.reborrow() }
    }

    fn split_at(self, grid: &Grid<D>, layer: usize) -> (Self, Self) {
        let field = self.field.split_at::<D>(layer);
        let columns = self.columns.split_at(grid, layer);
        (Self { field: field.0, columns: columns.0 }, Self { field: field.1, columns: columns.1 })
    }
}

/// Function that adds a block of particles to a field that contains all nodes of the block.
type Add<'a, N> = dyn Fn(&ParticleBlock, FieldViewMut<'_, N>) + Sync + 'a;

/// Clears `target`, calls `add` for all blocks, each with a field that contains its nodes, and
/// copies the sums to the arrays of the grid. Odd block k shares nodes with even blocks k and k +
/// 1.
pub(in crate::mpm) fn two_colour_schedule<const D: usize, N: PackedNode>(
    grid: &Grid<D>,
    [even, odd]: [&[ParticleBlock]; 2],
    target: Target<'_, D, N>,
    add: &Add<'_, N>,
) {
    let (between, last) = odd.split_at(odd.len().min(even.len().saturating_sub(1)));
    Schedule { grid, add }.tree(0..layers(grid).end, [even, between, last], target);
}

struct Schedule<'a, const D: usize, N> {
    grid: &'a Grid<D>,
    add: &'a Add<'a, N>,
}

impl<const D: usize, N: PackedNode> Schedule<'_, D, N> {
    /// Adds even blocks, the odd blocks between them, and optionally one odd block after the last
    /// even block. No other block adds to the layers in `own`.
    fn tree(
        &self,
        own: Range<usize>,
        [even, odd, last]: [&[ParticleBlock]; 3],
        mut target: Target<'_, D, N>,
    ) {
        let end = last.first().map_or(own.end, |last| last.layers.start);
        let middle = even.len() / 2;
        let (between, done) = if middle == 0 {
            target.field.clear();
            (even, own.start..end)
        } else {
            let (layer, between) = (even[middle].layers.start, &odd[middle - 1..middle]);
            let done = between[0].layers.start..layer.max(between[0].layers.end);
            let (low, high) = target.reborrow().split_at(self.grid, layer);
            let left = [&even[..middle], &odd[..middle - 1], &[]];
            let right = [&even[middle..], &odd[middle..], &[]];
            join(
                || self.tree(own.start..done.start, left, low),
                || self.tree(done.end..end, right, high),
            );
            (between, done)
        };
        if middle == 0 || last.is_empty() {
            self.add(between, done, target.reborrow());
            return self.add(last, end..own.end, target);
        }
        let (low, high) = target.split_at(self.grid, end);
        join(|| self.add(between, done, low), || self.add(last, end..own.end, high));
    }

    /// Adds a block, if any, and then copies the layers `done` to the arrays of the grid.
    fn add(&self, block: &[ParticleBlock], done: Range<usize>, mut target: Target<'_, D, N>) {
        if let [block] = block {
            (self.add)(block, target.field.reborrow());
        }
        target.columns.unpack(self.grid, &target.field, done);
    }
}

impl<const D: usize> G2pRequest<'_, D> {
    fn split_at(self, count: usize) -> (Self, Self) {
        let Self { change, mix, .. } = self;
        let value = split(self.value, count);
        let moment = split(self.moment, count);
        let fit = split(self.fit, count);
        let gradient = split(self.gradient, count);
        let (dt, advected) = self.advected.unzip();
        let advected = split(advected, count);
        let part = |value, moment, fit, gradient, advected| Self {
            change,
            mix,
            value,
            moment,
            fit,
            gradient,
            advected: dt.zip(advected),
        };
        (
            part(value.0, moment.0, fit.0, gradient.0, advected.0),
            part(value.1, moment.1, fit.1, gradient.1, advected.1),
        )
    }
}

/// Splits `range` into parts and runs `work` for each part, with the request for its particles.
pub(in crate::mpm) fn par_split<const D: usize>(
    range: Range<usize>,
    request: G2pRequest<'_, D>,
    work: &(dyn Fn(Range<usize>, G2pRequest<'_, D>) + Sync),
) {
    if range.len() <= FEW {
        return work(range, request);
    }
    let first = (range.len() / 2).next_multiple_of(BATCH);
    let middle = range.start + first;
    let (left, right) = request.split_at(first);
    join(
        || par_split(range.start..middle, left, work),
        || par_split(middle..range.end, right, work),
    );
}
