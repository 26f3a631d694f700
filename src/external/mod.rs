//! Solvers that are not of this crate: the problem that they are handed, ready to be stepped, and
//! the protocol by which a program takes part.
//!
//! ```text
//! problem        initial state of one level: particles, grid, faces, materials, loads, steps
//! particles      particles at the start
//! fields         quantities of a problem at any place and time
//! names          names that capabilities may contain
//! capabilities   what a solver can do, and what a problem needs
//! factory        makes a subject of each problem: of a library's user, or
//! format/        a problem as a file
//! program/       of a command that speaks the protocol (docs/protocol.md)
//! ```

mod capabilities;
mod factory;
mod fields;
#[cfg(feature = "external-programs")]
mod format;
mod names;
mod particles;
mod problem;
#[cfg(feature = "external-programs")]
mod program;

pub use capabilities::{Capabilities, ProblemNeeds};
pub use factory::SolverFactory;
pub use fields::{
    BodyForceField, FieldError, FieldName, FieldPlaces, HandedNumber, HandedValues,
    PlacedBodyForce, ProblemFields,
};
pub(crate) use fields::{FieldSource, ForceSource, owned};
#[cfg(feature = "external-programs")]
pub use format::ProblemFormat;
pub use particles::ProblemParticles;
pub use problem::{
    LevelProblem, ProblemBody, ProblemContact, ProblemFace, ProblemGrid, ProblemLoad,
    ProblemMaterial, ProblemRegion,
};
#[cfg(feature = "external-programs")]
pub use program::{ProgramLimits, SolverProgram, protocol_schema, read_answers};
