//! Names of loads and effects.

use mpm_subject::named;

named! {
    /// Names of loads and effects in suites. Effects on the same part of a scene are applied in the
    /// order of this list.
    pub enum EffectName {
        /// A uniform acceleration, constant or a function of time.
        Gravity = "gravity",
        /// A force per unit mass that depends on the particle, declared or manufactured.
        BodyForce = "body_force",
        /// Damping in proportion to mass.
        Damping = "damping",
        /// A damping force against the motion, proportional to the unbalanced force.
        LocalDamping = "local_damping",
        /// A viscous pressure against compression, which smooths shocks.
        ArtificialViscosity = "artificial_viscosity",
        /// A traction on a face of the body, carried by the layer of particles at that face.
        Traction = "traction",
        /// A pressure on a face of the body, which follows the moving face.
        Pressure = "pressure",
        /// A total force on a set of particles.
        SetForce = "force",
        /// A prescribed velocity of a set of particles.
        PrescribedVelocity = "velocity",
        /// Heat conduction, with a temperature on particles and additional grid fields.
        Heat = "heat",
        /// Thermal strain.
        ThermalExpansion = "thermal_expansion",
    }
}

impl EffectName {
    /// Returns the effects that this effect requires.
    pub fn needs(self) -> &'static [Self] {
        match self {
            Self::ThermalExpansion => &[Self::Heat],
            _ => &[],
        }
    }

    /// Refuses a list in which an effect lacks another effect that it requires.
    ///
    /// # Errors
    /// The effect whose requirement is missing, and a message with the names of both effects.
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
