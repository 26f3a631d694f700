//! G2P: velocity, first moment and gradient, computed in one loop over the nodes of a particle.

use super::batch::{ALL, Batch, ParticleBatches, divide, put_columns};
use super::contract::G2pRequest;
use super::source::{AnyBasis, PatchSource};
use crate::mpm::basis::{ProductBatch, WeightNeeds};
use crate::mpm::foundation::algebra::Matrix;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::moments::WeightMoments;
use crate::mpm::foundation::packed_grid::FieldView;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::foundation::simd::{BATCH, F64x4, LANES, Plain, Simd, SimdPass, components};
use std::hint::black_box;
use std::ops::Range;

/// G2P pass. Velocities and accelerations are in one packed field if [`are_beside`] returns true,
/// otherwise in two.
pub(in crate::mpm) struct Gather<'a, const D: usize, P> {
    pub(in crate::mpm) grid: &'a Grid<D>,
    pub(in crate::mpm) particles: &'a Particles<D>,
    pub(in crate::mpm) range: Range<usize>,
    pub(in crate::mpm) request: G2pRequest<'a, D>,
    pub(in crate::mpm) fields: [FieldView<'a>; 2],
    pub(in crate::mpm) source: P,
}

/// Whether one packed field contains both velocities and accelerations, so that nodes are visited
/// once. In 1-D and 2-D the four numbers of a node are sufficient.
#[inline]
pub(in crate::mpm) const fn are_beside<const D: usize>() -> bool {
    2 * D <= LANES
}

struct G2pSums<S: Simd, const D: usize> {
    change: [S::F64x4; BATCH],
    velocity: [S::F64x4; BATCH],
    moment: [[S::F64x4; D]; BATCH],
    fit: [[S::F64x4; D]; BATCH],
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
            fit: [[zero; D]; BATCH],
            gradient: [[zero; D]; BATCH],
        }
    }

    /// Clears the sums of the particles for which `left_out` returns true. Matrices are cleared
    /// only if a pass uses them.
    #[inline(always)]
    fn reset(&mut self, simd: S, moments: bool, gradients: bool, left_out: impl Fn(usize) -> bool) {
        let zero = simd.splat(0.0);
        for lane in 0..BATCH {
            if !left_out(lane) {
                continue;
            }
            (self.change[lane], self.velocity[lane]) = (zero, zero);
            if moments {
                (self.moment[lane], self.fit[lane]) = ([zero; D], [zero; D]);
            }
            if gradients {
                self.gradient[lane] = [zero; D];
            }
        }
    }
}

/// Adds the term of a patch, or stores it if each particle has only one patch.
#[inline(always)]
fn put<F: F64x4>(sum: &mut F, term: F, has_one_patch: bool) {
    if has_one_patch {
        *sum = term;
    } else {
        *sum += term;
    }
}

