//! A level of a study as a problem that any solver can be handed.
//!
//! ```text
//! initial   grid, faces, materials, forces and steps of a level
//! particles the particles at its start
//! fields    initial state, loads and conditions on faces at places that a solver chooses
//! exact     the exact state at a later time
//! needs     what a solver must be able to do
//! under     a suite with a solver in place of its methods
//! ```

mod exact;
mod fields;
mod initial;
mod needs;
mod particles;
mod under;

pub use exact::exact_state;
pub use initial::level_problem;
pub(crate) use initial::{HandedRun, problem};
pub(crate) use needs::of_scene;
pub use needs::{lacking, needs};
pub(crate) use particles::{is_deformed, start, unloaded};
pub(crate) use under::subject_under;
pub use under::{under, under_on};
