//! Suites under a solver that is not of this crate.

use crate::external::SolverFactory;
use crate::suite::model::Suite;
use crate::suite::model::external::ExternalMethod;

/// The suite with `solver` in place of its methods; see [`Suite::of_external`].
pub fn under(suite: &Suite, solver: &dyn SolverFactory, gate: bool) -> Option<Suite> {
    let (name, formal_order) = (solver.name(), solver.formal_order());
    suite.of_external(ExternalMethod { name, formal_order, precision: solver.precision() }, gate)
}
