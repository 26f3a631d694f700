//! Particles of G2P split among threads.

use super::request::G2pRequest;
use crate::mpm::foundation::simd::BATCH;
use crate::mpm::foundation::threads::{FEW, join, split};
use std::ops::Range;

impl<const D: usize> G2pRequest<'_, D> {
    /// Requests for the first `count` particles and for the others.
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

/// Runs `work` for parts of `range`, each with the request for its particles.
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
