//! Tests of reading a typical suite, and of mistakes in it.

pub(crate) mod files;
pub(crate) mod good;
pub(crate) mod hostile;
pub(crate) mod mistakes;
pub(crate) mod properties;
pub(crate) mod sample;
