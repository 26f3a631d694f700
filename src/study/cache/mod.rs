//! Results and checkpoints kept on disk, so that an interrupted run goes on.

pub(crate) mod checkpoints;
pub(crate) mod log;
pub(crate) mod results;
