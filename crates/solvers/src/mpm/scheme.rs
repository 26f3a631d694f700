//! Time schemes: the named stages of a step, and their order.
//!
//! All three schemes are Euler-Cromer (semi-implicit Euler). They differ in the velocity that
//! updates the stress, and in the time of this update (Bardenhagen 2002, J. Comput. Phys. 180).

use Stage::{
    Acceleration, Force, GridVelocity, Mass, Momentum, ParticleVelocity, Position, Stress,
};
use mpm_subject::named;

named! {
    /// Names of the schemes that suites may choose.
    pub enum SchemeName {
        /// Update stress first, from the velocities at the start of the step.
        Usf = "usf",
        /// Update stress last, from the updated grid velocities.
        Usl = "usl",
        /// Modified update stress last: the updated particle velocities are mapped back to the
        /// grid, and the resulting velocity updates stress and position (the "modified Lagrangian"
        /// algorithm of Wobbes & Tielen 2015; Sulsky, Zhou & Schreyer 1995).
        Musl = "musl",
    }
}

impl SchemeName {
    /// Returns the stages of one step. MUSL computes the grid velocity before the particle velocity
    /// only if the transfer or a wall reads the grid velocity.
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

named! {
    /// A stage of a step, named after the quantity that it computes. The formulas are from Wobbes &
    /// Tielen (2015), steps 1-5.
    pub enum Stage {
        /// P2G: `m_i = sum_p m_p N_i`.
        Mass = "mass",
        /// P2G: `v_i = (sum_p m_p v_p N_i) / m_i`, zero at fixed nodes.
        Momentum = "momentum",
        /// P2G: `f_i = f_int_i + f_ext_i`.
        Force = "force",
        /// Grid: `a_i = f_i / m_i`, zero at fixed nodes.
        Acceleration = "acceleration",
        /// Grid: `v_i += dt a_i`.
        GridVelocity = "grid velocity",
        /// G2P: `v_p` from the grid, by the transfer.
        ParticleVelocity = "particle velocity",
        /// G2P: `grad v_p`, then stress and volume by the material.
        Stress = "stress",
        /// G2P: `x_p += dt sum_i v_i N_i`.
        Position = "position",
    }
}
