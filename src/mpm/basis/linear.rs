//! Piecewise linear ("hat") functions: the basis of the original MPM.
//!
//! `N_i(x) = 1 - |x - x_i|/h` within one cell of node i (Sulsky, Chen & Schreyer 1994, eq. 2.10).
//! The gradient jumps at nodes: a particle that changes its cell changes the force there and then
//! (grid crossing).

use super::{
    along::Along,
    contract::{Basis, Domain},
    product::Product,
};
use crate::mpm::{algebra::array, grid::Grid, particles::Particles};

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
        see(&Product(array(Along::NONE, |axis| {
            let (xi, h, slope) = (xi[axis], grid.h, grid.inverse_h());
            Along {
                first: cell[axis],
                weight: [1.0 - xi, xi],
                slope: [-slope, slope],
                offset: [-xi * h, (1.0 - xi) * h],
                variance: xi * (1.0 - xi) * h * h,
            }
        })));
    }

    fn support(dimension: usize) -> u64 {
        1 << dimension
    }
}
