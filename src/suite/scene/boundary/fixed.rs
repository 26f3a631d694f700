//! A face that does not move.

use super::contract::{BoundaryCondition, BuildBoundary, FaceKind, FaceMotion, FaceSite};
use crate::exact::{Condition, FacePoint, Violation};
use crate::mpm::{Boundary, Fixed};

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
}

impl<const D: usize> BuildBoundary<D> for FixedFace {
    fn build(&self, site: &FaceSite<'_, D>) -> Option<Box<dyn Boundary<D>>> {
        let (axis, side) = site.at;
        Some(Box::new(Fixed::face(site.grid, axis, side)))
    }
}
