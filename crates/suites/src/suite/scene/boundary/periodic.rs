//! A face that coincides with the opposite face; the grid is periodic along this axis.

use super::contract::{BoundaryCondition, FaceKind, FaceMotion};
use crate::exact::{Condition, FacePoint, Violation};

/// A face whose state equals that of the opposite face.
#[derive(Debug, Clone, Copy)]
pub(crate) struct PeriodicFace;

impl Condition for PeriodicFace {
    fn check(&self, point: &dyn FacePoint) -> Result<(), Violation> {
        point.continues_on_opposite_face()
    }
}

impl BoundaryCondition for PeriodicFace {
    fn kind(&self) -> FaceKind {
        let kind = FaceKind::new("periodic", "is periodic", FaceMotion::Periodic);
        FaceKind { is_lacked_by_fem: true, ..kind }
    }
}
