//! Patches of particles for the loops: from a basis that is known when the loops are compiled, or
//! through virtual calls.

use crate::mpm::basis::{Basis, CellLocator, Counted, FourLanes, Patch, ProductBatch, Shape};
use crate::mpm::foundation::algebra::zeros;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::moments::{InertiaTensor, WeightMoments};
use crate::mpm::foundation::packed_grid::Layout;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::foundation::simd::{Plain, Simd};
use std::marker::PhantomData;

/// Source of the patches of particles.
pub(in crate::mpm) trait PatchSource<const D: usize>: Copy + Sync {
    /// Shape of the patches.
    type Shape: Shape;

    /// Whether it is known to the compiler that a single patch contains all nodes of a particle.
    const ONE_PATCH: bool;

    /// Whether the loops serve all bases.
    const IS_DYN: bool;

    /// Returns the shape of the patches.
    fn shape(self) -> Self::Shape;

    /// Whether a single patch contains all nodes of a particle ([`Basis::ONE_PATCH`]).
    fn has_one_patch(self) -> bool;

    /// Stores the patches of four particles ([`Basis::patches_x4`]).
    fn patches_x4<S: Simd>(
        self,
        simd: S,
        grid: &Grid<D>,
        locator: &CellLocator<D>,
        particles: &Particles<D>,
        lanes: FourLanes,
        patches: &mut ProductBatch<D, Self::Shape>,
    ) -> u32;

    /// Stores the patches of a particle, one after another, in the same lane. Calls `visit` for each
    /// patch.
    fn each_patch(
        self,
        grid: &Grid<D>,
        layout: &Layout,
        particles: &Particles<D>,
        p_and_lane: (usize, usize),
        patches: &mut ProductBatch<D, Self::Shape>,
        visit: impl FnMut(&mut ProductBatch<D, Self::Shape>),
    );

    /// Computes the moments of the weights of particle `p` over all its patches.
    fn inertia(self, grid: &Grid<D>, particles: &Particles<D>, p: usize) -> InertiaTensor<D>;

    /// Returns the basis behind virtual calls.
    fn as_dyn(&self) -> &dyn DynBasis<D>;
}

/// A basis that is known when the loops are compiled.
pub(in crate::mpm) struct Static<B>(PhantomData<B>);

impl<B> Clone for Static<B> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<B> Copy for Static<B> {}

impl<B> Static<B> {
    pub(in crate::mpm) const BASIS: Self = Self(PhantomData);
}

impl<const D: usize, B: Basis> PatchSource<D> for Static<B> {
    type Shape = <B::Patch<D> as Patch<D>>::Shape;

    const ONE_PATCH: bool = B::ONE_PATCH;
    const IS_DYN: bool = false;

    #[inline(always)]
    fn shape(self) -> Self::Shape {
        Self::Shape::default()
    }

    #[inline(always)]
    fn has_one_patch(self) -> bool {
        B::ONE_PATCH
    }

    #[inline(always)]
    fn patches_x4<S: Simd>(
        self,
        simd: S,
        grid: &Grid<D>,
        locator: &CellLocator<D>,
        particles: &Particles<D>,
        lanes: FourLanes,
        patches: &mut ProductBatch<D, Self::Shape>,
    ) -> u32 {
        B::patches_x4(simd, grid, locator, particles, lanes, patches)
    }

    #[inline(always)]
    fn each_patch(
        self,
        grid: &Grid<D>,
        layout: &Layout,
        particles: &Particles<D>,
        (p, lane): (usize, usize),
        patches: &mut ProductBatch<D, Self::Shape>,
        mut visit: impl FnMut(&mut ProductBatch<D, Self::Shape>),
    ) {
        B::patches(
            grid,
            particles,
            p,
            #[inline(always)]
            |patch| {
                patch.put(lane, layout, patches);
                visit(patches);
            },
        );
    }

    #[inline(always)]
    fn inertia(self, grid: &Grid<D>, particles: &Particles<D>, p: usize) -> InertiaTensor<D> {
        inertia::<D, B>(grid, particles, p)
    }

    #[inline]
    fn as_dyn(&self) -> &dyn DynBasis<D> {
        self
    }
}

/// A basis behind virtual calls, for loops that are compiled once for all bases.
pub(in crate::mpm) trait DynBasis<const D: usize>: Sync {
    /// Returns the shape of the patches.
    fn shape(&self) -> Counted;

    /// Whether a single patch contains all nodes of a particle.
    fn has_one_patch(&self) -> bool;

