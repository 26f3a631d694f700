//! Registration: one line makes an effect known by name, with the effects that it needs or
//! excludes.

/// Declares the names of effects. A line
///
/// `/// What it does.`
/// `ThermalExpansion = "thermal_expansion", needs [Heat];`
///
/// gives the effect the word that suites write. `needs` and `excludes` list other members, and may
/// be left out.
macro_rules! effects {
    (
        $(#[$meta:meta])* pub enum $names:ident;
        $(
            $(#[$member_meta:meta])*
            $member:ident = $text:literal
            $(, needs [$($need:ident),+])? $(, excludes [$($other:ident),+])?;
        )+
    ) => {
        $crate::named::named! {
            $(#[$meta])*
            pub enum $names {
                $($(#[$member_meta])* $member = $text,)+
            }
        }

        impl $names {
            /// The effects without which this one means nothing.
            pub fn needs(self) -> &'static [Self] {
                match self {
                    $(Self::$member => &[$($(Self::$need),+)?],)+
                }
            }

            /// The effects beside which this one means nothing.
            pub fn excludes(self) -> &'static [Self] {
                match self {
                    $(Self::$member => &[$($(Self::$other),+)?],)+
                }
            }
        }
    };
}

effects! {
    /// Names of the effects, as suites write them.
    pub enum EffectName;
    /// A uniform acceleration, constant or a function of time.
    Gravity = "gravity";
    /// A force per unit mass that depends on the particle, declared or manufactured.
    BodyForce = "body_force";
    /// A traction on a face of the body, carried by the layer of particles at that face.
    Traction = "traction";
    /// A pressure on a face of the body, which follows the face.
    Pressure = "pressure";
    /// A total force on a set of particles.
    SetForce = "force";
    /// A set of particles that move as they are told.
    PrescribedVelocity = "velocity";
    /// Damping in proportion to mass.
    Damping = "damping";
    /// A share of the force out of balance, against the motion.
    LocalDamping = "local_damping";
    /// A pressure against compression, for shocks.
    ArtificialViscosity = "artificial_viscosity";
    /// Conduction of heat, with a temperature on the particles and its own fields on the grid.
    Heat = "heat";
    /// Strain that temperature makes.
    ThermalExpansion = "thermal_expansion", needs [Heat];
}

impl EffectName {
    /// Refuses a list of effects of which one needs another that is not there, or excludes one
    /// that is.
    ///
    /// # Errors
    /// The effect that is at fault, and one line that names both.
    pub fn combine(listed: &[Self]) -> Result<(), (Self, String)> {
        for &effect in listed {
            if let Some(needed) = effect.needs().iter().find(|needed| !listed.contains(needed)) {
                let (name, needed) = (effect.name(), needed.name());
                return Err((effect, format!("`{name}` needs `{needed}`, which is not listed")));
            }
            if let Some(other) = effect.excludes().iter().find(|other| listed.contains(other)) {
                let (name, other) = (effect.name(), other.name());
                return Err((effect, format!("`{name}` and `{other}` exclude each other")));
            }
        }
        Ok(())
    }
}
