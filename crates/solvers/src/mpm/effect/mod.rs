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
pub use body_force::{BodyForce, ForceField};
pub(super) use contract::strain;
pub use contract::{BodyOnGrid, Effect};
pub use damping::Damping;
pub use gravity::Gravity;
pub use heat::{Heat, HeatSource};
pub use hoop::Hoop;
pub use local_damping::LocalDamping;
pub use prescribed_velocity::PrescribedVelocity;
pub use pressure::{Pressure, PressureField};
pub use rim::RimCircle;
pub use set_force::SetForce;
pub use surface::Placement;
pub use thermal_expansion::ThermalExpansion;
pub use thermal_face::{HeatInflow, ScalarField, Thermal, ThermalBoundary};
pub use traction::{Traction, TractionField};
