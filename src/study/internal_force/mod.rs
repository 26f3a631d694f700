//! The internal-force study: the force on a node while a particle moves through its cells.

pub(crate) mod case;
