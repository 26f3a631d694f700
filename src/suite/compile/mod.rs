//! From the grammar to the model: every number computed, every name resolved, the truth checked.

mod assemble;
pub(crate) mod check;
pub(crate) mod expect;
pub(crate) mod internal_force;
pub(crate) mod interval;
mod observe;
pub(crate) mod run;
pub(crate) mod scene;
#[cfg(feature = "schemas")]
pub(crate) mod schema;
pub(crate) mod stability;
pub(crate) mod suite;
mod suite_name;
pub(crate) mod truth;

#[cfg(test)]
mod missing_keys;

pub(crate) use super::evaluator as wording;
pub(crate) use super::yaml::locate as path;
