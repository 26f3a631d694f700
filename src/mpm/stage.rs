//! The named stages of which every time step is made.

use super::transfer::Wanted;

/// One pass over particles or nodes. The formulas are those of Wobbes & Tielen (2015), steps 1-5.
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

/// What stages want of the velocities of nodes.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Gathered {
    /// Gradients.
    pub(super) gradient: bool,
    /// Where the grid carries each particle.
    pub(super) carried: bool,
}

/// What visits to the nodes have done for stages to come.
#[derive(Debug, Default)]
pub(super) struct Visited {
    pub(super) p2g: Wanted,
    pub(super) g2p: Gathered,
}

/// What the maps to the nodes at the head of `stages` want: no stage between them changes particles.
pub(super) fn maps(stages: &[Stage]) -> Wanted {
    let maps = |stage: &&Stage| matches!(stage, Stage::Mass | Stage::Momentum | Stage::Force);
    let has = |wanted| stages.iter().take_while(maps).any(|stage| *stage == wanted);
    Wanted { mass: has(Stage::Mass), momentum: has(Stage::Momentum), force: has(Stage::Force) }
}

/// What is taken from the velocities of nodes at the head of `stages`, before these change.
pub(super) fn takes(stages: &[Stage]) -> Gathered {
    let takes = |stage: &&Stage| matches!(stage, Stage::Stress | Stage::Position);
    let has = |wanted| stages.iter().take_while(takes).any(|stage| *stage == wanted);
    Gathered { gradient: has(Stage::Stress), carried: has(Stage::Position) }
}

#[cfg(test)]
mod tests {
    use super::{Stage::*, *};
    use crate::mpm::scheme::SchemeName;

    /// A stage that has been visited ahead is still there to be run.
    #[test]
    fn schemes_visit_the_nodes_as_seldom_as_they_can() {
        let usl = SchemeName::Usl.stages(true);
        assert_eq!(maps(usl), Wanted { mass: true, momentum: true, force: true });
        assert_eq!(takes(&usl[6..]), Gathered { gradient: true, carried: true });
        let usf = SchemeName::Usf.stages(true);
        assert_eq!(maps(usf), Wanted { mass: true, momentum: true, force: false });
        assert_eq!(takes(&[Stress, Force, Position]), Gathered { gradient: true, carried: false });
        assert_eq!(takes(&[Momentum, Stress, Position]), Gathered::default(), "new velocities");
    }
}
