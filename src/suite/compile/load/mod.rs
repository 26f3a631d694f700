//! Loads and effects of a scene, one file each.

pub(crate) mod damping;
pub(crate) mod expansion;
pub(crate) mod heat;
pub(crate) mod surface;
pub(crate) mod viscosity;
