//! Exact solutions of continuum problems ([`exact`]), and the judge of solvers ([`verify`]).
//!
//! The package depends on no solver.

pub mod exact;
pub mod verify;
