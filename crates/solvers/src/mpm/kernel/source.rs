//! Patches of particles for the loops: from a basis that is known when the loops are compiled, or
//! through function pointers.

use crate::mpm::basis::{
    Basis, CellLocator, CountedShape, FourLanes, Patch, PatchShape, ProductBatch,
};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::moments::WeightMoments;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::foundation::simd::{Plain, Simd};
use std::marker::PhantomData;

/// Particles, the grid, and the data that locates particles.
pub(in crate::mpm) struct ParticlesOnGrid<'a, const D: usize> {
    pub(in crate::mpm) particles: &'a Particles<D>,
    pub(in crate::mpm) grid: &'a Grid<D>,
    pub(in crate::mpm) locator: CellLocator<D>,
}

/// Source of the patches of particles.
pub(in crate::mpm) trait PatchSource<const D: usize>: Copy {
    /// Shape of the patches.
    type Form: PatchShape;

    /// Whether the loops serve all bases.
    const IS_DYN: bool = false;

    /// Returns the shape of the patches.
    fn shape(self) -> Self::Form;

    /// Whether a single patch contains all nodes of a particle ([`Basis::ONE_PATCH`]).
    fn has_one_patch(self) -> bool;

    /// Stores the patches of four particles ([`Basis::patches_x4`]).
    fn patches_x4<S: Simd>(
        self,
        simd: S,
        at: &ParticlesOnGrid<'_, D>,
        lanes: FourLanes,
        patches: &mut ProductBatch<D, Self::Form>,
    ) -> u32;

    /// Stores the patches of a particle, one after another, in the same lane. Calls `visit` for
    /// each patch.
    fn each_patch(
        self,
        at: &ParticlesOnGrid<'_, D>,
        p_and_lane: (usize, usize),
        patches: &mut ProductBatch<D, Self::Form>,
        visit: impl FnMut(&mut ProductBatch<D, Self::Form>),
    );

    /// Computes the moments of the weights of particle `p` over all its patches.
    fn inertia(self, at: &ParticlesOnGrid<'_, D>, p: usize) -> WeightMoments<D>;

    /// Returns the source for loops that serve all bases.
    fn for_any_basis(self) -> AnyBasis<D>;
}

/// A basis that is known when the loops are compiled.
pub(in crate::mpm) struct Static<B>(PhantomData<B>);

impl<B> Static<B> {
    pub(in crate::mpm) const BASIS: Self = Self(PhantomData);
}

impl<B> Clone for Static<B> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<B> Copy for Static<B> {}

impl<const D: usize, B: Basis> PatchSource<D> for Static<B> {
    type Form = <B::Patch<D> as Patch<D>>::ShapeOfPatch;

    #[inline(always)]
    fn shape(self) -> Self::Form {
        <B::Patch<D> as Patch<D>>::ShapeOfPatch::default()
    }

    #[inline(always)]
    fn has_one_patch(self) -> bool {
        B::ONE_PATCH
    }

    #[inline(always)]
    fn patches_x4<S: Simd>(
        self,
        simd: S,
        at: &ParticlesOnGrid<'_, D>,
        lanes: FourLanes,
        patches: &mut ProductBatch<D, Self::Form>,
    ) -> u32 {
        B::patches_x4(simd, at.grid, &at.locator, at.particles, lanes, patches)
    }

    #[inline(always)]
    fn each_patch(
        self,
        at: &ParticlesOnGrid<'_, D>,
        p_and_lane: (usize, usize),
        patches: &mut ProductBatch<D, Self::Form>,
        visit: impl FnMut(&mut ProductBatch<D, Self::Form>),
    ) {
        each_patch::<D, B, _>(at, p_and_lane, patches, visit);
    }

    #[inline(always)]
    fn inertia(self, at: &ParticlesOnGrid<'_, D>, p: usize) -> WeightMoments<D> {
        inertia::<D, B>(at.grid, at.particles, p)
    }

