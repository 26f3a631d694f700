//! Basis functions: the family. A member is one file and one line below.

mod bspline;
mod contract;
mod gimp;
#[cfg(test)]
mod laws;
mod linear;
mod tensor;

pub use bspline::{CubicBSpline, QuadraticBSpline};
pub use contract::{Basis, Domain, Seen};
pub use gimp::{ContiguousGimp, UniformGimp};
pub use linear::Linear;

use super::family::family;

family! {
    /// Names of the basis functions that suites may choose.
    pub enum BasisName; with_basis;
    "linear" => Linear,
    "ugimp" => UniformGimp,
    "cpgimp" => ContiguousGimp,
    "quadratic_bspline" => QuadraticBSpline,
    "cubic_bspline" => CubicBSpline,
}

impl BasisName {
    /// Order of the displacement error on a smooth solution with the consistent mass matrix: p + 1
    /// for degree p.
    pub fn formal_order(self) -> f64 {
        with_basis!(self, B => f64::from(B::DEGREE) + 1.0)
    }
}
