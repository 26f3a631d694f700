//! Particles that take from nodes, shared by par_split among threads: none waits for another.

use super::request::G2pRequest;
use crate::mpm::{
    simd::BATCH,
    threads::{join, split},
};
use std::ops::Range;

/// Particles that are not worth a thread of their own.
const FEW: usize = 1 << 14;

impl<const D: usize> G2pRequest<'_, D> {
    /// What the first `count` particles take, and what the others do.
    fn split_at(self, count: usize) -> (Self, Self) {
        let Self { change, mix, .. } = self;
        let value = split(self.value, count);
        let moment = split(self.moment, count);
        let gradient = split(self.gradient, count);
        let (dt, advected) = self.advected.unzip();
        let advected = split(advected, count);
        let part = |value, moment, gradient, advected| Self {
            change,
            mix,
            value,
            moment,
            gradient,
            advected: dt.zip(advected),
        };
        (
            part(value.0, moment.0, gradient.0, advected.0),
            part(value.1, moment.1, gradient.1, advected.1),
        )
    }
}

/// Runs `work` for parts of `these` particles, each with the targets of its particles.
pub(in crate::mpm) fn par_split<const D: usize>(
    these: Range<usize>,
    takes: G2pRequest<'_, D>,
    work: &(dyn Fn(Range<usize>, G2pRequest<'_, D>) + Sync),
) {
    if these.len() <= FEW {
        return work(these, takes);
    }
    let first = (these.len() / 2).next_multiple_of(BATCH);
    let middle = these.start + first;
    let (left, right) = takes.split_at(first);
    join(
        || par_split(these.start..middle, left, work),
        || par_split(middle..these.end, right, work),
    );
}
