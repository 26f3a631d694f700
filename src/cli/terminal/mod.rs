//! Standard output, standard error, their colours, and the progress of a run.

mod colour;
pub(super) mod output;
pub(super) mod progress;
