//! Findings of `mpm-verify check` that a suite intends.

use crate::named::named;
use serde::Deserialize;

named! {
    /// A warning or note of `mpm-verify check` about a suite that can run.
    pub enum WarningName {
        /// Fewer levels than an order needs.
        FewLevels = "few_levels",
        /// A time step beyond the stable one, or the same on all levels.
        TimeStep = "time_step",
        /// A motion that leaves the grid.
        LeavesGrid = "leaves_grid",
        /// An exact solution of small strain, or of a linearised law.
        SmallStrain = "small_strain",
        /// A solver that computes in single precision.
        SinglePrecision = "single_precision",
        /// An interface of two bodies or a loaded face inside a cell.
        InsideCell = "inside_cell",
        /// A tolerance of a linearised solution that is much too large.
        LooseTolerance = "loose_tolerance",
        /// A box whose last particles start on nodes.
        EndOnNode = "end_on_node",
        /// An equilibrium study in which nothing removes energy.
        Undamped = "undamped",
    }
}

/// A warning that the suite intends, with the reason.
#[derive(Debug, Clone, Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct AcknowledgeSpec {
    /// The warning.
    pub(crate) warning: WarningName,
    /// Why the suite intends what `check` warns of.
    pub(crate) because: String,
}
