//! Piecewise linear ("hat") functions: the basis of the original MPM.
//!
//! `N_i(x) = 1 - |x - x_i|/h` within one cell of node i (Sulsky, Chen & Schreyer 1994, eq. 2.10).
//! The gradient jumps at nodes: a particle that changes its cell changes the force there and then
//! (grid crossing).

use super::contract::{Basis, Stencil};
use crate::mpm::{algebra::Vector, grid::Grid};

/// Piecewise linear basis functions, tensor products of hats.
#[derive(Debug, Clone, Copy)]
pub struct Linear;

impl Basis for Linear {
    const DEGREE: u8 = 1;
    const REPRODUCES_LINEAR: bool = true;

    #[inline]
    fn visit<const D: usize>(
        grid: &Grid<D>,
        x: &Vector<D>,
        visit: impl FnMut(usize, f64, &Vector<D>),
    ) {
        if let Some(first) = grid.cell(x) {
            let slope = [[-grid.inverse_h(), grid.inverse_h()]; D];
            let weight = std::array::from_fn(|axis| {
                let xi = grid.local(x, axis) - first[axis] as f64;
                [1.0 - xi, xi]
            });
            Stencil { first, weight, slope }.visit(grid, visit);
        }
    }

    fn support(dimension: usize) -> u64 {
        1 << dimension
    }
}
