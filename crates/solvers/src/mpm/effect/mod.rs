//! Registry of the effects: additions to the equations of motion, such as gravity. A new effect
//! requires one file, its `mod` and `pub use` lines, and a variant of `EffectInput` in `mpm/input`.
//! A solver has a list of effects. An effect that is not in the list adds no call, column or
//! branch.

mod artificial_viscosity;
mod body_force;
mod contract;
mod damping;
mod gravity;
mod heat;
mod hoop;
mod local_damping;
mod prescribed_velocity;
mod pressure;
mod rim;
mod set_force;
/// The effect added by `docs/exercises/effect.md`.
#[cfg(test)]
#[allow(unreachable_pub)] // the page has it in a public module
#[path = "../../../../../tests/exercises/spin.rs"]
mod spin;
mod surface;
mod thermal_expansion;
mod thermal_face;
mod traction;

pub use artificial_viscosity::ArtificialViscosity;
pub use body_force::BodyForce;
pub(super) use contract::strain;
pub use contract::{BodyOnGrid, Effect};
pub use damping::Damping;
pub use gravity::Gravity;
pub use heat::Heat;
pub use hoop::Hoop;
pub use local_damping::LocalDamping;
pub use prescribed_velocity::PrescribedVelocity;
pub use pressure::Pressure;
pub use set_force::SetForce;
pub use thermal_expansion::ThermalExpansion;
pub use thermal_face::Thermal;
pub use traction::Traction;

// For other modules and packages of this project, without a promise of stability.
#[doc(hidden)]
pub use self::{
    body_force::ForceField,
    heat::HeatSource,
    pressure::PressureField,
    rim::RimCircle,
    surface::Placement,
    thermal_face::{HeatInflow, ScalarField, ThermalBoundary},
    traction::TractionField,
};
