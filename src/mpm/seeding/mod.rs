//! Seeding: bodies filled with particles, and particles sorted by cell.

pub(crate) mod fragments;
pub(crate) mod mapped;
pub(crate) mod quadrilateral;
pub(crate) mod revolution;
pub(crate) mod sort_by_cell;
