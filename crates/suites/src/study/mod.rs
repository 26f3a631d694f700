//! Studies run and judge the cases of a suite.

pub(crate) mod cache;
pub(crate) mod convergence;
pub mod cost;
pub mod describe;
pub(crate) mod diagnosis;
pub(crate) mod exact_motion;
pub(crate) mod gradient;
pub(crate) mod handover;
pub(crate) mod internal_force;
pub(crate) mod kind;
mod particle_motion;
pub(crate) mod preflight;
pub(crate) mod runner;
pub(crate) mod setup;
pub(crate) mod spectrum;
pub(crate) mod stability;
pub(crate) mod time_series;

pub use cache::ResultCache;
pub use diagnosis::diagnose;
pub use exact_motion::linearisation;
#[cfg(feature = "external-programs")]
pub use handover::result_levels;
pub use handover::{exact_state, lacking, level_problem, needs, under};
pub use kind::profile;
pub use preflight::{estimate, estimates, preflight};
pub use runner::Runner;
pub use runner::{Shard, ShardError};
pub use setup::body::effects;
pub use setup::dispatch::subject;

// For other modules and packages of this project, without a promise of stability.
#[doc(hidden)]
pub use self::{
    convergence::time_steps::{PlannedLevel, TimeStep, planned_levels, time_steps},
    exact_motion::Linearisation,
    handover::under_on,
    kind::{Progress, StepWarning, needs_of_suite, statement},
    preflight::{Estimate, unit_seconds},
    time_series::{SeriesError, SeriesFile},
};
