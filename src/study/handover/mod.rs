//! Converts a level of a study to a problem for any solver.
//!
//! ```text
//! initial   grid, faces, materials, forces and steps of a level
//! particles initial particles, and their exact state at a later time
//! fields    initial state, loads and face conditions at points that a solver chooses
//! needs     capabilities that a suite requires; suites with an external solver as their method
//! ```

mod fields;
mod initial;
mod needs;
mod particles;

pub use initial::level_problem;
pub(crate) use initial::{HandedRun, problem};
pub use needs::{lacking, needs, under, under_on};
pub(crate) use needs::{of_scene, subject_under};
pub use particles::exact_state;
pub(crate) use particles::{is_deformed, start, unloaded};
