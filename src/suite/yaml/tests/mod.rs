//! Tests of the YAML reader with a typical suite, and with mistakes in this suite.

pub(crate) mod files;
pub(crate) mod good;
pub(crate) mod hostile;
pub(crate) mod mistakes;
pub(crate) mod properties;
pub(crate) mod sample;
