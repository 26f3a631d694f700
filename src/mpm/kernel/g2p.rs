//! From nodes to particles: velocity, first moment and gradient in one visit.

use super::{
    batch::{ALL, ParticleBatches, Several},
    request::G2pRequest,
};
use crate::mpm::{
    algebra::{Matrix, Vector},
    basis::{Basis, Needs, PatchBatch},
    grid::Grid,
    packed_grid::View,
    particles::Particles,
    simd::{FOUR, Four, LANES, Pass, Width, part},
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
    pub(in crate::mpm) fields: [View<'a>; 2],
    pub(in crate::mpm) basis: PhantomData<B>,
}

/// Whether velocities and accelerations stand in one field, side by side, where both are wanted: four
/// numbers hold both in 1-D and 2-D, and the nodes are visited once.
pub(in crate::mpm) const fn are_beside<const D: usize>() -> bool {
    2 * D <= FOUR
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

/// What several particles have taken so far.
struct Taken<W: Width, const D: usize> {
    change: [W::Four; LANES],
    velocity: [W::Four; LANES],
    moment: [[W::Four; D]; LANES],
    gradient: [[W::Four; D]; LANES],
}

impl<W: Width, const D: usize> Taken<W, D> {
    #[inline(always)]
    fn nothing(width: W) -> Self {
        let zero = width.all(0.0);
        Self {
            change: [zero; LANES],
            velocity: [zero; LANES],
            moment: [[zero; D]; LANES],
            gradient: [[zero; D]; LANES],
        }
    }

    /// Nothing for some of them.
    #[inline(always)]
    fn forget(&mut self, width: W, these: impl Fn(usize) -> bool) {
        let nothing = Self::nothing(width);
        for lane in (0..LANES).filter(|lane| these(*lane)) {
            self.change[lane] = nothing.change[lane];
            self.velocity[lane] = nothing.velocity[lane];
            self.moment[lane] = nothing.moment[lane];
            self.gradient[lane] = nothing.gradient[lane];
        }
    }
}

/// Takes what a patch gives: the sum over all patches, of which there may be one only.
#[inline(always)]
fn put<B: Basis, F: Four>(sum: &mut F, term: F) {
    if B::ONE_PATCH {
        *sum = term;
    } else {
        *sum += term;
    }
}

impl<const D: usize, B: Basis> Gather<'_, D, B> {
    /// Adds what the nodes of patches give.
    #[inline(always)]
    fn see<W: Width>(
        &self,
        width: W,
        patches: &mut Several<B, D>,
        (lanes, mean): (Range<usize>, Option<&Vector<D>>),
        taken: &mut Taken<W, D>,
    ) {
        let ([velocity, acceleration], takes) = (&self.fields, &self.takes);
        let beside = takes.change.is_some() && are_beside::<D>();
        if takes.change.is_some() && !beside {
            for lane in lanes.clone() {
                put::<B, _>(&mut taken.change[lane], patches.gather(width, lane, acceleration));
            }
        }
        let mut is_summed = takes.mix.is_none() && takes.advected.is_none() && !beside;
        if takes.moment.is_some() {
            patches.lever(width, &lanes, self.grid.h, mean);
            for lane in lanes.clone() {
                let (sum, moment) = patches.gather_moment(width, lane, velocity);
                for axis in 0..D {
                    put::<B, _>(&mut taken.moment[lane][axis], moment[axis]);
                }
                if !is_summed {
                    put::<B, _>(&mut taken.velocity[lane], sum);
                }
            }
            is_summed = true;
        }
        if takes.gradient.is_some() {
            for lane in lanes.clone() {
                let (sum, gradient) = patches.gather_gradient(width, lane, velocity);
                for axis in 0..D {
                    put::<B, _>(&mut taken.gradient[lane][axis], gradient[axis]);
                }
                if !is_summed {
                    put::<B, _>(&mut taken.velocity[lane], sum);
                }
            }
            is_summed = true;
        }
        if !is_summed {
            for lane in lanes {
                put::<B, _>(&mut taken.velocity[lane], patches.gather(width, lane, velocity));
            }
        }
    }

    /// Gives the particles from `first` of these on what they have taken.
    #[inline(always)]
    fn give<W: Width>(&mut self, first: usize, taken: &Taken<W, D>) {
        let takes = &mut self.takes;
        if let Some(value) = &mut takes.value {
            let value = value[first..].iter_mut();
            if let Some(dt) = takes.change {
                let (change, at) =
                    if are_beside::<D>() { (&taken.velocity, D) } else { (&taken.change, 0) };
                for (value, change) in value.zip(change) {
                    *value += part::<D>(*change * dt, at);
                }
            }
        }
        if let (Some(value), Some((keep, factor))) = (&mut takes.value, takes.mix) {
            for (value, velocity) in value[first..].iter_mut().zip(&taken.velocity) {
                *value = *value * keep + part::<D>(*velocity * factor, 0);
            }
        }
        if let Some(moment) = &mut takes.moment {
            for (moment, taken) in moment[first..].iter_mut().zip(&taken.moment) {
                put_columns(moment, taken);
            }
        }
        if let Some(gradient) = &mut takes.gradient {
            for (gradient, taken) in gradient[first..].iter_mut().zip(&taken.gradient) {
                put_columns(gradient, taken);
            }
        }
        if let Some((dt, advected)) = &mut takes.advected {
            let x = &self.particles.positions()[self.these.start + first..];
            for ((advected, x), taken) in advected[first..].iter_mut().zip(x).zip(&taken.velocity) {
                *advected = x + part::<D>(*taken * *dt, 0);
            }
        }
    }
}

impl<const D: usize, B: Basis> Pass for Gather<'_, D, B> {
    // Sums along two axes at once, with all that they are multiplied by.
    const NEEDS_REGISTERS: bool = true;

    #[inline(always)]
    fn run<W: Width>(mut self, width: W) {
        let (slopes, places) = (self.takes.gradient.is_some(), self.takes.moment.is_some());
        let layout = self.fields[0].layout;
        let mut patches = Several::<B, D>::none();
        let needs = Needs { slopes, places };
        let sight = ParticleBatches::<B, D>::new((self.grid, layout), self.particles, needs);
        let mut taken = Taken::nothing(width);
        for first in self.these.clone().step_by(LANES) {
            if !B::ONE_PATCH {
                taken = Taken::nothing(width);
            }
            let seen = sight.of(
                width,
                first,
                &mut patches,
                #[inline(always)]
                |patches, lanes, of_all| {
                    self.see(
                        width,
                        patches,
                        (lanes, of_all.map(|of_all| &of_all.mean)),
                        &mut taken,
                    );
                },
            );
            if seen != ALL {
                taken.forget(width, |lane| seen >> lane & 1 == 0);
            }
            self.give(first - self.these.start, &taken);
        }
    }
}
