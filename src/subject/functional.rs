//! Functionals of the final state of a run, and the parameters of their derivatives.

use crate::named::named;
use serde::Serialize;

named! {
    /// Parameters of a problem with respect to which functionals are differentiated.
    pub enum GradientParameter {
        /// Young's modulus (Pa).
        Young = "young",
        /// Poisson's ratio.
        Poisson = "poisson",
        /// Reference density (kg/m3). All masses are proportional to the density.
        Density = "density",
        /// Yield stress (Pa).
        Yield = "yield",
        /// Linear hardening modulus (Pa).
        Hardening = "hardening",
        /// Coefficient of friction on faces.
        Friction = "friction",
        /// Factor on the whole initial velocity field; its nominal value is 1.
        InitialVelocity = "initial_velocity",
    }
}

/// A functional of the final state. Sums run over the particles, with masses m, displacements u
/// and velocities v.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(tag = "functional", rename_all = "snake_case")]
pub enum Functional {
    /// `sum m u_axis / sum m` (m).
    MeanDisplacement {
        /// Axis of the displacement.
        axis: usize,
    },
    /// `sum m |u|^2 / sum m` (m2).
    MeanSquareDisplacement,
    /// `sum m |v|^2 / 2` (J), without the affine part of APIC.
    KineticEnergy,
    /// Position of one particle (m).
    PositionOf {
        /// Index of the particle.
        particle: usize,
        /// Axis of the position.
        axis: usize,
    },
}

impl Functional {
    /// Names of the functionals in suite files and messages.
    pub const NAMES: [&'static str; 4] =
        ["mean_displacement", "mean_square_displacement", "kinetic_energy", "position_of"];

    /// Returns the name of the functional in suite files and messages.
    pub fn name(self) -> &'static str {
        let index = match self {
            Self::MeanDisplacement { .. } => 0,
            Self::MeanSquareDisplacement => 1,
            Self::KineticEnergy => 2,
            Self::PositionOf { .. } => 3,
        };
        Self::NAMES[index]
    }
}

/// Value of a functional, and the size of its rounding error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FunctionalValue {
    /// The value.
    pub value: f64,
    /// Rounding error of the value, in units of the machine epsilon.
    pub scale: f64,
}
