//! Registry of the basis functions. A new basis requires one file, one registration line and one
//! `mod` line.

mod bspline;
mod cell_locator;
mod contract;
mod cpdi;
mod gimp;
#[cfg(test)]
pub(in crate::mpm) mod laws;
mod linear;
mod product;
mod product_batch;
mod shape;
mod weights_1d;

pub use cell_locator::WeightNeeds;
pub use contract::{Basis, Domain, NodeWeight, Patch};
pub use product::Product;
pub use weights_1d::Weights1d;

// For other modules and packages of this project, without a promise of stability.
#[doc(hidden)]
pub use self::{
    cell_locator::CellLocator,
    contract::{FourLanes, LoopsUser},
    product_batch::{NodeTerm, ProductBatch},
    shape::{CountedShape, FixedShape, PatchShape},
    weights_1d::Weights1dBatch,
};

use super::foundation::algebra::Vector;
use super::foundation::family::family;
use super::foundation::grid::Grid;

family! {
    /// Names of the basis functions that suites may choose.
    pub enum BasisName; with_basis;
    "linear" => linear::Linear,
    "ugimp" => gimp::UniformGimp,
    "cpgimp" => gimp::ContiguousGimp,
    "cpdi" => cpdi::Cpdi,
    "quadratic_bspline" => bspline::QuadraticBSpline,
    "cubic_bspline" => bspline::CubicBSpline,
}

impl BasisName {
    /// Returns the order of the displacement error on a smooth solution with the consistent mass
    /// matrix: p + 1 for degree p.
    pub fn formal_order(self) -> f64 {
        with_basis!(self, B => f64::from(B::DEGREE) + 1.0)
    }

    /// Returns the position of function `node` of `grid` (m): the Greville abscissa on every axis.
    pub fn place<const D: usize>(self, grid: &Grid<D>, node: usize) -> Vector<D> {
        let along = |axis: usize| {
            let index = grid.index_on_axis(node, axis);
            let (cells, periodic) = (grid.cells[axis], grid.periodic[axis]);
            with_basis!(self, B => B::abscissa(index, cells, periodic))
        };
        Vector::from_fn(|axis, _| grid.origin[axis] + grid.h * along(axis))
    }
}
