//! A face that does not move.

use super::contract::{BoundaryCondition, FaceKind, FaceMotion};
use crate::exact::{Condition, FacePoint, Violation};
use crate::mpm::input::WallCondition;

/// The condition u = 0 on a face.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FixedFace;

impl Condition for FixedFace {
    fn check(&self, point: &dyn FacePoint) -> Result<(), Violation> {
        (0..point.dimension()).try_for_each(|i| point.held(i, "fixed"))
    }
}

impl BoundaryCondition for FixedFace {
    fn kind(&self) -> FaceKind {
        let motion = FaceMotion::Stays { holds_all_components: true };
        FaceKind { strength: 3, ..FaceKind::new("fixed", "is fixed", motion) }
    }

    fn wall(&self) -> Option<WallCondition> {
        Some(WallCondition::Fixed)
    }
}
