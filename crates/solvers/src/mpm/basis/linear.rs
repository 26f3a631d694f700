//! Piecewise linear ("hat") functions: the basis of the original MPM.
//!
//! `N_i(x) = 1 - |x - x_i|/h` within one cell of node i (Sulsky, Chen & Schreyer 1994, eq. 2.10).
//! The gradient jumps at nodes, so the force changes abruptly when a particle crosses into another
//! cell (grid crossing).

use super::cell_locator::{CellLocator, CellPositions};
use super::contract::{Basis, Domain, FourLanes};
use super::product::Product;
use super::product_batch::ProductBatch;
use super::shape::PatchShape;
use super::weights_1d::{Weights1d, WeightsSimd};
use crate::mpm::foundation::algebra::array;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::foundation::simd::{LANES, Plain, Simd};

/// Evaluates the hat functions along an axis, at `xi` from 0 to 1 within a cell.
#[inline(always)]
fn along<S: Simd>(simd: S, xi: S::F64x4, h: f64, inverse_h: f64) -> WeightsSimd<S, 2> {
    let rest = simd.splat(1.0) - xi;
    WeightsSimd {
        weight: [rest, xi],
        slope: [simd.splat(-inverse_h), simd.splat(inverse_h)],
        offset: [simd.splat(0.0) - xi * h, rest * h],
        variance: xi * rest * h * h,
    }
}

/// Piecewise linear basis functions: tensor products of hats.
#[derive(Debug, Clone, Copy)]
pub struct Linear;

impl Basis for Linear {
    const DEGREE: u8 = 1;
    const DOMAIN: Domain = Domain::Point;

    type Patch<const D: usize> = Product<D, 2>;

    #[inline(always)]
    fn patches<const D: usize>(
        grid: &Grid<D>,
        particles: &Particles<D>,
        p: usize,
        mut visit: impl FnMut(&Product<D, 2>),
    ) {
        let Some((cell, xi)) = grid.locate(&particles.x[p]) else { return };
        visit(&Product(array(Weights1d::NONE, |axis| {
            along(Plain, Plain.splat(xi[axis]), grid.h, grid.inverse_h()).take(0, cell[axis])
        })));
    }

    #[inline(always)]
    fn patches_x4<S: Simd, W: PatchShape, const D: usize>(
        simd: S,
        grid: &Grid<D>,
        locator: &CellLocator<D>,
        particles: &Particles<D>,
        lanes: FourLanes,
        patches: &mut ProductBatch<D, W>,
    ) -> u32 {
        let FourLanes { particle: first, lane } = lanes;
        let CellPositions { cell, xi, inside } = locator.locate(simd, grid, &particles.x, first);
        patches.put_starts(lane, locator.starts(&cell));
        for axis in 0..D {
            let along = along(simd, xi[axis], locator.h, locator.inverse_h);
            along.put(lane / LANES, locator.needs, &mut patches.axes[axis]);
        }
        inside
    }

    fn support(dimension: usize) -> u64 {
        1 << dimension
    }
}
