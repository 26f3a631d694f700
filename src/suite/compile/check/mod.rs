//! Checks of a whole suite: what subjects and truths support, and whether levels fit.

pub(crate) mod energy;
pub(crate) mod fem_support;
pub(crate) mod load_support;
pub(crate) mod size;
pub(crate) mod subject_support;
pub(crate) mod sums;
