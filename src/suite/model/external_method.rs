//! External solvers, and the accuracy that a gate may require of them.

use crate::subject::Precision;

/// Properties that an external solver states about itself.
#[derive(Debug, Clone, Copy)]
pub struct ExternalMethod<'a> {
    /// Its name, which becomes that of its cases.
    pub name: &'a str,
    /// Order in h that theory gives its displacements.
    pub formal_order: f64,
    /// Precision of its numbers.
    pub precision: Precision,
}

/// Accuracy that any method can reach on the problem of a suite: the key `any_method`.
#[derive(Debug, Clone, PartialEq)]
pub struct AnyMethod {
    /// Highest order along the refined axis that the regularity of the solution allows.
    pub order: Option<f64>,
    /// Errors at or below this bound are accepted without an order.
    pub error_below: Option<f64>,
    /// Whether nothing deforms, so that a solver may use any law.
    pub any_law: bool,
    /// Whether the gate requires anything of an external solver.
    pub gated: bool,
    /// The reason; empty if the key is absent.
    pub because: String,
}

/// A suite without the key: the order of the method, and the law of the scene.
impl Default for AnyMethod {
    fn default() -> Self {
        let (order, error_below, because) = (None, None, String::new());
        Self { order, error_below, any_law: false, gated: true, because }
    }
}

/// Terms of `run --gate` for one suite, from the configuration file of a solver's author.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct GateTerms {
    /// Formal order of the solver, in place of the one that the solver states.
    pub formal_order: Option<f64>,
    /// Order that is required on this suite.
    pub order: Option<f64>,
    /// Bound on errors that are accepted on this suite without an order.
    pub error_below: Option<f64>,
    /// Reason for not running this suite.
    pub skip: Option<String>,
    /// Reason for `order` and `error_below`.
    pub because: String,
}
