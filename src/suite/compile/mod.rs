//! From the grammar to the model: every number computed, every name resolved, the truth checked.

mod assemble;
pub(crate) mod boundary;
pub(crate) mod check;
pub(crate) mod coordinates;
pub(crate) mod evaluator;
pub(crate) mod expect;
pub(crate) mod internal_force;
pub(crate) mod interval;
pub(crate) mod load;
mod observe;
pub(crate) mod path;
pub(crate) mod run;
pub(crate) mod scene;
#[cfg(feature = "schemas")]
pub(crate) mod schema;
pub(crate) mod stability;
pub(crate) mod suite;
mod suite_name;
pub(crate) mod truth;
pub(crate) mod wording;

#[cfg(test)]
mod missing_keys;
