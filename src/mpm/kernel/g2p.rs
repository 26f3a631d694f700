//! From nodes to particles: velocity, first moment and gradient in one visit.

use super::{
    batch::{ALL, Batch, ParticleBatches},
    request::G2pRequest,
};
use crate::mpm::{
    algebra::{Matrix, Vector},
    basis::{Basis, PatchBatch, WeightNeeds},
    grid::Grid,
    packed_grid::FieldView,
    particles::Particles,
    simd::{BATCH, F64x4, LANES, Pass, Simd, components},
};
use std::{marker::PhantomData, ops::Range};

/// Takes what `takes` says from two packed fields: velocities, and accelerations; from one where
/// [`are_beside`] says so.
pub(in crate::mpm) struct Gather<'a, const D: usize, B> {
    pub(in crate::mpm) grid: &'a Grid<D>,
    pub(in crate::mpm) particles: &'a Particles<D>,
    /// The particles that take.
    pub(in crate::mpm) these: Range<usize>,
    pub(in crate::mpm) takes: G2pRequest<'a, D>,
    pub(in crate::mpm) fields: [FieldView<'a>; 2],
    pub(in crate::mpm) basis: PhantomData<B>,
}

/// Whether velocities and accelerations stand in one field, side by side, where both are wanted: four
/// numbers hold both in 1-D and 2-D, and the nodes are visited once.
pub(in crate::mpm) const fn are_beside<const D: usize>() -> bool {
    2 * D <= LANES
}

/// Writes these columns, number by number: a matrix that went by memory as a whole would be waited for.
#[inline(always)]
fn put_columns<const D: usize, F: Into<[f64; 4]> + Copy>(matrix: &mut Matrix<D>, columns: &[F; D]) {
    for axis in 0..D {
        let lanes = columns[axis].into();
        for row in 0..D {
            matrix[(row, axis)] = lanes[row];
        }
    }
}

/// What several particles have sums so far.
struct G2pSums<S: Simd, const D: usize> {
    change: [S::F64x4; BATCH],
    velocity: [S::F64x4; BATCH],
    moment: [[S::F64x4; D]; BATCH],
    gradient: [[S::F64x4; D]; BATCH],
}

impl<S: Simd, const D: usize> G2pSums<S, D> {
    #[inline(always)]
    fn zero(simd: S) -> Self {
        let zero = simd.splat(0.0);
        Self {
            change: [zero; BATCH],
            velocity: [zero; BATCH],
            moment: [[zero; D]; BATCH],
            gradient: [[zero; D]; BATCH],
        }
    }

    /// Nothing for some of them.
    #[inline(always)]
    fn reset(&mut self, simd: S, these: impl Fn(usize) -> bool) {
        let zero = Self::zero(simd);
        for lane in (0..BATCH).filter(|lane| these(*lane)) {
            self.change[lane] = zero.change[lane];
            self.velocity[lane] = zero.velocity[lane];
            self.moment[lane] = zero.moment[lane];
            self.gradient[lane] = zero.gradient[lane];
        }
    }
}

/// Takes what a patch gives: the sum over all patches, of which there may be one only.
#[inline(always)]
fn put<B: Basis, F: F64x4>(sum: &mut F, term: F) {
    if B::ONE_PATCH {
        *sum = term;
    } else {
        *sum += term;
    }
}

