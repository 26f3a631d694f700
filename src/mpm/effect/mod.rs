//! Effects: the family. A member is one file and its export below. A solver has a list of effects,
//! and one that it does not list costs nothing: no call, no column, no branch.

mod artificial_viscosity;
mod body_force;
mod contract;
mod damping;
mod gravity;
mod heat;
mod local_damping;
mod mapped_face;
mod prescribed_velocity;
mod pressure;
mod set_force;
mod strain;
mod surface;
mod thermal_expansion;
mod thermal_face;
mod traction;

pub use artificial_viscosity::ArtificialViscosity;
pub use body_force::{BodyForce, ForceField};
pub use contract::Effect;
pub use damping::Damping;
pub use gravity::Gravity;
pub use heat::{Heat, HeatSource};
pub use local_damping::LocalDamping;
pub use prescribed_velocity::PrescribedVelocity;
pub use pressure::{Pressure, PressureField};
pub use set_force::SetForce;
pub(super) use strain::strain;
pub use surface::Placement;
pub use thermal_expansion::ThermalExpansion;
pub use thermal_face::{HeatInflow, ScalarField, Thermal, ThermalBoundary};
pub use traction::{Traction, TractionField};
