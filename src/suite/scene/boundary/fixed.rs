//! A face that does not move.

use super::contract::{BoundaryCondition, BuildBoundary, FaceSite};
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
    fn name(&self) -> &'static str {
        "fixed"
    }

    fn verb(&self) -> &'static str {
        "is fixed"
    }

    fn strength(&self) -> u8 {
        3
    }

    fn stays(&self) -> bool {
        true
    }

    fn holds_all_components(&self) -> bool {
        true
    }
}

impl<const D: usize> BuildBoundary<D> for FixedFace {
    fn build(&self, site: &FaceSite<'_, D>) -> Option<Box<dyn Boundary<D>>> {
        let (axis, side) = site.at;
        Some(Box::new(Fixed::face(site.grid, axis, side)))
    }
}
