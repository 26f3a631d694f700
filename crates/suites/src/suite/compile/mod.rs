//! Converts the grammar to the model: numbers, names, and checks of the exact solution.

pub(crate) mod check;
pub(crate) mod convergence;
pub(crate) mod expect;
pub(crate) mod gradient;
pub(crate) mod internal_force;
pub(crate) mod run;
pub(crate) mod scene;
#[cfg(feature = "schemas")]
pub(crate) mod schema;
pub(crate) mod spectrum;
pub(crate) mod stability;
pub(crate) mod study;
pub(crate) mod suite;
pub(crate) mod truth;

#[cfg(test)]
mod missing_keys;
