//! Converts the initial state of a level to a problem for solvers.

use super::fields::SceneFields;
use super::particles::particles;
use crate::exact::{Forcing, Problem, Term};
use crate::external::{
    BodyForceField, HandedNumber, HandedValues, LevelProblem, PlacedBodyForce, ProblemBody,
    ProblemContact, ProblemFace, ProblemGrid, ProblemLoad, ProblemMaterial, ProblemParticles,
    ProblemRegion, owned,
};
use crate::study::setup::body::periodic;
use crate::study::setup::initial_state::Initial;
use crate::subject::SubjectError;
use crate::suite::model::refine_plan::LevelPlan;
use crate::suite::model::{Case, ConvergencePlan, Scene, SceneFace};
use crate::suite::scene::load::{EffectName, ListedLoad, LoadTarget};
use crate::suite::scene::numbers::LoadNumbers;
use crate::suite::scene::{cell_size, grid_axis};
use crate::verify::StepKind;
use std::sync::Arc;

/// Creates the problem of one level of a case. `suite` is the name of the suite.
///
/// # Errors
/// The reason why the problem cannot be created.
pub fn level_problem(
    suite: &str,
    plan: &ConvergencePlan,
    case: &Case,
    level: LevelPlan,
) -> Result<LevelProblem, SubjectError> {
    let clock = case.clock(plan, level.dt).ok_or("the time step is invalid")?;
    Ok(problem(
        suite,
        &plan.scene,
        plan.manufactured(),
        level,
        HandedRun {
            load_steps: (plan.steps == StepKind::Load).then_some(clock.steps),
            steps: clock.steps,
            dt: clock.dt(),
            until: clock.until,
            instants: (1..=clock.steps).filter(|step| clock.is_instant(*step)).collect(),
            particles: particles(plan, level)?,
            initial: plan.scene.each().iter().map(|body| Initial::of_body(plan, body)).collect(),
            is_perturbed: false,
        },
    ))
}

pub(crate) struct HandedRun {
    /// Number of load steps, if the run has no time.
    pub(crate) load_steps: Option<u64>,
    pub(crate) steps: u64,
    /// Length of a step (s).
    pub(crate) dt: f64,
    /// End of the run (s).
    pub(crate) until: f64,
    /// Numbers of the steps after which states are compared with the exact solution.
    pub(crate) instants: Vec<u64>,
    pub(crate) particles: ProblemParticles,
    pub(crate) initial: Vec<Initial>,
    pub(crate) is_perturbed: bool,
}

/// Creates the problem of a run; `made` contains the manufactured force, if any.
pub(crate) fn problem(
    suite: &str,
    scene: &Scene,
    made: Option<&Problem>,
    level: LevelPlan,
    run: HandedRun,
) -> LevelProblem {
    let HandedRun { load_steps, steps, dt, until, instants, particles, initial, is_perturbed } =
        run;
    let force = SceneForce { terms: forces(scene), made: made.cloned() };
    LevelProblem {
        suite: suite.to_owned(),
        dimension: scene.dimension(),
        grid: grid(scene, level),
        faces: faces(scene),
        materials: scene.each().iter().map(material).collect(),
        bodies: scene.each().iter().map(body).collect(),
        plane: scene.plane,
        contact: scene.contact.map(|coefficient| ProblemContact { law: "coulomb", coefficient }),
        loads: scene.loads.iter().map(|listed| load(scene, listed)).collect(),
        particles_per_cell: level.ppc,
        load_steps,
        steps,
        dt,
        until,
        instants,
        particles,
        fields: Some(Arc::new(SceneFields::new(scene, initial, is_perturbed))),
        constant_body_force: force.constant(scene.dimension()),
        body_force: (!force.is_none()).then(|| Arc::new(force) as Arc<dyn BodyForceField>),
    }
}

fn load(scene: &Scene, load: &ListedLoad) -> ProblemLoad {
    let numbers = load.numbers();
    let region = numbers.region.as_ref().map(|region| ProblemRegion {
        name: region.name.clone(),
        from: region.from.clone(),
        to: region.to.clone(),
    });
    ProblemLoad {
        load: load.effect.name(),
        rows: load.rows(),
        face: load.target().face().map(|face| scene.faces[face].name),
        rim: scene.rim(load).map(|circle| circle.name),
        region,
        numbers: handed(&numbers, scene.dimension()),
    }
}

