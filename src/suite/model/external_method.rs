//! Account of a solver that is not of this crate.

use crate::subject::Precision;

/// A solver that is not of this crate, by its own account.
#[derive(Debug, Clone, Copy)]
pub struct ExternalMethod<'a> {
    /// Its name, which becomes that of its cases.
    pub name: &'a str,
    /// Order in h that theory gives its displacements.
    pub formal_order: f64,
    /// Precision of its numbers.
    pub precision: Precision,
}
