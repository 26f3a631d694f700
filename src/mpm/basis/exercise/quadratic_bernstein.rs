//! Quadratic Bernstein polynomials in every cell (Farin, Curves and Surfaces for CAGD, chapter on
//! the Bernstein form; in MPM: Karamelo, `Bernstein-quadratic`).
//!
//! With xi from 0 to 1 across the cell: `(1 - xi)^2`, `2 xi (1 - xi)`, `xi^2`. The first and the last
//! sit on the cell's nodes and are shared with the cells beside it, the second in its middle. Never
//! negative, and at walls as everywhere; but gradients jump at nodes, as those of hats do.

use super::{
    contract::{Basis, Domain, Seen},
    tensor::{self, Along},
};
use crate::mpm::{grid::Grid, particles::Particles};

/// Quadratic Bernstein polynomials, continuous from cell to cell.
#[derive(Debug, Clone, Copy)]
pub struct QuadraticBernstein;

impl Basis for QuadraticBernstein {
    const DEGREE: u8 = 2;
    const DOMAIN: Domain = Domain::Point;

    fn count(cells: usize, periodic: bool) -> usize {
        2 * cells + usize::from(!periodic)
    }

    fn abscissa(index: usize, _: usize, _: bool) -> f64 {
        0.5 * index as f64
    }

    #[inline]
    fn visit<const D: usize>(
        grid: &Grid<D>,
        particles: &Particles<D>,
        p: usize,
        visit: impl FnMut(Seen<'_, D>),
    ) {
        let x = &particles.x[p];
        let Some(cell) = grid.cell(x) else { return };
        let axes: [Along<3>; D] = std::array::from_fn(|axis| {
            let xi = grid.wrapped(x, axis) - cell[axis] as f64;
            let first = 2 * cell[axis];
            let slope = [2.0 * xi - 2.0, 2.0 - 4.0 * xi, 2.0 * xi];
            Along {
                count: 3,
                index: [first, first + 1, grid.wrap(first + 2, axis)],
                weight: [(1.0 - xi) * (1.0 - xi), 2.0 * xi * (1.0 - xi), xi * xi],
                slope: slope.map(|slope| slope * grid.inverse_h()),
            }
        });
        let offset = |axis: usize, k: usize| {
            (cell[axis] as f64 + 0.5 * k as f64 - grid.wrapped(x, axis)) * grid.h
        };
        tensor::visit(grid, &axes, offset, visit);
    }

    fn support(dimension: usize) -> u64 {
        3_u64.pow(dimension as u32)
    }
}
