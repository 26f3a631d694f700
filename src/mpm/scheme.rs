//! Time schemes: the order in which the stages of one step run.
//!
//! All three are Euler-Cromer (semi-implicit Euler); they differ in which velocity updates the
//! stress, and when (Bardenhagen 2002, J. Comput. Phys. 180).

use super::stage::Stage;
use super::stage::Stage::{
    Acceleration, Force, GridVelocity, Mass, Momentum, ParticleVelocity, Position, Stress,
};
use crate::named::named;

named! {
    /// Names of the schemes that suites may choose.
    pub enum SchemeName {
        /// Update stress first, from the velocities at the start of the step.
        Usf = "usf",
        /// Update stress last, from the updated grid velocities.
        Usl = "usl",
        /// Modified update stress last: the updated particle velocities are mapped to the grid
        /// once more, and that velocity updates stress and position (the "modified Lagrangian"
        /// algorithm of the talk; Sulsky, Zhou & Schreyer 1995).
        Musl = "musl",
    }
}

impl SchemeName {
    /// The stages of one step. MUSL needs the grid's velocity before the particles' only if the
    /// transfer or a wall reads it.
    pub fn stages(self, reads_grid_velocity: bool) -> &'static [Stage] {
        match self {
            Self::Musl if reads_grid_velocity => &[
                Mass,
                Momentum,
                Force,
                Acceleration,
                GridVelocity,
                ParticleVelocity,
                Momentum,
                Stress,
                Position,
            ],
            Self::Usf => &[
                Mass,
                Momentum,
                Stress,
                Force,
                Acceleration,
                GridVelocity,
                ParticleVelocity,
                Position,
            ],
            Self::Usl => &[
                Mass,
                Momentum,
                Force,
                Acceleration,
                GridVelocity,
                ParticleVelocity,
                Stress,
                Position,
            ],
            Self::Musl => {
                &[Mass, Force, Acceleration, ParticleVelocity, Momentum, Stress, Position]
            }
        }
    }
}