impl<const D: usize, B: Basis> Gather<'_, D, B> {
    /// Adds what the nodes of patches give.
    #[inline(always)]
    fn gather_patches<S: Simd>(
        &self,
        simd: S,
        patches: &mut Batch<B, D>,
        (lanes, mean): (Range<usize>, Option<&Vector<D>>),
        sums: &mut G2pSums<S, D>,
    ) {
        let ([velocity, acceleration], takes) = (&self.fields, &self.takes);
        let beside = takes.change.is_some() && are_beside::<D>();
        if takes.change.is_some() && !beside {
            for lane in lanes.clone() {
                put::<B, _>(&mut sums.change[lane], patches.gather(simd, lane, acceleration));
            }
        }
        let mut is_summed = takes.mix.is_none() && takes.advected.is_none() && !beside;
        if takes.moment.is_some() {
            patches.compute_offsets(simd, &lanes, self.grid.h, mean);
            for lane in lanes.clone() {
                let (sum, moment) = patches.gather_moment(simd, lane, velocity);
                for axis in 0..D {
                    put::<B, _>(&mut sums.moment[lane][axis], moment[axis]);
                }
                if !is_summed {
                    put::<B, _>(&mut sums.velocity[lane], sum);
                }
            }
            is_summed = true;
        }
        if takes.gradient.is_some() {
            for lane in lanes.clone() {
                let (sum, gradient) = patches.gather_gradient(simd, lane, velocity);
                for axis in 0..D {
                    put::<B, _>(&mut sums.gradient[lane][axis], gradient[axis]);
                }
                if !is_summed {
                    put::<B, _>(&mut sums.velocity[lane], sum);
                }
            }
            is_summed = true;
        }
        if !is_summed {
            for lane in lanes {
                put::<B, _>(&mut sums.velocity[lane], patches.gather(simd, lane, velocity));
            }
        }
    }

    /// Gives the particles from `first` of these on what they have sums.
    #[inline(always)]
    fn write<S: Simd>(&mut self, first: usize, sums: &G2pSums<S, D>) {
        let takes = &mut self.takes;
        if let Some(value) = &mut takes.value {
            let value = value[first..].iter_mut();
            if let Some(dt) = takes.change {
                let (change, at) =
                    if are_beside::<D>() { (&sums.velocity, D) } else { (&sums.change, 0) };
                for (value, change) in value.zip(change) {
                    *value += components::<D>(*change * dt, at);
                }
            }
        }
        if let (Some(value), Some((keep, factor))) = (&mut takes.value, takes.mix) {
            for (value, velocity) in value[first..].iter_mut().zip(&sums.velocity) {
                *value = *value * keep + components::<D>(*velocity * factor, 0);
            }
        }
        if let Some(moment) = &mut takes.moment {
            for (moment, sums) in moment[first..].iter_mut().zip(&sums.moment) {
                put_columns(moment, sums);
            }
        }
        if let Some(gradient) = &mut takes.gradient {
            for (gradient, sums) in gradient[first..].iter_mut().zip(&sums.gradient) {
                put_columns(gradient, sums);
            }
        }
        if let Some((dt, advected)) = &mut takes.advected {
            let x = &self.particles.positions()[self.these.start + first..];
            for ((advected, x), sums) in advected[first..].iter_mut().zip(x).zip(&sums.velocity) {
                *advected = x + components::<D>(*sums * *dt, 0);
            }
        }
    }
}

impl<const D: usize, B: Basis> Pass for Gather<'_, D, B> {
    // Sums along two axes at once, with all that they are multiplied by.
    const NEEDS_32_REGISTERS: bool = true;

    #[inline(always)]
    fn run<S: Simd>(mut self, simd: S) {
        let (slopes, offsets) = (self.takes.gradient.is_some(), self.takes.moment.is_some());
        let layout = self.fields[0].layout;
        let mut patches = Batch::<B, D>::none();
        let needs = WeightNeeds { slopes, offsets };
        let batches = ParticleBatches::<B, D>::new((self.grid, layout), self.particles, needs);
        let mut sums = G2pSums::zero(simd);
        for first in self.these.clone().step_by(BATCH) {
            if !B::ONE_PATCH {
                sums = G2pSums::zero(simd);
            }
            let seen = batches.visit(
                simd,
                first,
                &mut patches,
                #[inline(always)]
                |patches, lanes, of_all| {
                    self.gather_patches(
                        simd,
                        patches,
                        (lanes, of_all.map(|of_all| &of_all.mean)),
                        &mut sums,
                    );
                },
            );
            if seen != ALL {
                sums.reset(simd, |lane| seen >> lane & 1 == 0);
            }
            self.write(first - self.these.start, &sums);
        }
    }
}
