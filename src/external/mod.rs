//! External solvers: their problem, and the protocol for programs.
//!
//! ```text
//! problem        initial state of one level: particles, grid, faces, materials, loads, steps
//! fields         quantities of a problem at any place and time
//! capabilities   what a solver can do, what a problem needs, and the names of both
//! factory        makes a subject of each problem: of a library's user, or
//! gradient       derivatives of functionals, and problems with another value of a parameter
//! format         a problem as a file
//! program/       of a command that speaks the protocol (docs/protocol.md)
//! ```

mod capabilities;
mod factory;
mod fields;
#[cfg(feature = "external-programs")]
mod format;
mod gradient;
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
pub use gradient::{Gradient, GradientError, GradientRequest};
pub use problem::{
    LevelProblem, ProblemBody, ProblemContact, ProblemFace, ProblemGrid, ProblemLoad,
    ProblemMaterial, ProblemParticles, ProblemRegion,
};
#[cfg(feature = "external-programs")]
pub use program::{ProgramError, ProgramLimits, SolverProgram, protocol_schema, read_answers};
