//! Boundary conditions of the faces of a body.

use crate::exact::formula::Formula;

/// Condition on the motion of one face.
#[derive(Debug, Clone)]
pub enum BoundaryCondition {
    /// Nothing: it may carry a traction.
    Free,
    /// It does not move.
    Fixed,
    /// It does not move along its normal, and slides freely along itself.
    Roller,
    /// The wall presses on it, does not pull, and resists sliding by this coefficient of friction.
    Friction(f64),
    /// It has a given velocity (m/s), formulas of the coordinates and t.
    Velocity(Vec<Formula>),
    /// It is one and the same with the opposite face.
    Periodic,
    /// The whole body is at rest.
    AtRest,
}

impl BoundaryCondition {
    /// Whether nothing holds the face.
    pub fn is_free(&self) -> bool {
        matches!(self, Self::Free)
    }

    /// Whether nodes on the face are held.
    pub fn is_held(&self) -> bool {
        !matches!(self, Self::Free | Self::Periodic)
    }

    /// In words that follow "the left face".
    pub fn verb(&self) -> &'static str {
        match self {
            Self::Free => "is free",
            Self::Fixed => "is fixed",
            Self::Roller => "is a roller",
            Self::Friction(_) => "has friction",
            Self::Velocity(_) => "has a given velocity",
            Self::Periodic => "is periodic",
            Self::AtRest => "is at rest",
        }
    }
}
