//! Tests of the solvers from outside, in one binary. They are in this package because its profile
//! is optimised.

mod allocation;
mod bodies;
mod common;
mod conservation;
mod determinism;
mod effects;
mod mpm;
