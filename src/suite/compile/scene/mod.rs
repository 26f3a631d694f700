//! The scene: bodies, materials, boundaries and sets.

pub(crate) mod bodies;
pub(crate) mod body;
pub(crate) mod boundary;
pub(crate) mod boxes;
pub(crate) mod initial;
pub(crate) mod lengths;
pub(crate) mod material;
pub(crate) mod outline;
mod plane;
pub(crate) mod rest;
mod revolution;
pub(crate) mod sets;
mod together;
pub(crate) mod whole;