fn handed(numbers: &LoadNumbers, d: usize) -> HandedValues {
    let constant = |(key, value): &(&'static str, f64)| (*key, HandedNumber::Scalar(*value));
    let mut handed = HandedValues {
        values: numbers.constants.iter().map(constant).collect(),
        ..HandedValues::default()
    };
    let Some(field) = &numbers.field else { return handed };
    match field.constant() {
        Some(value) if field.is_vector => {
            handed.values.push((field.key, HandedNumber::Vector(value)));
        }
        Some(value) => handed
            .values
            .extend(value.first().map(|value| (field.key, HandedNumber::Scalar(*value)))),
        None => {
            let keys = ["reference_position", "t", "displacement"].into_iter();
            let keys =
                keys.zip(field.depends_on(d)).filter_map(|(key, is_read)| is_read.then_some(key));
            handed.asked.push((field.key, keys.collect()));
        }
    }
    handed
}

fn body(scene: &Scene) -> ProblemBody {
    let outline = scene.outline.as_deref();
    let ball = outline.and_then(|outline| Some((outline.ball()?, outline.hole())));
    let corners = |trace: Vec<(f64, f64)>| trace.into_iter().map(|(x, y)| [x, y]).collect();
    ProblemBody {
        shape: outline.map_or("box", |outline| outline.kind()),
        from: scene.from.clone(),
        to: scene.to.clone(),
        centre: ball.map(|((centre, _), _)| centre.to_vec()),
        radii: ball.map(|((_, outer), hole)| [hole, outer]),
        corners: outline.filter(|_| ball.is_none()).map(|outline| corners(outline.trace())),
    }
}

fn grid(scene: &Scene, level: LevelPlan) -> ProblemGrid {
    let (h, axes) = (cell_size(scene, level.cells), 0..scene.dimension());
    let ends: Vec<(f64, f64)> = axes.clone().map(|axis| grid_axis(scene, axis, h)).collect();
    ProblemGrid {
        origin: ends.iter().map(|(origin, _)| *origin).collect(),
        h,
        cells: ends.iter().map(|(_, cells)| *cells as u64).collect(),
        periodic: axes.map(|axis| periodic(scene, axis)).collect(),
    }
}

fn faces(scene: &Scene) -> Vec<ProblemFace> {
    let face = |face: &SceneFace| ProblemFace {
        name: face.name,
        axis: face.axis,
        high: face.high,
        at: if face.high { scene.to[face.axis] } else { scene.from[face.axis] },
        condition: face.condition(),
        numbers: handed(&face.hold.numbers(), scene.dimension()),
    };
    scene.faces.iter().map(face).collect()
}

fn material(scene: &Scene) -> ProblemMaterial {
    let parameters = scene.material.keyed_parameters();
    ProblemMaterial {
        law: scene.material.name(),
        parameters,
        density: scene.density.largest(),
        varying_density: scene.density.formula().map(|formula| formula.source().to_owned()),
    }
}

fn forces(scene: &Scene) -> Vec<Vec<Arc<dyn Term>>> {
    let is_force = |load: &&ListedLoad| {
        matches!(load.effect, EffectName::Gravity | EffectName::BodyForce)
            && load.target() == LoadTarget::Body
    };
    let of_body = |scene: &Scene| -> Vec<Arc<dyn Term>> {
        let forces = scene.loads.iter().filter(is_force);
        forces.map(|load| load.load.clone() as Arc<dyn Term>).collect()
    };
    scene.each().iter().map(of_body).collect()
}

#[derive(Clone)]
struct SceneForce {
    terms: Vec<Vec<Arc<dyn Term>>>,
    made: Option<Problem>,
}

impl SceneForce {
    fn is_none(&self) -> bool {
        self.made.is_none() && self.terms.iter().all(Vec::is_empty)
    }

    /// Returns the force if it is constant in space and time and there is only one body.
    fn constant(&self, dimension: usize) -> Option<Vec<f64>> {
        let [terms] = &self.terms[..] else { return None };
        let is_constant =
            self.made.is_none() && !terms.is_empty() && terms.iter().all(|term| term.is_constant());
        let component =
            |i: usize| terms.iter().map(|term| term.stated(i, &[], 0.0, &[0.0; 3])).sum();
        is_constant.then(|| (0..dimension).map(component).collect())
    }

    /// Returns the prescribed forces (m/s2) on a displaced body, plus the force `made`.
    fn whole(&self, made: [f64; 3], body: usize, label: &[f64], t: f64, u: &[f64; 3]) -> [f64; 3] {
        let terms = self.terms.get(body).map_or(&[][..], Vec::as_slice);
        std::array::from_fn(|i| {
            terms.iter().fold(made[i], |sum, term| sum + term.stated(i, label, t, u))
        })
    }
}

impl BodyForceField for SceneForce {
    fn at(&self, body: usize, label: &[f64], t: f64) -> [f64; 3] {
        self.at_displaced(body, label, t, &[0.0; 3])
    }

    fn depends_on_displacement(&self) -> bool {
        self.terms.iter().flatten().any(|term| term.depends_on_displacement())
    }

    fn at_displaced(&self, body: usize, label: &[f64], t: f64, u: &[f64; 3]) -> [f64; 3] {
        let made = self.made.as_ref().map_or([0.0; 3], |made| made.manufactured_force(label, t));
        self.whole(made, body, label, t, u)
    }

    fn placed(&self, bodies: &[usize], labels: &[&[f64]]) -> Option<PlacedBodyForce> {
        let mut forcing = Forcing::new(self.made.as_ref()?, labels.iter().copied());
        let (force, places) = (self.clone(), owned(bodies, labels));
        Some(Box::new(move |t, into| {
            forcing.at(t, into);
            for (into, (body, label)) in into.iter_mut().zip(&places) {
                *into = force.whole(*into, *body, label, t, &[0.0; 3]);
            }
        }))
    }
}
