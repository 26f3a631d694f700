//! Reports as aligned text, for snapshots and terminals.

pub(crate) mod cost;
pub(crate) mod diagnosis;
pub mod drift;
pub(crate) mod levels;
pub(crate) mod plot;
pub(crate) mod profile;
pub(crate) mod proposal;
pub(crate) mod prose;
pub(crate) mod stability;
pub(crate) mod table;
