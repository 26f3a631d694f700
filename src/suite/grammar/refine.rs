//! Keys of a refinement plan.

use super::StepSpec;
use crate::suite::yaml::{NumberText, OneOrMany};
use serde::Deserialize;

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RunSpec {
    pub(crate) until: OneOrMany<NumberText>,
    /// Absent where `refine` lists time steps.
    pub(crate) dt: Option<StepSpec>,
    pub(crate) instants: Option<NumberText>,
}

/// The key that holds a list is refined, from coarse to fine.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct RefineSpec {
    pub(crate) cells: OneOrMany<NumberText>,
    pub(crate) dt: Option<OneOrMany<NumberText>>,
    pub(crate) ppc: Option<OneOrMany<NumberText>>,
    /// Finer levels of the list, for full runs only.
    pub(crate) full: Option<OneOrMany<NumberText>>,
}

/// Places of particles beside their lattice, in shares of their spacing.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ScatterSpec {
    /// Translation of all particles along each axis.
    pub(crate) shift: Option<Vec<NumberText>>,
    /// Largest random displacement of each along an axis.
    pub(crate) perturb: Option<NumberText>,
    pub(crate) seed: Option<NumberText>,
}
