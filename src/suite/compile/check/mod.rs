//! Checks of several keys of a suite together.

pub(crate) mod size;
pub(crate) mod steps;
pub(crate) mod sums;
pub(crate) mod support;
