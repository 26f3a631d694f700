//! Studies: running and judging the contents of a suite.
//!
//! ```text
//! setup            model -> Subject: names become types
//! convergence      errors over a refinement plan, judged
//! internal_force   the internal force on a node while a particle crosses it
//! gradient         derivatives that a differentiable solver reports
//! spectrum         phase speed and damping of waves, measured and predicted
//! stability        runs watched for growth, limits by bisection
//! cost             seconds of every level, and what they buy
//! cache            results of finished levels kept on disk
//! describe         the rows that state a problem in reports
//! diagnosis        why an order is not that of theory, by runs that change one thing
//! exact_motion     amplitude, extremes and linearisation of an exact motion
//! handover         a level as a problem that any solver can be handed
//! preflight        warnings about a suite before anything runs
//! time_series      a case as files for ParaView: particles and grid over time
//! ```

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
pub(crate) mod preflight;
pub(crate) mod runner;
pub(crate) mod setup;
pub(crate) mod spectrum;
pub(crate) mod stability;
pub(crate) mod time_series;

pub use cache::ResultCache;
pub use convergence::time_steps::{PlannedLevel, TimeStep, planned_levels, time_steps};
pub use diagnosis::diagnose;
pub use exact_motion::{Linearisation, linearisation};
pub use handover::{exact_state, lacking, level_problem, needs, under, under_on};
pub use kind::{Progress, StepWarning, profile, statement};
pub use preflight::{Estimate, estimate, estimates, preflight, unit_seconds};
pub use runner::Runner;
pub use runner::{Shard, ShardError};
pub use setup::body::effects;
pub use setup::dispatch::subject;
pub use time_series::{SeriesError, SeriesFile};
