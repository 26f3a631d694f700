//! Tests of solvers of a user of the library.

mod conformance;
mod harness;
mod own_solver;
mod stability;

pub(crate) use own_solver::OwnSolver;
