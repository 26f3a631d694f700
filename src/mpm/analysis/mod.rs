//! Analyses of a solver: its stable time step and its null space.

pub(crate) mod null_space;
pub(crate) mod stable_time_step;
