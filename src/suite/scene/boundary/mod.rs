//! Boundary conditions on the faces of a body: the family. A member is one file and one line below
//! (and the `mod` that Rust wants), and its condition on nodes is a file of the solver's family.
//! No suite writes two of them: a face of which it says nothing is a [`FreeFace`], or a
//! [`FaceAtRest`] of a body that does not move.

mod at_rest;
mod contract;
mod fixed;
mod free;
mod friction;
mod periodic;
mod registry;
mod roller;
pub(crate) mod thermal;
mod velocity;

pub(crate) use at_rest::FaceAtRest;
pub(crate) use contract::{BoundaryCondition, BoundaryWords, FaceEntry, FaceSite, build};
pub(crate) use free::FreeFace;

use registry::conditions;

conditions! {
    /// Boundary condition on a face; a face that is not named is free.
    BoundarySpec: BoundaryWords;
    /// No displacement.
    Fixed = "fixed" is fixed::FixedFace;
    /// No displacement along the normal, no traction along the face.
    Roller = "roller" is roller::RollerFace;
    /// A wall that presses and does not pull, with a coefficient of friction.
    Friction = "friction" of friction::FrictionSpec;
    /// The same state as on the opposite face.
    Periodic = "periodic" is periodic::PeriodicFace;
    /// A given velocity (m/s), formulas of the coordinates and t.
    Velocity = "velocity" of velocity::VelocitySpec;
}
