//! A face without normal motion and with frictionless sliding.

use super::contract::{BoundaryCondition, FaceKind, FaceMotion};
use crate::exact::{Condition, FacePoint, Violation};
use crate::mpm::input::WallCondition;

/// The condition u . n = 0 on a face, without tangential traction.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RollerFace;

impl Condition for RollerFace {
    fn check(&self, point: &dyn FacePoint) -> Result<(), Violation> {
        let what = "a roller";
        (0..point.dimension()).try_for_each(|i| {
            if i == point.axis() { point.held(i, what) } else { point.traction(i, what, 0.0) }
        })
    }
}

impl BoundaryCondition for RollerFace {
    fn kind(&self) -> FaceKind {
        let motion = FaceMotion::Stays { holds_all_components: false };
        FaceKind { strength: 1, ..FaceKind::new("roller", "is a roller", motion) }
    }

    fn wall(&self) -> Option<WallCondition> {
        Some(WallCondition::Roller)
    }
}
