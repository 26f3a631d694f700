//! Shapes of columns.

use crate::external::problem::LevelProblem;

impl LevelProblem {
    /// How many numbers of a column belong to one particle.
    pub(super) fn width(&self, column: &[f64]) -> usize {
        column.len() / self.particles.len().max(1)
    }
}

/// Whether a column has one number for each particle.
pub(super) fn is_scalar(column: &str) -> bool {
    ["mass", "reference_volume", "volume", "body", "hoop_stress"].contains(&column)
}

/// Whether it has a tensor for each particle, and not a vector.
pub(super) fn is_tensor(column: &str) -> bool {
    ["deformation_gradient", "stress", "initial_stress"].contains(&column)
}
