//! The front door against a suite such as its author would write, and against mistakes in it.

mod files;
mod good;
mod hostile;
mod mistakes;
mod properties;
mod sample;
