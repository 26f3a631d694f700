//! Reference solvers for verification: a Material Point Method in one to three dimensions
//! ([`mpm`]), and a finite element bar ([`fem`]).
//!
//! Both solvers implement [`mpm_subject::Subject`] and do not depend on the code that judges them.
//! [`mpm::input`] creates a solver from data.

pub mod fem;
pub mod mpm;
