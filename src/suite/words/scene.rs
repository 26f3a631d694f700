//! The words of a scene.

use crate::{
    mpm::{EffectName, MaterialWords, Placement},
    suite::yaml::{NumberText, Ordered},
};
use serde::Deserialize;

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::suite) struct SceneWords {
    pub(in crate::suite) dimension: NumberText,
    pub(in crate::suite) body: Option<BodyWords>,
    /// Several bodies, in place of `body` and `material`.
    pub(in crate::suite) bodies: Option<Vec<OneBodyWords>>,
    pub(in crate::suite) contact: Option<ContactWords>,
    pub(in crate::suite) grid: Option<BoxWords>,
    pub(in crate::suite) material: Option<MaterialWords<NumberText>>,
    #[serde(default)]
    pub(in crate::suite) boundary: Ordered<BoundaryWords>,
    pub(in crate::suite) initial_displacement: Option<Vec<NumberText>>,
    pub(in crate::suite) initial_velocity: Option<Vec<NumberText>>,
    #[serde(default)]
    pub(in crate::suite) sets: Ordered<SetWords>,
    #[serde(default)]
    pub(in crate::suite) loads: Vec<LoadWords>,
}

/// One of several bodies.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::suite) struct OneBodyWords {
    pub(in crate::suite) body: BodyWords,
    pub(in crate::suite) material: MaterialWords<NumberText>,
    pub(in crate::suite) initial_velocity: Option<Vec<NumberText>>,
}

/// How bodies push each other where they meet.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::suite) struct ContactWords {
    /// Coefficient of friction.
    pub(in crate::suite) friction: NumberText,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(in crate::suite) enum BodyWords {
    Box(BoxWords),
    Annulus(AnnulusWords),
    Disk(RoundWords),
    Ball(RoundWords),
    Quadrilateral(QuadrilateralWords),
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::suite) struct BoxWords {
    pub(in crate::suite) from: Vec<NumberText>,
    pub(in crate::suite) to: Vec<NumberText>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::suite) struct QuadrilateralWords {
    /// Four, counter-clockwise.
    pub(in crate::suite) corners: Vec<Vec<NumberText>>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::suite) struct AnnulusWords {
    pub(in crate::suite) centre: Vec<NumberText>,
    pub(in crate::suite) inner: NumberText,
    pub(in crate::suite) outer: NumberText,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::suite) struct RoundWords {
    pub(in crate::suite) centre: Vec<NumberText>,
    pub(in crate::suite) radius: NumberText,
}

/// Boundary conditions on a face; a face that is not named is free.
#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(in crate::suite) enum BoundaryWords {
    /// No displacement.
    Fixed,
    /// No displacement along the normal, no traction along the face.
    Roller,
    /// A wall that presses and does not pull, with a coefficient of friction.
    Friction(NumberText),
    /// The same state as on the opposite face.
    Periodic,
    /// A given velocity (m/s), formulas of the coordinates and t.
    Velocity(Vec<NumberText>),
}

/// Material points with a name.
#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(in crate::suite) enum SetWords {
    /// Those whose reference positions lie in a box.
    Box(BoxWords),
}

#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(in crate::suite) enum LoadWords {
    /// Uniform acceleration (m/s2), formulas of t.
    Gravity(Vec<NumberText>),
    /// Rate (1/s) at which velocities decay, a formula of t.
    Damping(NumberText),
    /// Share of the force out of balance that opposes the motion, node by node.
    LocalDamping(NumberText),
    /// Pressure against compression.
    ArtificialViscosity(ViscosityWords),
    /// Force per unit mass (m/s2), formulas of the coordinates and t.
    BodyForce(Vec<NumberText>),
    /// Force per reference area on one face (Pa), formulas of the coordinates and t.
    Traction { on: String, value: Vec<NumberText>, at: Option<Placement> },
    /// Pressure that follows one face (Pa), a formula of the coordinates and t.
    Pressure { on: String, value: NumberText, at: Option<Placement> },
    /// Total force on a set (N), formulas of t.
    Force { on: String, value: Vec<NumberText> },
    /// Velocity of a set (m/s), formulas of the coordinates and t.
    Velocity { on: String, value: Vec<NumberText> },
    /// Conduction of heat.
    Heat(HeatWords),
    /// Strain that temperature makes.
    ThermalExpansion(ExpansionWords),
}

/// Thermal expansion.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::suite) struct ExpansionWords {
    /// alpha (1/K).
    pub(in crate::suite) coefficient: NumberText,
    /// Temperature (K) at which a body that is not deformed is free of stress.
    pub(in crate::suite) reference: NumberText,
}

/// Conduction of heat, and what holds on the faces.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::suite) struct HeatWords {
    pub(in crate::suite) conductivity: NumberText,
    pub(in crate::suite) capacity: NumberText,
    /// Heat that arises (W/kg), a formula of the coordinates and t.
    pub(in crate::suite) source: Option<NumberText>,
    /// Initial temperature (K), a formula of the coordinates.
    pub(in crate::suite) initial: Option<NumberText>,
    #[serde(default)]
    pub(in crate::suite) boundary: Ordered<ThermalWords>,
}

/// What holds on a face; formulas are of the coordinates and t.
#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(in crate::suite) enum ThermalWords {
    /// No heat flows.
    Insulated,
    /// The temperature (K).
    Temperature(NumberText),
    /// Heat that enters (W/m^(D-1)).
    Flux(NumberText),
    /// `coefficient (ambient - T)` enters.
    Convection { coefficient: NumberText, ambient: NumberText },
}

/// Coefficients of the artificial viscosity.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::suite) struct ViscosityWords {
    pub(in crate::suite) linear: NumberText,
    pub(in crate::suite) quadratic: NumberText,
}

impl LoadWords {
    /// The effect that the entry asks for.
    pub(in crate::suite) fn effect(&self) -> EffectName {
        match self {
            Self::Gravity(_) => EffectName::Gravity,
            Self::Damping(_) => EffectName::Damping,
            Self::LocalDamping(_) => EffectName::LocalDamping,
            Self::ArtificialViscosity(_) => EffectName::ArtificialViscosity,
            Self::BodyForce(_) => EffectName::BodyForce,
            Self::Traction { .. } => EffectName::Traction,
            Self::Pressure { .. } => EffectName::Pressure,
            Self::Force { .. } => EffectName::SetForce,
            Self::Velocity { .. } => EffectName::Driven,
            Self::Heat(_) => EffectName::Heat,
            Self::ThermalExpansion(_) => EffectName::ThermalExpansion,
        }
    }
}
