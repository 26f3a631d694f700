//! The truth: exact solutions, references, and what is conserved.

pub(crate) mod conduction;
pub(crate) mod conservation_only;
pub(crate) mod equilibrium;
pub(crate) mod exact;
pub(crate) mod interface;
pub(crate) mod law;
pub(crate) mod reference;
pub(crate) mod tolerance;
