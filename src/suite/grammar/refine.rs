//! Keys of a refinement plan.

use super::StepSpec;
use crate::suite::yaml::{NumberText, OneOrMany};
use serde::Deserialize;

#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct RunSpec {
    /// End of the run (s), or a list of ends.
    pub(crate) until: OneOrMany<NumberText>,
    /// Absent where `refine` lists time steps.
    pub(crate) dt: Option<StepSpec>,
    /// Number of instants at which the error is taken.
    pub(crate) instants: Option<NumberText>,
}

/// The key that holds a list is refined, from coarse to fine.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct RefineSpec {
    /// Cells along the first axis.
    pub(crate) cells: OneOrMany<NumberText>,
    /// Time steps (s).
    pub(crate) dt: Option<OneOrMany<NumberText>>,
    /// Particles per cell.
    pub(crate) ppc: Option<OneOrMany<NumberText>>,
    /// Finer levels of the list, for full runs only.
    pub(crate) full: Option<OneOrMany<NumberText>>,
}

/// Places of particles beside their lattice, in shares of their spacing.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct ScatterSpec {
    /// Translation of all particles along each axis.
    pub(crate) shift: Option<Vec<NumberText>>,
    /// Largest random displacement of each along an axis.
    pub(crate) perturb: Option<NumberText>,
    /// Seed of the random displacements.
    pub(crate) seed: Option<NumberText>,
}
