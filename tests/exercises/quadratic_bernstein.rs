//! Quadratic Bernstein polynomials in every cell (Farin, Curves and Surfaces for CAGD, chapter on
//! the Bernstein form; in MPM: Karamelo, `Bernstein-quadratic`).
//!
//! With xi from 0 to 1 across the cell: `(1 - xi)^2`, `2 xi (1 - xi)`, `xi^2`. The first and the
//! last function belong to nodes of the grid, which neighbouring cells share, the second to the
//! centre of the cell. They are non-negative and do not change at walls. Gradients jump at nodes,
//! as for the linear basis.

use super::contract::{Basis, Domain};
use super::product::Product;
use super::weights_1d::Weights1d;
use crate::mpm::foundation::algebra::array;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;

/// Quadratic Bernstein polynomials, continuous from cell to cell.
#[derive(Debug, Clone, Copy)]
pub struct QuadraticBernstein;

impl Basis for QuadraticBernstein {
    const DEGREE: u8 = 2;
    const DOMAIN: Domain = Domain::Point;

    type Patch<const D: usize> = Product<D, 3>;

    fn count(cells: usize, periodic: bool) -> usize {
        2 * cells + usize::from(!periodic)
    }

    fn abscissa(index: usize, _: usize, _: bool) -> f64 {
        0.5 * index as f64
    }

    #[inline(always)]
    fn patches<const D: usize>(
        grid: &Grid<D>,
        particles: &Particles<D>,
        p: usize,
        mut visit: impl FnMut(&Product<D, 3>),
    ) {
        let Some((cell, xi)) = grid.locate(&particles.x[p]) else { return };
        visit(&Product(array(Weights1d::NONE, |axis| {
            let xi = xi[axis];
            let weight = [(1.0 - xi) * (1.0 - xi), 2.0 * xi * (1.0 - xi), xi * xi];
            let slope = [2.0 * xi - 2.0, 2.0 - 4.0 * xi, 2.0 * xi];
            let slope = array(0.0, |k| slope[k] * grid.inverse_h());
            let offset = array(0.0, |k| (0.5 * k as f64 - xi) * grid.h);
            Weights1d::new(2 * cell[axis], weight, slope, offset)
        })));
    }

    fn support(dimension: usize) -> u64 {
        3_u64.pow(dimension as u32)
    }
}
