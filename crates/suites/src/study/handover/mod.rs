//! Converts a level of a study to a problem for any solver.

mod fields;
mod initial;
mod needs;
mod particles;
#[cfg(feature = "external-programs")]
mod results;

pub use initial::level_problem;
pub(crate) use initial::{HandedRun, problem};
pub use needs::{lacking, needs, under, under_on};
pub(crate) use needs::{of_scene, subject_under};
pub use particles::exact_state;
pub(crate) use particles::{is_deformed, start, unloaded};
#[cfg(feature = "external-programs")]
pub use results::result_levels;
