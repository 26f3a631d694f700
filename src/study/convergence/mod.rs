//! The convergence study: every level of every case, its error, and the verdict.

pub(crate) mod judge_plan;
pub(crate) mod reference;
pub(crate) mod runner;
pub(crate) mod statement;
pub(crate) mod time_steps;