impl<const D: usize, P: PatchSource<D>> Gather<'_, D, P> {
    /// Whether the request needs moments, either directly or divided by D_p.
    #[inline]
    fn takes_moments(&self) -> bool {
        self.request.moment.is_some() || self.request.fit.is_some()
    }

    /// Adds the sums over the nodes of the patches in `lanes` to `sums`. `moments` is the result of
    /// [`Self::takes_moments`].
    #[inline(always)]
    fn gather_patches<S: Simd>(
        &self,
        simd: S,
        patches: &mut Batch<P, D>,
        lanes: Range<usize>,
        of_all: Option<&WeightMoments<D>>,
        moments: bool,
        sums: &mut G2pSums<S, D>,
    ) {
        let ([velocity, acceleration], request) = (&self.fields, &self.request);
        let one = self.source.has_one_patch();
        let beside = request.change.is_some() && are_beside::<D>();
        if const { !are_beside::<D>() } && request.change.is_some() {
            for lane in lanes.clone() {
                put(&mut sums.change[lane], patches.gather(simd, lane, acceleration), one);
            }
        }
        let mut is_summed = request.mix.is_none() && request.advected.is_none() && !beside;
        if moments {
            let h = self.grid.h;
            patches.compute_offsets(simd, &lanes, h, of_all.map(|of_all| &of_all.mean));
            for lane in lanes.clone() {
                let (sum, moment) = patches.gather_moment(simd, lane, velocity);
                for axis in 0..D {
                    put(&mut sums.moment[lane][axis], moment[axis], one);
                }
                if request.fit.is_some() {
                    let fit = divide::<P, S, D>(simd, patches, lane, of_all, &moment, 0, h);
                    for axis in 0..D {
                        put(&mut sums.fit[lane][axis], fit[axis], one);
                    }
                }
                if !is_summed {
                    put(&mut sums.velocity[lane], sum, one);
                }
            }
            is_summed = true;
        }
        if request.gradient.is_some() {
            for lane in lanes.clone() {
                let (sum, gradient) = patches.gather_gradient(simd, lane, velocity);
                for axis in 0..D {
                    put(&mut sums.gradient[lane][axis], gradient[axis], one);
                }
                if !is_summed {
                    put(&mut sums.velocity[lane], sum, one);
                }
            }
            is_summed = true;
        }
        if !is_summed {
            for lane in lanes {
                put(&mut sums.velocity[lane], patches.gather(simd, lane, velocity), one);
            }
        }
    }

    /// Writes the sums of a batch to the columns of the request, starting at entry `first`.
    #[inline(always)]
    fn write<S: Simd>(&mut self, first: usize, moments: bool, sums: &G2pSums<S, D>) {
        // Indices are below BATCH. The remainder only avoids a bounds check.
        let (request, count) = (&mut self.request, BATCH.min(self.range.len() - first));
        if let (Some(value), Some(dt)) = (&mut request.value, request.change) {
            let (change, at) =
                if const { are_beside::<D>() } { (&sums.velocity, D) } else { (&sums.change, 0) };
            let value = &mut value[first..][..count];
            for k in 0..count {
                value[k] += components::<D>(change[k % BATCH] * dt, at);
            }
        }
        if let (Some(value), Some((keep, factor))) = (&mut request.value, request.mix) {
            let value = &mut value[first..][..count];
            for k in 0..count {
                let velocity = components::<D>(sums.velocity[k % BATCH] * factor, 0);
                value[k] = value[k] * keep + velocity;
            }
        }
        if moments {
            let parts = [(&mut request.moment, &sums.moment), (&mut request.fit, &sums.fit)];
            for (part, sums) in parts {
                if let Some(part) = part {
                    put_all(&mut part[first..][..count], sums);
                }
            }
        }
        if let Some(gradient) = &mut request.gradient {
            put_all(&mut gradient[first..][..count], &sums.gradient);
        }
        if let Some((dt, advected)) = &mut request.advected {
            let x = &self.particles.positions()[self.range.start + first..][..count];
            let advected = &mut advected[first..][..count];
            for k in 0..count {
                advected[k] = x[k] + components::<D>(sums.velocity[k % BATCH] * *dt, 0);
            }
        }
    }
}

/// Writes the matrices of a batch.
#[inline(always)]
fn put_all<const D: usize, F: F64x4>(matrices: &mut [Matrix<D>], columns: &[[F; D]; BATCH]) {
    for k in 0..matrices.len() {
        put_columns(&mut matrices[k], &columns[k % BATCH], 0);
    }
}

impl<const D: usize, P: PatchSource<D>> SimdPass for Gather<'_, D, P> {
    // In 3-D, the sums along several axes and their factors need more than 16 registers.
    const NEEDS_AVX512: bool = D == 3;

    #[inline(always)]
    fn run<S: Simd>(mut self, simd: S) {
        let slopes = self.request.gradient.is_some();
        let offsets = self.takes_moments();
        let layout = self.fields[0].layout;
        let mut patches = ProductBatch::new(self.source.shape());
        let needs = WeightNeeds { slopes, offsets };
        let batches = ParticleBatches::new(self.source, self.grid, layout, self.particles, needs);
        let mut sums = G2pSums::zero(simd);
        for first in self.range.clone().step_by(BATCH) {
            if !self.source.has_one_patch() {
                sums.reset(simd, offsets, slopes, |_| true);
            }
            let seen = batches.visit(
                simd,
                first,
                &mut patches,
                #[inline(always)]
                |patches, lanes, of_all| {
                    self.gather_patches(simd, patches, lanes, of_all, offsets, &mut sums);
                },
            );
            // The sums of particles outside the grid are zero.
            let unseen = !seen & ALL >> BATCH.saturating_sub(self.particles.len() - first);
            if unseen != 0 {
                sums.reset(simd, offsets, slopes, |lane| unseen >> lane & 1 == 1);
            }
            self.write(first - self.range.start, offsets, &sums);
        }
    }

    fn run_plain(self) {
        let Self { grid, particles, range, request, fields, source } = self;
        let source = black_box(source.for_any_basis());
        Gather { grid, particles, range, request, fields, source }.run_for_any_basis();
    }
}

impl<const D: usize> Gather<'_, D, AnyBasis<D>> {
    /// Runs the loop, like `Scatter::run_for_any_basis`.
    #[inline(never)]
    fn run_for_any_basis(self) {
        self.run(Plain);
    }
}
