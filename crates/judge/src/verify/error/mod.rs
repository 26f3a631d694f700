//! The error of one level: quantities, norms, and the run that measures them.

pub(crate) mod clock;
pub(crate) mod declaration;
pub(crate) mod judged_box;
pub(crate) mod judged_sum;
pub(crate) mod norm;
pub mod observer;
pub(crate) mod quantity;
pub(crate) mod run;
pub(crate) mod spread;
/// The quantity that readers of `docs/exercises/quantity.md` add.
#[cfg(test)]
#[path = "../../../../../tests/exercises/volume_ratio.rs"]
mod volume_ratio;