    fn for_any_basis(self) -> AnyBasis<D> {
        AnyBasis {
            shape: CountedShape::new(<Self as PatchSource<D>>::shape(self)),
            has_one_patch: B::ONE_PATCH,
            patches_x4: |at, lanes, patches| {
                B::patches_x4(Plain, at.grid, &at.locator, at.particles, lanes, patches)
            },
            each_patch: |at, p_and_lane, patches, visit| {
                each_patch::<D, B, _>(at, p_and_lane, patches, visit);
            },
            inertia: |at, p| inertia::<D, B>(at.grid, at.particles, p),
        }
    }
}

#[inline(always)]
fn each_patch<const D: usize, B: Basis, W: PatchShape>(
    at: &ParticlesOnGrid<'_, D>,
    (p, lane): (usize, usize),
    patches: &mut ProductBatch<D, W>,
    mut visit: impl FnMut(&mut ProductBatch<D, W>),
) {
    B::patches(
        at.grid,
        at.particles,
        p,
        #[inline(always)]
        |patch| {
            patch.put(lane, &at.locator.layout, patches);
            visit(patches);
        },
    );
}

type CountedBatch<const D: usize> = ProductBatch<D, CountedShape>;

type EachPatch<const D: usize> = fn(
    &ParticlesOnGrid<'_, D>,
    (usize, usize),
    &mut CountedBatch<D>,
    &mut dyn FnMut(&mut CountedBatch<D>),
);

/// A basis behind function pointers, for loops that are compiled once for all bases.
#[derive(Clone, Copy)]
pub(in crate::mpm) struct AnyBasis<const D: usize> {
    shape: CountedShape,
    has_one_patch: bool,
    patches_x4: fn(&ParticlesOnGrid<'_, D>, FourLanes, &mut CountedBatch<D>) -> u32,
    each_patch: EachPatch<D>,
    inertia: fn(&ParticlesOnGrid<'_, D>, usize) -> WeightMoments<D>,
}

impl<const D: usize> PatchSource<D> for AnyBasis<D> {
    type Form = CountedShape;

    const IS_DYN: bool = true;

    #[inline(always)]
    fn shape(self) -> CountedShape {
        self.shape
    }

    #[inline(always)]
    fn has_one_patch(self) -> bool {
        self.has_one_patch
    }

    #[inline(always)]
    fn patches_x4<S: Simd>(
        self,
        _: S,
        at: &ParticlesOnGrid<'_, D>,
        lanes: FourLanes,
        patches: &mut CountedBatch<D>,
    ) -> u32 {
        (self.patches_x4)(at, lanes, patches)
    }

    #[inline(always)]
    fn each_patch(
        self,
        at: &ParticlesOnGrid<'_, D>,
        p_and_lane: (usize, usize),
        patches: &mut CountedBatch<D>,
        mut visit: impl FnMut(&mut CountedBatch<D>),
    ) {
        (self.each_patch)(at, p_and_lane, patches, &mut visit);
    }

    #[inline(always)]
    fn inertia(self, at: &ParticlesOnGrid<'_, D>, p: usize) -> WeightMoments<D> {
        (self.inertia)(at, p)
    }

    fn for_any_basis(self) -> Self {
        self
    }
}

/// Computes mean and second moments of the weights of particle `p` over all its patches.
#[inline(always)]
pub(in crate::mpm) fn inertia<const D: usize, B: Basis>(
    grid: &Grid<D>,
    particles: &Particles<D>,
    p: usize,
) -> WeightMoments<D> {
    let (mut all, mut one, mut patches) = (WeightMoments::zero(), WeightMoments::zero(), 0);
    B::patches(grid, particles, p, |patch| {
        let (mean, variance) = patch.variance();
        one = WeightMoments::diagonal(mean, variance);
        patches += 1;
        if !B::ONE_PATCH {
            let weight_moments = patch.weight_moments();
            all.mean += weight_moments.mean;
            all.second += weight_moments.second;
        }
    });
    // A single patch is a product of one-dimensional functions, so its tensor is diagonal.
    if B::ONE_PATCH || patches == 1 { one } else { all.about_mean() }
}
