//! Batches of particles: their patches of nodes, the moments of their weights, and the conversion
//! of matrices to registers.

use super::source::{ParticlesOnGrid, PatchSource};
use crate::mpm::basis::{CellLocator, FourLanes, ProductBatch, WeightNeeds};
use crate::mpm::foundation::algebra::{Matrix, array, zeros};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::moments::WeightMoments;
use crate::mpm::foundation::packed_grid::Layout;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::foundation::simd::{BATCH, LANES, Simd};
use std::hint::black_box;
use std::ops::Range;

pub(in crate::mpm) type Batch<P, const D: usize> = ProductBatch<D, <P as PatchSource<D>>::Form>;

/// Function that [`ParticleBatches::visit`] calls. A `dyn FnMut` would contain its code twice, the
/// second time for `FnOnce`.
trait Visitor<W, const D: usize> {
    fn call(
        &mut self,
        patches: &mut ProductBatch<D, W>,
        lanes: Range<usize>,
        of_all: Option<&WeightMoments<D>>,
    );
}

impl<W, F, const D: usize> Visitor<W, D> for F
where
    F: FnMut(&mut ProductBatch<D, W>, Range<usize>, Option<&WeightMoments<D>>),
{
    fn call(
        &mut self,
        patches: &mut ProductBatch<D, W>,
        lanes: Range<usize>,
        of_all: Option<&WeightMoments<D>>,
    ) {
        self(patches, lanes, of_all);
    }
}

pub(in crate::mpm) const ALL: u32 = (1 << BATCH) - 1;

/// Batches of particles, with the data that locates their patches. The patches are not stored in
/// this struct, because its fields would then be reloaded after every store of a weight.
pub(in crate::mpm) struct ParticleBatches<'a, P, const D: usize> {
    at: ParticlesOnGrid<'a, D>,
    needs: WeightNeeds,
    source: P,
}

impl<'a, P: PatchSource<D>, const D: usize> ParticleBatches<'a, P, D> {
    #[inline(always)]
    pub(in crate::mpm) fn new(
        source: P,
        grid: &'a Grid<D>,
        layout: Layout,
        particles: &'a Particles<D>,
        needs: WeightNeeds,
    ) -> Self {
        let locator = CellLocator::new(grid, layout, needs);
        Self { at: ParticlesOnGrid { particles, grid, locator }, needs, source }
    }

    /// Calls `visit` for the patches of the batch that starts at particle `first`. The arguments of
    /// `visit` are the patches, their range of lanes (particle `first + k` is lane k), and, for a
    /// particle with several patches, the weight moments over all these patches. Particles outside
    /// the grid are skipped.
    ///
    /// For bases with one patch, returns the mask of the lanes with particles inside the grid;
    /// otherwise [`ALL`].
    #[inline(always)]
    pub(in crate::mpm) fn visit<S: Simd>(
        &self,
        simd: S,
        first: usize,
        patches: &mut Batch<P, D>,
        mut visit: impl FnMut(&mut Batch<P, D>, Range<usize>, Option<&WeightMoments<D>>),
    ) -> u32 {
        if const { P::IS_DYN } {
            // Without the type of `visit`, the compiler does not copy its loop to each call.
            let visit: &mut dyn Visitor<P::Form, D> = black_box(&mut visit);
            return self.visit_with(simd, first, patches, |patches, lanes, of_all| {
                visit.call(patches, lanes, of_all);
            });
        }
        self.visit_with(simd, first, patches, visit)
    }

    #[inline(always)]
    fn visit_with<S: Simd>(
        &self,
        simd: S,
        first: usize,
        patches: &mut Batch<P, D>,
        mut visit: impl FnMut(&mut Batch<P, D>, Range<usize>, Option<&WeightMoments<D>>),
    ) -> u32 {
        let Self { at, source, .. } = self;
        let count = BATCH.min(at.particles.len() - first);
        let (mut one, mut lane) = (0, 0);
        while lane < count {
            let lanes = FourLanes { particle: first + lane, lane };
            one |= source.patches_x4(simd, at, lanes, patches) << lane;
            lane += LANES;
        }
        if source.has_one_patch() {
            let (mut rest, mut lane) = (one, 0);
            while rest != 0 {
                let from = lane + rest.trailing_zeros();
                lane = from + (one >> from).trailing_ones();
                visit(patches, from as usize..lane as usize, None);
                rest = one >> lane;
            }
            return one;
        }
        let mut lane = 0;
        while lane < count {
            let to = lane + (one >> lane).trailing_ones() as usize;
            if to > lane {
                visit(patches, lane..to, None);
                lane = to;
                continue;
            }
            let of_all =
                if self.needs.offsets { Some(source.inertia(at, first + lane)) } else { None };
            source.each_patch(
                at,
                (first + lane, lane),
                patches,
                #[inline(always)]
                |patches| visit(patches, lane..lane + 1, of_all.as_ref()),
            );
            lane += 1;
        }
        ALL
    }
}

/// Loads the columns of a matrix, each into a register, starting at lane `from`.
#[inline(always)]
pub(super) fn columns<S: Simd, const D: usize>(
    simd: S,
    matrix: &Matrix<D>,
    from: usize,
) -> [S::F64x4; D] {
    array(simd.load([0.0; 4]), |axis| {
        let mut lanes = [0.0; 4];
        for row in 0..D {
            lanes[(from + row) % LANES] = matrix[(row, axis)];
        }
        simd.load(lanes)
    })
}

/// Writes the columns of a matrix, which start at lane `from`. Numbers are written one by one,
/// because store-to-load forwarding fails for a matrix that is stored as a whole.
#[inline(always)]
pub(super) fn put_columns<const D: usize, F: Into<[f64; 4]> + Copy>(
    matrix: &mut Matrix<D>,
    columns: &[F; D],
    from: usize,
) {
    for axis in 0..D {
        let lanes = columns[axis].into();
        for row in 0..D {
            matrix[(row, axis)] = lanes[(from + row) % LANES];
        }
    }
}

/// Computes the columns of `matrix D_p^-1`, each in a register, starting at lane `from`. Uses the
/// inertia tensor of all patches of the particle if given, otherwise the tensor of its only patch.
#[inline(always)]
pub(super) fn divide<P: PatchSource<D>, S: Simd, const D: usize>(
    simd: S,
    patches: &Batch<P, D>,
    lane: usize,
    of_all: Option<&WeightMoments<D>>,
    matrix: &[S::F64x4; D],
    from: usize,
    h: f64,
) -> [S::F64x4; D] {
    let Some(of_all) = of_all else { return patches.divide::<S>(lane, matrix) };
    let mut whole = zeros();
    put_columns(&mut whole, matrix, from);
    columns(simd, &of_all.divide(&whole, h), from)
}
