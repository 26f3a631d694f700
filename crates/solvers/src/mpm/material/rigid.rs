//! Rigid bodies at rest. They neither deform nor move and have no law, but may conduct heat.

use super::contract::{Material, MaterialProperties};
use super::stress_update::StressUpdate;

/// A rigid body at rest. The solver computes no motion and never reads the stress.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Rigid;

impl Rigid {
    /// Creates the law, which has no parameters.
    #[allow(clippy::new_without_default)]
    pub fn new() -> Self {
        Self
    }
}

impl MaterialProperties for Rigid {
    fn wave_modulus(&self, _: f64) -> f64 {
        0.0
    }

    fn depends_on_deformation_alone(&self) -> Result<(), &'static str> {
        Err("a body at rest has no force")
    }

    fn is_at_rest(&self) -> bool {
        true
    }
}

impl<const D: usize> Material<D> for Rigid {
    fn reads_deformation(&self) -> bool {
        false
    }

    fn update(&mut self, _: &mut StressUpdate<'_, D>) {}
}
