//! Tests of solvers that a user of the library implements.

mod conformance;
mod harness;
mod own_solver;
mod stability;

pub(crate) use own_solver::OwnSolver;
