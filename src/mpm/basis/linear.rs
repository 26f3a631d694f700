//! Piecewise linear ("hat") functions: the basis of the original MPM.
//!
//! `N_i(x) = 1 - |x - x_i|/h` within one cell of node i (Sulsky, Chen & Schreyer 1994, eq. 2.10).
//! The gradient jumps at nodes: a particle that changes its cell changes the force there and then
//! (grid crossing).

use super::{
    contract::{Basis, Domain},
    lattice::{Lattice, Places},
    product::Product,
    product_batch::Products,
    weights_1d::Weights1d,
    weights_1d_batch::WeightsSimd,
};
use crate::mpm::{
    algebra::array,
    grid::Grid,
    particles::Particles,
    simd::{FOUR, Plain, Width},
};

/// The hats along an axis, at `xi` from 0 to 1 within a cell.
#[inline(always)]
fn along<W: Width>(width: W, xi: W::Four, h: f64, inverse_h: f64) -> WeightsSimd<W, 2> {
    let rest = width.all(1.0) - xi;
    WeightsSimd {
        weight: [rest, xi],
        slope: [width.all(-inverse_h), width.all(inverse_h)],
        offset: [width.all(0.0) - xi * h, rest * h],
        variance: xi * rest * h * h,
    }
}

/// Piecewise linear basis functions, tensor products of hats.
#[derive(Debug, Clone, Copy)]
pub struct Linear;

impl Basis for Linear {
    const DEGREE: u8 = 1;
    const DOMAIN: Domain = Domain::Point;

    type Patch<const D: usize> = Product<D, 2>;

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
        mut see: impl FnMut(&Product<D, 2>),
    ) {
        let Some((cell, xi)) = grid.locate(&particles.x[p]) else { return };
        see(&Product(array(Weights1d::NONE, |axis| {
            along(Plain, Plain.all(xi[axis]), grid.h, grid.inverse_h()).take(0, cell[axis])
        })));
    }

    #[inline(always)]
    fn four<W: Width, const D: usize>(
        width: W,
        (grid, lattice): (&Grid<D>, &Lattice<D>),
        particles: &Particles<D>,
        (first, lane): (usize, usize),
        patches: &mut Products<D, 2>,
    ) -> u32 {
        let Places { cell, xi, inside } = lattice.locate(width, grid, &particles.x, first);
        patches.put_starts(lane, lattice.starts(&cell));
        for axis in 0..D {
            let along = along(width, xi[axis], lattice.h, lattice.inverse_h);
            along.put(lane / FOUR, lattice.needs, &mut patches.axes[axis]);
        }
        inside
    }

    fn support(dimension: usize) -> u64 {
        1 << dimension
    }
}
