//! A face with a prescribed velocity.

use super::contract::{BoundaryCondition, BoundaryKeys, FaceEntry, FaceKind, FaceMotion};
use crate::exact::formula::Formula;
use crate::exact::{Condition, FacePoint, Violation};
use crate::mpm::input::WallCondition;
use crate::suite::scene::numbers::{LoadNumbers, of_place_and_time, value_with_unit};
use crate::suite::yaml::{Diagnostic, NumberText};
use std::sync::Arc;

/// Velocity (m/s), formulas of the coordinates and t.
#[derive(Debug, Clone, serde::Deserialize)]
#[cfg_attr(feature = "schemas", derive(schemars::JsonSchema))]
#[serde(transparent)]
pub(crate) struct VelocitySpec(Vec<NumberText>);

impl BoundaryKeys for VelocitySpec {
    fn compile(&self, entry: &FaceEntry<'_>) -> Result<Arc<dyn BoundaryCondition>, Diagnostic> {
        Ok(Arc::new(MovingFace(entry.path.fields(&self.0, entry.dimension)?)))
    }
}

#[derive(Debug)]
struct MovingFace(Vec<Formula>);

/// Requires `u_t = v(X, t)`.
impl Condition for MovingFace {
    fn check(&self, point: &dyn FacePoint) -> Result<(), Violation> {
        (0..point.dimension()).try_for_each(|i| point.velocity(i, point.value(&self.0[i])))
    }
}

impl BoundaryCondition for MovingFace {
    fn kind(&self) -> FaceKind {
        FaceKind {
            is_lacked_by_fem: true,
            against_consistent_mass: Some(
                "a given velocity of a face needs a lumped mass matrix: the consistent one is \
                 solved for walls at rest",
            ),
            ..FaceKind::new("velocity", "has a given velocity", FaceMotion::Driven)
        }
    }

    fn numbers(&self) -> LoadNumbers {
        LoadNumbers::vector("velocity", &self.0)
    }

    fn row(&self) -> String {
        format!("velocity = {}", value_with_unit(&self.0, "m/s"))
    }

    fn wall(&self) -> Option<WallCondition> {
        Some(WallCondition::Velocity(Arc::new(of_place_and_time(&self.0))))
    }
}
