//! Named stages of a time step.

/// One stage of a step. The formulas are those of Wobbes & Tielen (2015), steps 1-5.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Stage {
    /// P2G: `m_i = sum_p m_p N_i`.
    Mass,
    /// P2G: `v_i = (sum_p m_p v_p N_i) / m_i`, zero at fixed nodes.
    Momentum,
    /// P2G: `f_i = f_int_i + f_ext_i`.
    Force,
    /// Grid: `a_i = f_i / m_i`, zero at fixed nodes.
    Acceleration,
    /// Grid: `v_i += dt a_i`.
    GridVelocity,
    /// G2P: `v_p` from the grid, by the transfer.
    ParticleVelocity,
    /// G2P: `grad v_p`, then stress and volume by the material.
    Stress,
    /// G2P: `x_p += dt sum_i v_i N_i`.
    Position,
}

impl Stage {
    /// The quantity that the stage gives, as reports name it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Mass => "mass",
            Self::Momentum => "momentum",
            Self::Force => "force",
            Self::Acceleration => "acceleration",
            Self::GridVelocity => "grid velocity",
            Self::ParticleVelocity => "particle velocity",
            Self::Stress => "stress",
            Self::Position => "position",
        }
    }
}
