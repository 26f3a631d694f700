//! A level of a study as a problem that any solver can be handed.
//!
//! ```text
//! initial   particles, grid, faces, materials, steps at the start of a level
//! exact     the exact state at a later time
//! needs     what a solver must be able to do
//! under     a suite with a solver in place of its methods
//! ```

mod exact;
mod initial;
mod needs;
mod under;

pub use exact::exact_state;
pub use initial::level_problem;
pub use needs::{lacking, needs};
pub(crate) use under::subject_under;
pub use under::under;
