//! Keys of a scene.

use crate::mpm::MaterialSpec;
use crate::subject::PlaneState;
use crate::suite::yaml::{NumberText, Ordered};
use serde::Deserialize;
use serde::de::IgnoredAny;

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct SceneSpec {
    pub(crate) dimension: NumberText,
    pub(crate) plane: Option<PlaneState>,
    pub(crate) body: Option<BodySpec>,
    /// Several bodies, in place of `body` and `material`.
    pub(crate) bodies: Option<Vec<OneBodySpec>>,
    pub(crate) contact: Option<ContactSpec>,
    pub(crate) grid: Option<BoxSpec>,
    pub(crate) material: Option<MaterialSpec<NumberText>>,
    /// The words of boundary conditions stand in their files, and are read there.
    #[serde(rename = "boundary")]
    pub(crate) _boundary: Option<IgnoredAny>,
    pub(crate) initial_stress: Option<StressSpec>,
    pub(crate) initial_displacement: Option<Vec<NumberText>>,
    pub(crate) initial_velocity: Option<Vec<NumberText>>,
    #[serde(default)]
    pub(crate) sets: Ordered<SetSpec>,
    /// As those of loads.
    #[serde(rename = "loads")]
    pub(crate) _loads: Option<IgnoredAny>,
}

/// One of several bodies.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct OneBodySpec {
    pub(crate) body: BodySpec,
    pub(crate) material: MaterialSpec<NumberText>,
    pub(crate) initial_stress: Option<StressSpec>,
    pub(crate) initial_displacement: Option<Vec<NumberText>>,
    pub(crate) initial_velocity: Option<Vec<NumberText>>,
}

/// A symmetric stress (Pa) by its components; those that are not stated are zero.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct StressSpec {
    pub(crate) xx: Option<NumberText>,
    pub(crate) yy: Option<NumberText>,
    pub(crate) zz: Option<NumberText>,
    pub(crate) xy: Option<NumberText>,
    pub(crate) yz: Option<NumberText>,
    pub(crate) xz: Option<NumberText>,
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
    /// Corners, in their order around the body.
    Polygon(Vec<Vec<NumberText>>),
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

/// Material points with a name.
#[derive(Debug, Clone, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum SetSpec {
    /// Those whose reference positions lie in a box.
    Box(BoxSpec),
}
