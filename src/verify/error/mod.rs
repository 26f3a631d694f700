//! The error of one level: quantities, norms, and the run that measures them.

pub(crate) mod clock;
pub(crate) mod declaration;
pub(crate) mod error_field;
pub(crate) mod judged_box;
pub(crate) mod judged_sum;
/// The quantity that readers of `docs/exercises/quantity.md` add.
#[cfg(test)]
#[path = "../../../tests/exercises/mean_stress.rs"]
mod mean_stress;
pub(crate) mod norm;
pub(crate) mod observer;
pub(crate) mod quantity;
pub(crate) mod run;
pub(crate) mod spread;
