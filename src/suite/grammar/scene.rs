//! The words of a scene.

use crate::{
    mpm::{EffectName, MaterialSpec, Placement},
    suite::yaml::{NumberText, Ordered},
};
use serde::Deserialize;

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SceneSpec {
    pub(crate) dimension: NumberText,
    pub(crate) body: Option<BodySpec>,
    /// Several bodies, in place of `body` and `material`.
    pub(crate) bodies: Option<Vec<OneBodySpec>>,
    pub(crate) contact: Option<ContactSpec>,
    pub(crate) grid: Option<BoxSpec>,
    pub(crate) material: Option<MaterialSpec<NumberText>>,
    #[serde(default)]
    pub(crate) boundary: Ordered<BoundarySpec>,
    pub(crate) initial_displacement: Option<Vec<NumberText>>,
    pub(crate) initial_velocity: Option<Vec<NumberText>>,
    #[serde(default)]
    pub(crate) sets: Ordered<SetSpec>,
    #[serde(default)]
    pub(crate) loads: Vec<LoadSpec>,
}

/// One of several bodies.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct OneBodySpec {
    pub(crate) body: BodySpec,
    pub(crate) material: MaterialSpec<NumberText>,
    pub(crate) initial_velocity: Option<Vec<NumberText>>,
}

/// How bodies push each other where they meet.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ContactSpec {
    /// Coefficient of friction.
    pub(crate) friction: NumberText,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum BodySpec {
    Box(BoxSpec),
    Annulus(AnnulusSpec),
    Disk(RoundSpec),
    Ball(RoundSpec),
    Quadrilateral(QuadrilateralSpec),
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct BoxSpec {
    pub(crate) from: Vec<NumberText>,
    pub(crate) to: Vec<NumberText>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct QuadrilateralSpec {
    /// Four, counter-clockwise.
    pub(crate) corners: Vec<Vec<NumberText>>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct AnnulusSpec {
    pub(crate) centre: Vec<NumberText>,
    pub(crate) inner: NumberText,
    pub(crate) outer: NumberText,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RoundSpec {
    pub(crate) centre: Vec<NumberText>,
    pub(crate) radius: NumberText,
}

/// Boundary conditions on a face; a face that is not named is free.
#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum BoundarySpec {
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
pub(crate) enum SetSpec {
    /// Those whose reference positions lie in a box.
    Box(BoxSpec),
}

#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum LoadSpec {
    /// Uniform acceleration (m/s2), formulas of t.
    Gravity(Vec<NumberText>),
    /// Rate (1/s) at which velocities decay, a formula of t.
    Damping(NumberText),
    /// Share of the force out of balance that opposes the motion, node by node.
    LocalDamping(NumberText),
    /// Pressure against compression.
    ArtificialViscosity(ViscositySpec),
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
    Heat(HeatSpec),
    /// Strain that temperature makes.
    ThermalExpansion(ExpansionSpec),
}

/// Thermal expansion.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ExpansionSpec {
    /// alpha (1/K).
    pub(crate) coefficient: NumberText,
    /// Temperature (K) at which a body that is not deformed is free of stress.
    pub(crate) reference: NumberText,
}

/// Conduction of heat, and what holds on the faces.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct HeatSpec {
    pub(crate) conductivity: NumberText,
    pub(crate) capacity: NumberText,
    /// Heat that arises (W/kg), a formula of the coordinates and t.
    pub(crate) source: Option<NumberText>,
    /// Initial temperature (K), a formula of the coordinates.
    pub(crate) initial: Option<NumberText>,
    #[serde(default)]
    pub(crate) boundary: Ordered<ThermalSpec>,
}

/// What holds on a face; formulas are of the coordinates and t.
#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum ThermalSpec {
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
pub(crate) struct ViscositySpec {
    pub(crate) linear: NumberText,
    pub(crate) quadratic: NumberText,
}

impl LoadSpec {
    /// The effect that the entry asks for.
    pub(crate) fn effect(&self) -> EffectName {
        match self {
            Self::Gravity(_) => EffectName::Gravity,
            Self::Damping(_) => EffectName::Damping,
            Self::LocalDamping(_) => EffectName::LocalDamping,
            Self::ArtificialViscosity(_) => EffectName::ArtificialViscosity,
            Self::BodyForce(_) => EffectName::BodyForce,
            Self::Traction { .. } => EffectName::Traction,
            Self::Pressure { .. } => EffectName::Pressure,
            Self::Force { .. } => EffectName::SetForce,
            Self::Velocity { .. } => EffectName::PrescribedVelocity,
            Self::Heat(_) => EffectName::Heat,
            Self::ThermalExpansion(_) => EffectName::ThermalExpansion,
        }
    }
}