    /// See [`PatchSource::patches_x4`].
    fn patches_x4(
        &self,
        grid: &Grid<D>,
        locator: &CellLocator<D>,
        particles: &Particles<D>,
        lanes: FourLanes,
        patches: &mut ProductBatch<D, Counted>,
    ) -> u32;

    /// See [`PatchSource::each_patch`].
    fn each_patch(
        &self,
        grid: &Grid<D>,
        layout: &Layout,
        particles: &Particles<D>,
        p_and_lane: (usize, usize),
        patches: &mut ProductBatch<D, Counted>,
        visit: &mut dyn FnMut(&mut ProductBatch<D, Counted>),
    );

    /// Computes the moments of the weights of particle `p` over all its patches.
    fn inertia(&self, grid: &Grid<D>, particles: &Particles<D>, p: usize) -> InertiaTensor<D>;
}

impl<const D: usize, B: Basis> DynBasis<D> for Static<B> {
    fn shape(&self) -> Counted {
        Counted::new(<B::Patch<D> as Patch<D>>::Shape::default())
    }

    fn has_one_patch(&self) -> bool {
        B::ONE_PATCH
    }

    fn patches_x4(
        &self,
        grid: &Grid<D>,
        locator: &CellLocator<D>,
        particles: &Particles<D>,
        lanes: FourLanes,
        patches: &mut ProductBatch<D, Counted>,
    ) -> u32 {
        B::patches_x4(Plain, grid, locator, particles, lanes, patches)
    }

    fn each_patch(
        &self,
        grid: &Grid<D>,
        layout: &Layout,
        particles: &Particles<D>,
        (p, lane): (usize, usize),
        patches: &mut ProductBatch<D, Counted>,
        visit: &mut dyn FnMut(&mut ProductBatch<D, Counted>),
    ) {
        B::patches(grid, particles, p, |patch| {
            patch.put(lane, layout, patches);
            visit(patches);
        });
    }

    fn inertia(&self, grid: &Grid<D>, particles: &Particles<D>, p: usize) -> InertiaTensor<D> {
        inertia::<D, B>(grid, particles, p)
    }
}

impl<const D: usize> PatchSource<D> for &dyn DynBasis<D> {
    type Shape = Counted;

    const ONE_PATCH: bool = false;
    const IS_DYN: bool = true;

    #[inline(always)]
    fn shape(self) -> Counted {
        DynBasis::shape(self)
    }

    #[inline(always)]
    fn has_one_patch(self) -> bool {
        DynBasis::has_one_patch(self)
    }

    #[inline(always)]
    fn patches_x4<S: Simd>(
        self,
        _: S,
        grid: &Grid<D>,
        locator: &CellLocator<D>,
        particles: &Particles<D>,
        lanes: FourLanes,
        patches: &mut ProductBatch<D, Counted>,
    ) -> u32 {
        DynBasis::patches_x4(self, grid, locator, particles, lanes, patches)
    }

    #[inline(always)]
    fn each_patch(
        self,
        grid: &Grid<D>,
        layout: &Layout,
        particles: &Particles<D>,
        p_and_lane: (usize, usize),
        patches: &mut ProductBatch<D, Counted>,
        mut visit: impl FnMut(&mut ProductBatch<D, Counted>),
    ) {
        DynBasis::each_patch(self, grid, layout, particles, p_and_lane, patches, &mut visit);
    }

    #[inline(always)]
    fn inertia(self, grid: &Grid<D>, particles: &Particles<D>, p: usize) -> InertiaTensor<D> {
        DynBasis::inertia(self, grid, particles, p)
    }

    #[inline]
    fn as_dyn(&self) -> &dyn DynBasis<D> {
        *self
    }
}

/// Computes mean and second moments of the weights of particle `p` over all its patches.
#[inline(always)]
pub(in crate::mpm) fn inertia<const D: usize, B: Basis>(
    grid: &Grid<D>,
    particles: &Particles<D>,
    p: usize,
) -> InertiaTensor<D> {
    let mut all = WeightMoments { first: zeros(), second: zeros() };
    let mut one = InertiaTensor { mean: zeros(), second: zeros() };
    let mut patches = 0;
    B::patches(grid, particles, p, |patch| {
        let (mean, variance) = patch.variance();
        one = InertiaTensor::diagonal(mean, variance);
        patches += 1;
        if !B::ONE_PATCH {
            let weight_moments = patch.weight_moments();
            all.first += weight_moments.first;
            all.second += weight_moments.second;
        }
    });
    // A single patch is a product of one-dimensional functions, so its tensor is diagonal.
    if B::ONE_PATCH || patches == 1 { one } else { InertiaTensor::full(&all) }
}
