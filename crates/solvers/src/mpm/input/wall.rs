//! Conditions on faces of the grid.

use crate::mpm::basis::BasisName;
use crate::mpm::boundary::{Boundary, Fixed, Friction, Prescribed, Roller, Side, VelocityField};
use crate::mpm::foundation::algebra::Vector;
use crate::mpm::foundation::grid::Grid;
use std::sync::Arc;

/// A face of the grid or of a box-shaped body: the axis of its normal, and the end of this axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FaceInput {
    /// Axis of the normal.
    pub axis: usize,
    /// End of the axis.
    pub side: Side,
}

/// A condition on the motion of one face of the grid.
#[derive(Clone)]
pub struct WallInput {
    /// The face.
    pub face: FaceInput,
    /// The condition.
    pub condition: WallCondition,
}

/// A vector field that several bodies use: a function of the position (m) and time (s), which
/// writes one number per dimension.
pub type SharedVectorAt = Arc<dyn Fn(&[f64], f64, &mut [f64]) + Send + Sync>;

/// Conditions on the motion of grid nodes on a face.
#[derive(Clone)]
pub enum WallCondition {
    /// No motion.
    Fixed,
    /// No normal motion, free tangential motion.
    Roller,
    /// A wall without tension, with this coefficient of friction.
    Friction(f64),
    /// A prescribed velocity (m/s).
    Velocity(SharedVectorAt),
}

impl WallInput {
    pub(super) fn build<const D: usize>(
        &self,
        grid: &Grid<D>,
        basis: BasisName,
    ) -> Box<dyn Boundary<D>> {
        let FaceInput { axis, side } = self.face;
        match &self.condition {
            WallCondition::Fixed => Box::new(Fixed::face(grid, axis, side)),
            WallCondition::Roller => Box::new(Roller::face(grid, axis, side)),
            WallCondition::Friction(coefficient) => {
                Box::new(Friction::face(grid, axis, side, *coefficient))
            }
            WallCondition::Velocity(value) => {
                let value = value.clone();
                let value = vector_field(move |x: &[f64], t, v: &mut [f64]| value(x, t, v));
                Box::new(Prescribed::face(grid, basis, axis, side, value))
            }
        }
    }
}

/// Converts a field to a function of vectors.
pub(super) fn vector_field<const D: usize>(
    value: impl Fn(&[f64], f64, &mut [f64]) + Send + 'static,
) -> VelocityField<D> {
    Box::new(move |x, t| {
        let mut vector: Vector<D> = Vector::zeros();
        value(x.as_slice(), t, vector.as_mut_slice());
        vector
    })
}
