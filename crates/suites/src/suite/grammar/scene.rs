//! Keys of a scene: body, material, boundary conditions and loads.

use crate::mpm::MaterialSpec;
use crate::subject::PlaneState;
use crate::suite::scene::boundary::BoundarySpec;
#[cfg(feature = "schemas")]
use crate::suite::scene::face::by_face;
use crate::suite::scene::load::LoadSpec;
use crate::suite::yaml::{NumberText, Ordered};
use serde::Deserialize;

#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct SceneSpec {
    /// Number of space dimensions: 1, 2 or 3.
    pub(crate) dimension: NumberText,
    /// Plane strain, plane stress or axial symmetry, in two dimensions.
    pub(crate) plane: Option<PlaneState>,
    /// Shape of the body.
    pub(crate) body: Option<BodySpec>,
    /// Several bodies, each with its own material and initial state, in place of `body`.
    pub(crate) bodies: Option<Vec<OneBodySpec>>,
    /// Contact between several bodies. Without this key they share one velocity field.
    pub(crate) contact: Option<ContactSpec>,
    /// Corners of the grid (m); default: those of the body, with more cells beyond free faces.
    pub(crate) grid: Option<BoxSpec>,
    /// Material of the body.
    pub(crate) material: Option<MaterialSpec<NumberText>>,
    /// Boundary condition of each face. A face without an entry is free.
    #[serde(default)]
    #[cfg_attr(feature = "schemas", schemars(schema_with = "by_face::<BoundarySpec>"))]
    pub(crate) boundary: Ordered<BoundarySpec>,
    /// Residual or geostatic stress of the undeformed body.
    pub(crate) initial_stress: Option<StressSpec>,
    /// Displacement at the start (m), one formula of the coordinates for each axis.
    pub(crate) initial_displacement: Option<Vec<NumberText>>,
    /// Velocity at the start (m/s), one formula of the coordinates for each axis.
    pub(crate) initial_velocity: Option<Vec<NumberText>>,
    /// Named sets of material points, which loads can refer to.
    #[serde(default)]
    pub(crate) sets: Ordered<SetSpec>,
    /// Loads, and effects such as damping and heat conduction.
    #[serde(default)]
    pub(crate) loads: Vec<LoadSpec>,
}

/// One of several bodies.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct OneBodySpec {
    /// Shape of the body.
    pub(crate) body: BodySpec,
    /// Material of the body.
    pub(crate) material: MaterialSpec<NumberText>,
    /// Residual or geostatic stress of the body.
    pub(crate) initial_stress: Option<StressSpec>,
    /// Displacement at the start (m).
    pub(crate) initial_displacement: Option<Vec<NumberText>>,
    /// Velocity at the start (m/s).
    pub(crate) initial_velocity: Option<Vec<NumberText>>,
}

/// Components of a symmetric stress (Pa). Missing components are zero.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct StressSpec {
    pub(crate) xx: Option<NumberText>,
    pub(crate) yy: Option<NumberText>,
    pub(crate) zz: Option<NumberText>,
    pub(crate) xy: Option<NumberText>,
    pub(crate) yz: Option<NumberText>,
    pub(crate) xz: Option<NumberText>,
}

/// Contact between bodies.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct ContactSpec {
    /// Coefficient of friction.
    pub(crate) friction: NumberText,
}

#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case")]
pub(crate) enum BodySpec {
    /// A box whose faces are normal to the axes.
    Box(BoxSpec),
    /// A ring, in two dimensions; its rims are free.
    Annulus(AnnulusSpec),
    /// A disk, in two dimensions; its rim is free.
    Disk(RoundSpec),
    /// A ball, in three dimensions; its surface is free.
    Ball(RoundSpec),
    /// A polygon, in two dimensions, given by its corners in order around the body.
    Polygon(Vec<Vec<NumberText>>),
    /// A convex quadrilateral, in two dimensions, with particles placed by a bilinear map.
    Quadrilateral(QuadrilateralSpec),
}

#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct BoxSpec {
    /// Corner with the lowest coordinates (m).
    pub(crate) from: Vec<NumberText>,
    /// Corner with the highest coordinates (m).
    pub(crate) to: Vec<NumberText>,
}

#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct QuadrilateralSpec {
    /// Four corners (m), counter-clockwise.
    pub(crate) corners: Vec<Vec<NumberText>>,
}

#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct AnnulusSpec {
    /// Centre (m).
    pub(crate) centre: Vec<NumberText>,
    /// Inner radius (m).
    pub(crate) inner: NumberText,
    /// Outer radius (m).
    pub(crate) outer: NumberText,
}

#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct RoundSpec {
    /// Centre (m).
    pub(crate) centre: Vec<NumberText>,
    /// Radius (m).
    pub(crate) radius: NumberText,
}

/// A set of material points.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum SetSpec {
    /// Material points whose reference positions lie in a box.
    Box(BoxSpec),
}
