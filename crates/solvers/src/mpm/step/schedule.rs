//! Schedule of a step: a list of passes, compiled once from scheme, transfer, conditions and
//! coupling.
//!
//! Each P2G or G2P pass recomputes the weights of all particles. Neighbouring stages therefore
//! share a pass if no stage between them changes particles (P2G) or nodal velocities (G2P):
//!
//! ```text
//! USL:  P2G(mass, momentum, force)  G2P(particle velocity, stress, position)
//! USF:  P2G(mass, momentum)  G2P(stress)  P2G(force)  G2P(particle velocity, position)
//! MUSL: P2G(mass, force)  G2P(particle velocity)  P2G(momentum)  G2P(stress, position)
//! ```

use super::setup::Setup;
use crate::mpm::scheme::Stage;
use mpm_subject::Start;
use std::sync::Arc;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::mpm) enum Pass {
    P2g(&'static [Stage]),
    G2p(&'static [Stage]),
    /// Work of a stage on nodes or particles after its P2G or G2P pass.
    Update(Stage),
    /// Integration of the effects' own state over the step.
    IntegrateState,
    Couple(CouplingPoint),
}

/// Points of a step at which bodies are coupled, after all bodies have reached this point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::mpm) enum CouplingPoint {
    /// After particles have moved, when nodal masses are up to date.
    Mass,
    /// After P2G of velocities that will be advanced.
    Velocity,
    /// After P2G of velocities that will strain the bodies without being advanced.
    StrainVelocity,
    /// After velocities have strained the bodies and before these velocities are advanced.
    Strained,
    /// After accelerations have been computed.
    Acceleration,
}

impl Pass {
    /// Returns the name of the pass, such as `P2G(mass, momentum)`. An update has the name of its
    /// stage.
    pub(in crate::mpm) fn name(self) -> String {
        let of = |kind: &str, stages: &[Stage]| {
            let names: Vec<&str> = stages.iter().map(|stage| stage.name()).collect();
            format!("{kind}({})", names.join(", "))
        };
        match self {
            Self::P2g(stages) => of("P2G", stages),
            Self::G2p(stages) => of("G2P", stages),
            Self::Update(stage) => stage.name().to_owned(),
            Self::IntegrateState => "state of effects".to_owned(),
            Self::Couple(point) => format!("coupling({})", point.name()),
        }
    }

    /// Returns the names of the pass for reports. A stage with a P2G or G2P pass is listed only
    /// with this pass. `state` lists the passes for the effects' own state.
    fn texts(self, state: &[&str]) -> Vec<String> {
        match self {
            Self::IntegrateState => state.iter().map(|pass| (*pass).to_owned()).collect(),
            Self::Update(stage) if !matches!(stage, Stage::Acceleration | Stage::GridVelocity) => {
                Vec::new()
            }
            _ => vec![self.name()],
        }
    }
}

impl CouplingPoint {
    fn name(self) -> &'static str {
        match self {
            Self::Mass => "mass",
            Self::Velocity => "velocity",
            Self::StrainVelocity => "strain velocity",
            Self::Strained => "mapped velocity",
            Self::Acceleration => "acceleration",
        }
    }
}

/// All passes of a run.
#[derive(Debug, Clone, Default)]
pub(in crate::mpm) struct StepSchedule {
    /// Passes before the first step. If the run starts with velocities half a step before t = 0,
    /// these passes compute the accelerations at t = 0.
    pub(in crate::mpm) opening: Arc<[Pass]>,
    pub(in crate::mpm) passes: Arc<[Pass]>,
}

/// Properties of the coupling between a body and other bodies.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::mpm) struct Coupled {
    pub(in crate::mpm) bodies: bool,
    /// Whether the coupling reads velocities before they advance.
    pub(in crate::mpm) reads_velocity: bool,
}

impl StepSchedule {
    /// Compiles the schedule of `setup`. With `fixed_configuration`, positions do not change.
    pub(in crate::mpm) fn new<const D: usize>(
        setup: &mut Setup<D>,
        coupled: Coupled,
        fixed_configuration: bool,
    ) -> Self {
        let opening: &[Stage] = match (setup.start, setup.reads_velocity()) {
            (Start::AtZero, _) => &[],
            (Start::HalfStepBack, false) => &[Stage::Mass, Stage::Force, Stage::Acceleration],
            (Start::HalfStepBack, true) => {
                &[Stage::Mass, Stage::Momentum, Stage::Force, Stage::Acceleration]
            }
        };
        let stages = setup.stages(coupled.reads_velocity);
        let stages = match stages {
            [moving @ .., Stage::Position] if fixed_configuration => moving,
            all => all,
        };
        Self {
            opening: compile(opening, false, coupled.bodies).into(),
            passes: compile(stages, true, coupled.bodies).into(),
        }
    }

