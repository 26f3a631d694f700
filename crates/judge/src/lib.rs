//! Exact solutions of continuum problems ([`exact`]), and the judge of solvers ([`verify`]): error
//! norms, observed orders of accuracy with confidence intervals, and verdicts.
//!
//! The package depends on no solver.

pub mod exact;
pub mod verify;
