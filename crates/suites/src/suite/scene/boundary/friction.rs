//! A frictional wall: it resists compression and sliding, but not separation.

use super::contract::{BoundaryCondition, BoundaryKeys, FaceEntry, FaceKind, FaceMotion};
use crate::exact::{Condition, FacePoint, Violation};
use crate::mpm::input::WallCondition;
use crate::suite::scene::numbers::LoadNumbers;
use crate::suite::yaml::{Diagnostic, NumberText};
use std::sync::Arc;

/// Coefficient of friction.
#[derive(Debug, Clone, serde::Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub(crate) struct FrictionSpec(NumberText);

impl BoundaryKeys for FrictionSpec {
    fn compile(&self, entry: &FaceEntry<'_>) -> Result<Arc<dyn BoundaryCondition>, Diagnostic> {
        let what = "the coefficient of friction";
        Ok(Arc::new(FrictionFace(entry.path.zero_or_positive(&self.0, what)?)))
    }
}

#[derive(Debug)]
struct FrictionFace(f64);

impl Condition for FrictionFace {
    fn check(&self, point: &dyn FacePoint) -> Result<(), Violation> {
        point.friction(self.0)
    }
}

impl BoundaryCondition for FrictionFace {
    fn kind(&self) -> FaceKind {
        FaceKind {
            strength: 2,
            is_lacked_by_fem: true,
            against_several_bodies: Some(
                "friction on a wall is supported for a single body only: it is computed before \
                 the contact between bodies",
            ),
            against_consistent_mass: Some(
                "`friction` needs a lumped mass matrix: it is computed from the force that would \
                 hold each node",
            ),
            ..FaceKind::new("friction", "has friction", FaceMotion::MayLeave)
        }
    }

    fn numbers(&self) -> LoadNumbers {
        LoadNumbers::constants(&[("coefficient", self.0)])
    }

    fn row(&self) -> String {
        format!("wall without tension, with the coefficient of friction {:.4}", self.0)
    }

    fn wall(&self) -> Option<WallCondition> {
        Some(WallCondition::Friction(self.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::suite::scene::boundary::fixed::FixedFace;
    use crate::suite::scene::boundary::roller::RollerFace;

    #[test]
    fn friction_has_priority_over_a_roller_but_not_over_a_fixed_face() {
        let friction = FrictionFace(0.3).kind().strength;
        assert!(RollerFace.kind().strength < friction && friction < FixedFace.kind().strength);
    }
}
