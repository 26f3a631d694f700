//! Standard output, standard error, and their colours.

mod colour;
pub(super) mod output;
