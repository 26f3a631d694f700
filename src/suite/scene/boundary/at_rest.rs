//! A face of a body that is at rest as a whole: no solver moves it, and reports say so of the body.

use super::contract::{BoundaryCondition, BuildBoundary};
use super::fixed::FixedFace;
use crate::exact::{Condition, FacePoint, Violation};

/// u = 0 everywhere.
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
