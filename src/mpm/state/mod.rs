//! The state of a solver: the initial one, checkpoints, perturbations, and the check that it is
//! finite.

pub(crate) mod checkpoint;
pub(crate) mod columns;
pub(crate) mod finite_check;
pub(crate) mod initial;
pub(crate) mod perturbation;
pub(crate) mod sampling;
