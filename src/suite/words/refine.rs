//! The words of a refinement plan.

use super::StepWords;
use crate::suite::yaml::{NumberText, OneOrMany};
use serde::Deserialize;

#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::suite) struct RunWords {
    pub(in crate::suite) until: OneOrMany<NumberText>,
    /// Absent where `refine` lists time steps.
    pub(in crate::suite) dt: Option<StepWords>,
    pub(in crate::suite) instants: Option<NumberText>,
}

/// What is a list is refined, from coarse to fine.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(in crate::suite) struct RefineWords {
    pub(in crate::suite) cells: OneOrMany<NumberText>,
    pub(in crate::suite) dt: Option<OneOrMany<NumberText>>,
    pub(in crate::suite) ppc: Option<OneOrMany<NumberText>>,
    /// Finer levels of the list, for full runs only.
    pub(in crate::suite) full: Option<OneOrMany<NumberText>>,
}