    /// Returns the names of the passes of each step for reports. `state` lists the passes for the
    /// effects' own state.
    pub(in crate::mpm) fn texts(&self, state: &[&str]) -> Vec<String> {
        self.passes.iter().flat_map(|pass| pass.texts(state)).collect()
    }
}

/// Returns the passes of `stages`, without the effects' own state and without coupling.
pub(in crate::mpm) fn passes_of(stages: &'static [Stage]) -> Vec<Pass> {
    compile(stages, false, false)
}

fn compile(stages: &'static [Stage], integrates_state: bool, is_coupled: bool) -> Vec<Pass> {
    let (mut passes, mut rest) = (Vec::new(), stages);
    for run in stages.chunk_by(|a, b| fuses(*a, *b)) {
        match run[0] {
            Stage::Mass | Stage::Momentum | Stage::Force => passes.push(Pass::P2g(run)),
            Stage::Acceleration | Stage::GridVelocity => {}
            Stage::ParticleVelocity | Stage::Stress | Stage::Position => {
                passes.push(Pass::G2p(run));
            }
        }
        for &stage in run {
            passes.push(Pass::Update(stage));
            if integrates_state && stage == Stage::Mass {
                passes.push(Pass::IntegrateState);
            }
            passes.extend(coupling_after(rest).filter(|_| is_coupled).map(Pass::Couple));
            rest = &rest[1..];
        }
    }
    passes
}

/// Whether a stage and the next one share a pass, because both are P2G or both are G2P.
fn fuses(stage: Stage, next: Stage) -> bool {
    use Stage::{Force, Mass, Momentum, ParticleVelocity, Position, Stress};
    matches!((stage, next), (Mass | Momentum | Force, Mass | Momentum | Force))
        || matches!((stage, next), (ParticleVelocity | Stress, Stress | Position))
}

/// Returns the coupling point after the first of `stages`, if there is one.
fn coupling_after(stages: &[Stage]) -> Option<CouplingPoint> {
    match stages {
        [Stage::Mass, ..] => Some(CouplingPoint::Mass),
        [Stage::Momentum, Stage::Stress, ..] => Some(CouplingPoint::StrainVelocity),
        [Stage::Momentum, ..] => Some(CouplingPoint::Velocity),
        [Stage::Stress, rest @ ..] if rest.contains(&Stage::Force) => Some(CouplingPoint::Strained),
        [Stage::Acceleration, ..] => Some(CouplingPoint::Acceleration),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mpm::scheme::SchemeName;
    use rstest::rstest;

    /// Tests that schemes need as few passes as possible, and that bodies are coupled once for each
    /// change of the grid.
    #[rstest]
    #[case(
        SchemeName::Usl,
        true,
        "P2G(mass, momentum, force); P2G(T); coupling(mass); \
        coupling(velocity); acceleration; coupling(acceleration); grid velocity; \
        G2P(particle velocity, stress, position)"
    )]
    #[case(
        SchemeName::Usf,
        true,
        "P2G(mass, momentum); P2G(T); coupling(mass); \
        coupling(strain velocity); G2P(stress); coupling(mapped velocity); P2G(force); \
        acceleration; coupling(acceleration); grid velocity; G2P(particle velocity, position)"
    )]
    #[case(
        SchemeName::Musl,
        false,
        "P2G(mass, force); acceleration; G2P(particle velocity); \
        P2G(momentum); G2P(stress, position)"
    )]
    #[case(
        SchemeName::Musl,
        true,
        "P2G(mass, momentum, force); P2G(T); coupling(mass); \
        coupling(velocity); acceleration; coupling(acceleration); grid velocity; \
        G2P(particle velocity); P2G(momentum); coupling(strain velocity); G2P(stress, position)"
    )]
    fn schedule_lists_passes_in_order(
        #[case] scheme: SchemeName,
        #[case] is_coupled: bool,
        #[case] expected: &str,
    ) {
        let passes = compile(scheme.stages(is_coupled), true, is_coupled).into();
        let state: &[&str] = if is_coupled { &["P2G(T)"] } else { &[] };
        let texts = StepSchedule { passes, ..StepSchedule::default() }.texts(state);
        assert_eq!(texts.join("; "), expected);
    }
}
