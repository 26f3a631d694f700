//! What kind of scene it is.

use super::Scene;
use crate::mpm::MaterialPlan;

impl Scene {
    /// Whether the body does not move at all.
    pub fn is_at_rest(&self) -> bool {
        matches!(self.material, MaterialPlan::Rigid {})
    }

    /// Whether the law is one of the whole deformation, so that strains are not taken as small.
    pub fn is_finite(&self) -> bool {
        !matches!(self.material, MaterialPlan::LinearElastic { .. })
    }
}
