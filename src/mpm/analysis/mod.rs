//! Analyses of a solver: its stable time step, its null space, totals over the body, reactions of
//! walls, and the cells of its particles.

pub(crate) mod cell_tracker;
pub(crate) mod null_space;
pub(crate) mod reaction;
pub(crate) mod stable_time_step;
pub(crate) mod totals;
