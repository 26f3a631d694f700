//! A face that nothing holds: of which a suite says nothing.

use super::contract::{BoundaryCondition, BuildBoundary};
use crate::exact::{Condition, FacePoint, Violation};

/// P n = 0, unless a load acts on the face.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FreeFace;

impl Condition for FreeFace {
    fn check(&self, point: &dyn FacePoint) -> Result<(), Violation> {
        (0..point.dimension()).try_for_each(|i| point.traction(i, "free", 0.0))
    }
}

impl BoundaryCondition for FreeFace {
    fn name(&self) -> &'static str {
        "free"
    }

    fn verb(&self) -> &'static str {
        "is free"
    }

    fn is_free(&self) -> bool {
        true
    }
}

impl<const D: usize> BuildBoundary<D> for FreeFace {}
