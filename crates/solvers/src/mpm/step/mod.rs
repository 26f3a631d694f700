//! Time steps: creates a solver from its parts, compiles its schedule, and runs the passes.

pub(in crate::mpm) mod cell_tracker;
pub(in crate::mpm) mod combination;
pub(in crate::mpm) mod heat_solver;
pub(in crate::mpm) mod initial;
pub(in crate::mpm) mod observables;
pub(in crate::mpm) mod schedule;
pub(in crate::mpm) mod setup;
pub(in crate::mpm) mod single_precision;
pub(in crate::mpm) mod solver;
pub(in crate::mpm) mod subject;
pub(in crate::mpm) mod volume_average;
