//! GIMP: linear functions averaged over the particle's domain (Bardenhagen & Kober 2004, CMES 5,
//! eqs 30-32).
//!
//! `N_i = 1/(2l) int hat_i` over `[x - l, x + l]`, `N_i' = (hat_i(x + l) - hat_i(x - l))/(2l)`. In
//! several dimensions the domain stays aligned with the axes. uGIMP keeps the reference size; in
//! the contiguous-particle form (Wallstedt & Guilkey 2008) the half-length on an axis follows the
//! diagonal of F, so that domains neither part nor overlap. At walls the domain is cut off.

use super::cell_locator::{CellLocator, CellPositions};
use super::contract::{Basis, Domain};
use super::domain_1d::{AT_ONCE, Domain1d, Domain1dSimd};
use super::product::Product;
use super::product_batch::ProductBatch;
use super::weights_1d::Weights1d;
use crate::mpm::foundation::algebra::{Matrix, array};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::foundation::simd::{F64x4, LANES, Simd};

/// GIMP with domains of constant size.
#[derive(Debug, Clone, Copy)]
pub struct UniformGimp;

/// GIMP with domains that follow the deformation.
#[derive(Debug, Clone, Copy)]
pub struct ContiguousGimp;

/// Half-length (m) of the domain of particle `p`.
#[inline(always)]
fn half<const D: usize>(particles: &Particles<D>, p: usize, axis: usize, follows: bool) -> f64 {
    let followed = particles.domain.get(p).filter(|_| follows);
    followed.map_or(0.5 * particles.spacing[axis], |r| r[(axis, axis)])
}

#[inline(always)]
fn patches<const D: usize>(
    grid: &Grid<D>,
    particles: &Particles<D>,
    p: usize,
    follows: bool,
    mut visit: impl FnMut(&Product<D, AT_ONCE>),
) {
    let x = &particles.x[p];
    if grid.cell(x).is_none() {
        return;
    }
    let alone = |axis: usize| {
        let half = half(particles, p, axis, follows) * grid.inverse_h();
        Domain1d::new(grid, grid.wrapped(x, axis), half, axis)
    };
    let axes: [Domain1d; D] = array(alone(0), alone);
    let groups: usize = axes.iter().map(|axis| axis.groups).product();
    for mut group in 0..groups {
        visit(&Product(array(Weights1d::NONE, |axis| {
            let along = axes[axis].along(grid, axis, group % axes[axis].groups);
            group /= axes[axis].groups;
            along
        })));
    }
}

/// Patches of four particles; the mask has those with one group of functions along each axis.
#[inline(always)]
fn patches_x4<S: Simd, const D: usize>(
    simd: S,
    (grid, locator): (&Grid<D>, &CellLocator<D>),
    particles: &Particles<D>,
    (first, lane): (usize, usize),
    follows: bool,
    patches: &mut ProductBatch<D, AT_ONCE>,
) -> u32 {
    let CellPositions { cell, xi, inside } = locator.locate(simd, grid, &particles.x, first);
    let (mut start, mut one) = (cell, inside);
    let domains = particles.domain.get(first..).and_then(<[Matrix<D>]>::first_chunk::<LANES>);
    for axis in 0..D {
        let half = match domains {
            _ if !follows => simd.splat(0.5 * particles.spacing[axis]),
            Some(four) => simd.load(array(0.0, |k| four[k][(axis, axis)])),
            None => simd.load(last(particles, first, axis)),
        };
        let wall = (!locator.periodic[axis]).then_some(locator.ends[axis]);
        let at = cell[axis] + xi[axis];
        let extent = Domain1dSimd::<S>::new(at, half * locator.inverse_h, wall);
        let along = extent.along(simd, locator.h, locator.inverse_h);
        along.put(lane / LANES, locator.needs, &mut patches.axes[axis]);
        start[axis] = extent.first;
        if wall.is_none() && !start[axis].are_in(0.0, locator.ends[axis]) {
            start[axis] = simd.load(beyond_seam(grid, axis, start[axis].into()));
        }
        let spare = extent.spare();
        if !spare.are_in(0.0, f64::INFINITY) {
            one &= not_below_zero(spare.into());
        }
    }
    patches.put_starts(lane, locator.starts(&start));
    one
}

/// Half-lengths of the last domains.
#[cold]
#[inline(never)]
fn last<const D: usize>(particles: &Particles<D>, first: usize, axis: usize) -> [f64; LANES] {
    array(0.0, |k| half(particles, first + k, axis, true))
}

/// First nodes of domains, some of them before the first node of a periodic axis.
#[cold]
#[inline(never)]
fn beyond_seam<const D: usize>(grid: &Grid<D>, axis: usize, first: [f64; LANES]) -> [f64; LANES] {
    first.map(|first| grid.wrap_signed(first, axis) as f64)
}

/// Mask of lanes that are not below zero.
#[cold]
#[inline(never)]
fn not_below_zero(four: [f64; LANES]) -> u32 {
    (0..LANES).map(|k| u32::from(four[k] >= 0.0) << k).sum()
}

macro_rules! gimp {
    ($name:ident, $domain:ident) => {
        impl Basis for $name {
            const DEGREE: u8 = 1;
            const DOMAIN: Domain = Domain::$domain;

            const ONE_PATCH: bool = false;

            type Patch<const D: usize> = Product<D, AT_ONCE>;

            fn count(cells: usize, periodic: bool) -> usize {
                cells + usize::from(!periodic)
            }

            fn abscissa(index: usize, _: usize, _: bool) -> f64 {
                index as f64
            }

            #[inline(always)]
            fn patches<const D: usize>(
                grid: &Grid<D>,
                particles: &Particles<D>,
                p: usize,
                visit: impl FnMut(&Product<D, AT_ONCE>),
            ) {
                patches(grid, particles, p, Self::DOMAIN == Domain::Follows, visit);
            }

            #[inline(always)]
            fn patches_x4<S: Simd, const D: usize>(
                simd: S,
                grid: (&Grid<D>, &CellLocator<D>),
                particles: &Particles<D>,
                at: (usize, usize),
                patches: &mut ProductBatch<D, AT_ONCE>,
            ) -> u32 {
                patches_x4(simd, grid, particles, at, Self::DOMAIN == Domain::Follows, patches)
            }

            /// Three nodes along an axis while the domain is not longer than a cell.
            fn support(dimension: usize) -> u64 {
                3_u64.pow(dimension as u32)
            }
        }
    };
}

gimp!(UniformGimp, Fixed);
gimp!(ContiguousGimp, Follows);
