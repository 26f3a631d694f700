//! Basis functions: the family. A member is one file and one line below.

mod contract;
#[cfg(test)]
mod laws;
mod linear;

pub use contract::{Basis, Stencil};
pub use linear::Linear;

use super::family::family;

family! {
    /// Names of the basis functions that suites may choose.
    pub enum BasisName; with_basis;
    "linear" => Linear,
}

impl BasisName {
    /// Order of the displacement error on a smooth solution, p + 1 for degree p.
    pub fn formal_order(self) -> f64 {
        with_basis!(self, B => f64::from(B::DEGREE) + 1.0)
    }
}
