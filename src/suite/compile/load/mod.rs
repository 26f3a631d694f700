//! Loads and effects of a scene: the family. A member is one file and one line below (and the `mod`
//! that Rust wants), and its effect is a file of the solver's family.

mod artificial_viscosity;
mod body_force;
mod contract;
mod damping;
pub(crate) mod fields;
mod gravity;
mod heat;
mod local_damping;
mod pressure;
mod registry;
mod set_force;
mod set_velocity;
mod thermal_expansion;
mod thermal_face;
mod traction;

pub(crate) use contract::{LoadEntry, LoadWords, StudyFacts};

use super::path::Path;
use registry::loads;

loads! {
    /// A uniform acceleration, constant or a function of time.
    Gravity = "gravity": gravity::GravitySpec;
    /// A force per unit mass that depends on the particle, declared or manufactured.
    BodyForce = "body_force": body_force::BodyForceSpec;
    /// Damping in proportion to mass.
    Damping = "damping": damping::DampingSpec;
    /// A share of the force out of balance, against the motion.
    LocalDamping = "local_damping": local_damping::LocalDampingSpec;
    /// A pressure against compression, for shocks.
    ArtificialViscosity = "artificial_viscosity": artificial_viscosity::ViscositySpec;
    /// A traction on a face of the body, carried by the layer of particles at that face.
    Traction = "traction": traction::TractionSpec;
    /// A pressure on a face of the body, which follows the face.
    Pressure = "pressure": pressure::PressureSpec;
    /// A total force on a set of particles.
    SetForce = "force": set_force::SetForceSpec;
    /// A prescribed velocity of a set of particles.
    PrescribedVelocity = "velocity": set_velocity::SetVelocitySpec;
    /// Conduction of heat, with a temperature on the particles and its own fields on the grid.
    Heat = "heat": heat::HeatSpec;
    /// Strain that temperature makes.
    ThermalExpansion = "thermal_expansion": thermal_expansion::ExpansionSpec, needs [Heat];
}

impl LoadSpec {
    /// Path of the value of the entry with this `number` in the list of loads.
    pub(crate) fn path(&self, number: usize) -> Path {
        Path::top("scene").then("loads").then(number).then(self.effect().name())
    }
}

impl EffectName {
    /// Place of the effect called `name` in the order of registration, in which effects on the same
    /// part of the scene are applied.
    pub(crate) fn rank(name: &str) -> usize {
        Self::ALL.iter().take_while(|effect| effect.name() != name).count()
    }

    /// Refuses a list of effects of which one needs another that is not there.
    ///
    /// # Errors
    /// The effect that is at fault, and one line that names both.
    pub fn combine(listed: &[Self]) -> Result<(), (Self, String)> {
        for &effect in listed {
            if let Some(needed) = effect.needs().iter().find(|needed| !listed.contains(needed)) {
                let (name, needed) = (effect.name(), needed.name());
                return Err((effect, format!("`{name}` needs `{needed}`, which is not listed")));
            }
        }
        Ok(())
    }
}
