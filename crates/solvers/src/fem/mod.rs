//! A finite element method in 1-D, for comparison with MPM solvers.
//!
//! The method is total-Lagrangian and explicit, and solves on the interval `[from, to]`
//!
//! ```text
//! rho0 u_tt = dP(F)/dX + rho0 b(X, t),    F = 1 + u_X
//! ```
//!
//! The weak form with shape functions `N_i` is (Belytschko, Liu, Moran & Elkhodary, *Nonlinear
//! Finite Elements for Continua and Structures*, 2nd ed. 2014, sections 2.3 and 2.4):
//!
//! ```text
//! sum_j M_ij a_j = f_i = -int P(F) N_i' dX + int rho0 b N_i dX + [P N_i] at the two ends
//! ```
//!
//! - [`Element`]: linear or quadratic shape functions with their Gauss points.
//! - [`Mass`]: the lumped or consistent mass matrix M, factorised once.
//! - [`Start`](mpm_subject::Start): Euler-Cromer steps from `v(0)` or from `v(-dt/2)`.
//! - [`Sampling`]: sample points inside the elements, or at the nodes, where displacements
//!   superconverge.
//!
//! With element length h and wave speed `c = sqrt(P'/rho0)`, the stability limits of `c dt / h` are
//!
//! | element   | lumped      | consistent   |
//! |-----------|-------------|--------------|
//! | linear    | 1           | 1 / sqrt(3)  |
//! | quadratic | 1 / sqrt(6) | 1 / sqrt(15) |
//!
//! These limits follow from `dt = 2 / omega` with the highest frequency omega of a single element
//! (Hughes 2000, section 9.1 for the limit, section 7.3.2 for the matrices).
//!
//! [`BarSetup`] describes the problem, and [`Bar`] solves it. Steps do not allocate.

mod bar;
mod mass;
mod mesh;
mod setup;

pub use bar::Bar;
pub use mesh::Element;
pub use setup::{BarLaw, BarLoad, BarSetup, Mass, Sampling, SetupError, pointwise};

// For other modules and packages of this project, without a promise of stability.
#[doc(hidden)]
pub use self::setup::{ScalarFunction, TimeFunction};
