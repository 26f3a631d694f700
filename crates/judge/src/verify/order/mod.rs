//! The observed order (pairwise, by regression, by Richardson extrapolation), and the limit of a
//! series without an exact solution.

pub(crate) mod fit;
pub(crate) mod format_number;
pub(crate) mod hypothesis;
pub(crate) mod level;
pub(crate) mod limit_estimate;
pub(crate) mod richardson;
pub(crate) mod t_quantile;
pub(crate) mod variance_ratio;
pub(crate) mod window;
