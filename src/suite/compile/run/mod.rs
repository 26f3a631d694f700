//! The run: refinement plan, time steps, methods, and the cases that they make.

pub(crate) mod bar_law;
pub(crate) mod cases;
pub(crate) mod external;
pub(crate) mod methods;
pub(crate) mod refine;
pub(crate) mod same_method;
pub(crate) mod scatter;
pub(crate) mod step_rule;
pub(crate) mod steps;
