//! Cost profile of a step of a case, with all effects of its scene and without one of them.

use crate::study::setup::dispatch;
use crate::subject::Profile;
use crate::suite::EffectName;
use crate::suite::model::{Case, ConvergencePlan, Scene};

/// A part that a scene may do without.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dispensable {
    /// An effect.
    Effect(EffectName),
    /// Contact between bodies, which share one velocity field without it.
    Contact,
}

impl Dispensable {
    /// All of them.
    pub fn all() -> impl Iterator<Item = Self> {
        EffectName::ALL.iter().map(|effect| Self::Effect(*effect)).chain([Self::Contact])
    }

    /// The name in suites and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Effect(effect) => effect.name(),
            Self::Contact => "contact",
        }
    }
}

/// Cost profile of a step of `case` on the coarsest level.
pub(crate) fn of(plan: &ConvergencePlan, case: &Case) -> Option<Profile> {
    dispatch::profile(plan, case.method, *plan.refine.levels.first()?)
}

/// The plan with a scene that does not list `without`.
pub(crate) fn lacking(plan: &ConvergencePlan, without: Dispensable) -> ConvergencePlan {
    let mut plan = plan.clone();
    let Dispensable::Effect(effect) = without else {
        plan.scene.contact = None;
        return plan;
    };
    if let (EffectName::BodyForce, Some(problem)) = (effect, &mut plan.exact) {
        problem.manufactured = false;
    }
    remove(&mut plan.scene, effect);
    plan
}

/// Removes an effect from a scene, with the effects that need it.
fn remove(scene: &mut Scene, effect: EffectName) {
    let goes = |other: &EffectName| *other == effect || other.needs().contains(&effect);
    scene.loads.retain(|load| !goes(&load.effect));
    scene.bodies.iter_mut().for_each(|body| remove(body, effect));
}
