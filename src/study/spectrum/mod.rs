//! The spectrum study: phase speed and damping of waves, measured and predicted.

pub(crate) mod run;
pub(crate) mod runner;
