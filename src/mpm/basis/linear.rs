//! Piecewise linear ("hat") functions: the basis of the original MPM.
//!
//! `N_i(x) = 1 - |x - x_i|/h` within one cell of node i (Sulsky, Chen & Schreyer 1994, eq. 2.10).
//! The gradient jumps at nodes: a particle that changes its cell changes the force there and then
//! (grid crossing).

use super::{
    contract::{Basis, Domain, Seen},
    tensor::{self, Along},
};
use crate::mpm::{grid::Grid, particles::Particles};

/// Piecewise linear basis functions, tensor products of hats.
#[derive(Debug, Clone, Copy)]
pub struct Linear;

impl Basis for Linear {
    const DEGREE: u8 = 1;
    const DOMAIN: Domain = Domain::Point;

    fn count(cells: usize, periodic: bool) -> usize {
        cells + usize::from(!periodic)
    }

    fn abscissa(index: usize, _: usize, _: bool) -> f64 {
        index as f64
    }

    #[inline]
    fn visit<const D: usize>(
        grid: &Grid<D>,
        particles: &Particles<D>,
        p: usize,
        visit: impl FnMut(Seen<'_, D>),
    ) {
        let x = &particles.x[p];
        if let Some(cell) = grid.cell(x) {
            let axes: [Along<2>; D] = std::array::from_fn(|axis| {
                let xi = grid.wrapped(x, axis) - cell[axis] as f64;
                Along {
                    count: 2,
                    index: [cell[axis], grid.wrap(cell[axis] + 1, axis)],
                    weight: [1.0 - xi, xi],
                    slope: [-grid.inverse_h(), grid.inverse_h()],
                }
            });
            let offset = |axis: usize, r: usize| {
                (cell[axis] as f64 + r as f64 - grid.wrapped(x, axis)) * grid.h
            };
            tensor::visit(grid, &axes, offset, visit);
        }
    }

    fn support(dimension: usize) -> u64 {
        1 << dimension
    }
}
