//! The convergence study: every level of every case, its error, and the verdict.

pub(crate) mod described;
pub(crate) mod error_scale;
pub(crate) mod fine_grid_reference;
pub(crate) mod formal_order;
mod judge_plan;
pub(crate) mod reference;
pub(crate) mod runner;
pub(crate) mod small_step_reference;
pub(crate) mod stable_step;
pub(crate) mod statement;
pub(crate) mod time_steps;
