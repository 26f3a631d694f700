//! What a step of a case takes, with all that its scene lists and without one effect of it.

use crate::{
    mpm::EffectName,
    study::build::dispatch,
    subject::Profile,
    suite::model::{Case, ConvergencePlan, Scene},
};

/// What a scene may do without.
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

    /// The name as suites and reports spell it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Effect(effect) => effect.name(),
            Self::Contact => "contact",
        }
    }
}

/// What a step of `case` takes on the coarsest level.
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
    plan.scene.remove(effect);
    plan
}

impl Scene {
    /// Takes an effect out of the scene, if it is there.
    fn remove(&mut self, effect: EffectName) {
        self.bodies.iter_mut().for_each(|body| body.remove(effect));
        match effect {
            EffectName::Gravity => self.gravity = None,
            // What needs heat goes with it.
            EffectName::Heat => (self.heat, self.expansion) = (None, None),
            EffectName::ThermalExpansion => self.expansion = None,
            EffectName::BodyForce => self.body_force = None,
            EffectName::Damping => self.damping = None,
            EffectName::LocalDamping => self.local_damping = None,
            EffectName::ArtificialViscosity => self.viscosity = None,
            EffectName::Traction => self.faces.iter_mut().for_each(|face| face.traction = None),
            EffectName::Pressure => self.faces.iter_mut().for_each(|face| face.pressure = None),
            EffectName::SetForce => self.sets.iter_mut().for_each(|set| set.force = None),
            EffectName::PrescribedVelocity => {
                self.sets.iter_mut().for_each(|set| set.velocity = None)
            }
        }
    }
}
