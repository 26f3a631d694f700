//! Analyses of a solver: its stable time step, its null space, totals over the body, reactions of
//! walls, and samples for the verification.

pub(crate) mod null_space;
pub(crate) mod reaction;
mod sampling;
pub(crate) mod stable_time_step;
pub(crate) mod totals;
