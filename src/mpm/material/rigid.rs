//! No law at all: a body that neither deforms nor moves, in which heat may flow.

use super::contract::Material;
use crate::mpm::particles::Particles;

/// A rigid body at rest. Nothing is computed for its motion, so that nobody asks for its stress.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rigid;

impl Rigid {
    /// It has no parameter.
    #[allow(clippy::new_without_default)]
    pub fn new() -> Self {
        Self
    }
}

impl<const D: usize> Material<D> for Rigid {
    fn reads_deformation(&self) -> bool {
        false
    }

    fn update(&mut self, _: f64, _: &mut Particles<D>) {}
}
