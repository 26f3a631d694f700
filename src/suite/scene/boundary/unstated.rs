//! Conditions of faces that a suite does not name: free, or at rest if the whole body is at rest.
//! No solver prescribes the motion of these faces.

use super::contract::{BoundaryCondition, BuildBoundary};
use super::fixed::FixedFace;
use crate::exact::{Condition, FacePoint, Violation};

/// The condition P n = 0, unless a load acts on the face.
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

/// The condition on the faces of a body with u = 0 everywhere.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FaceAtRest;

impl Condition for FaceAtRest {
    fn check(&self, point: &dyn FacePoint) -> Result<(), Violation> {
        FixedFace.check(point)
    }
}

impl BoundaryCondition for FaceAtRest {
    fn name(&self) -> &'static str {
        "at rest"
    }

    fn verb(&self) -> &'static str {
        "is at rest"
    }

    fn row(&self) -> String {
        String::new()
    }

    fn stays(&self) -> bool {
        true
    }
}

impl<const D: usize> BuildBoundary<D> for FaceAtRest {}
