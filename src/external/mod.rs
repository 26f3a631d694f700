//! Solvers that are not of this crate: the problem that they are handed, ready to be stepped, and
//! the protocol by which a program takes part.
//!
//! ```text
//! problem        initial state of one level: particles, grid, faces, materials, loads, steps
//! capabilities   what a solver can do, and what a problem needs
//! factory        makes a subject of each problem: of a library's user, or
//! format/        a problem as a file
//! program/       of a command that speaks the protocol (docs/protocol.md)
//! ```

mod capabilities;
mod factory;
#[cfg(feature = "external-programs")]
mod format;
mod problem;
#[cfg(feature = "external-programs")]
mod program;

pub use capabilities::{Capabilities, ProblemNeeds};
pub use factory::SolverFactory;
#[cfg(feature = "external-programs")]
pub use format::ProblemFormat;
pub use problem::{
    BodyForceField, LevelProblem, PlacedBodyForce, ProblemFace, ProblemGrid, ProblemLoad,
    ProblemMaterial, ProblemParticles,
};
pub(crate) use problem::{ForceSource, owned};
#[cfg(feature = "external-programs")]
pub use program::{ProgramLimits, SolverProgram, protocol_schema, read_answers};
