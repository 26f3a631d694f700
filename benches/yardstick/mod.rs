//! Reference loops: P2G, G2P and whole steps as in a textbook, with plain nested loops over nodes
//! and no generic parameters.
//!
//! The body stays away from walls, so B-splines are uniform and the inertia tensor of APIC is the
//! constant `h^2/4` (quadratic) or `h^2/3` (cubic). Nothing is unrolled, packed or ordered by hand,
//! so that the comparison shows the gain of these optimisations.

/// Quadratic B-splines in 3-D, APIC.
pub(crate) mod quadratic_3d;

/// Quadratic B-splines in 2-D, APIC.
pub(crate) mod quadratic_2d;

/// Cubic B-splines in 3-D, APIC.
pub(crate) mod cubic_3d;

/// A whole step of MLS-MPM in 3-D.
pub(crate) mod mls_3d;

/// A whole step of MLS-MPM in 2-D.
pub(crate) mod mls_2d;

/// Whole steps of APIC and FLIP in 3-D.
pub(crate) mod gradient_3d;

/// A whole step of FLIP in 1-D.
pub(crate) mod flip_1d;

/// Hat functions in 1-D, FLIP.
pub(crate) mod linear_1d;
