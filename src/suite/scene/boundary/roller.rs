//! A face without normal motion and with frictionless sliding.

use super::contract::{BoundaryCondition, BuildBoundary, FaceSite};
use crate::exact::{Condition, FacePoint, Violation};
use crate::mpm::{Boundary, Roller};

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
    fn name(&self) -> &'static str {
        "roller"
    }

    fn verb(&self) -> &'static str {
        "is a roller"
    }

    fn strength(&self) -> u8 {
        1
    }

    fn stays(&self) -> bool {
        true
    }
}

impl<const D: usize> BuildBoundary<D> for RollerFace {
    fn build(&self, site: &FaceSite<'_, D>) -> Option<Box<dyn Boundary<D>>> {
        let (axis, side) = site.at;
        Some(Box::new(Roller::face(site.grid, axis, side)))
    }
}
