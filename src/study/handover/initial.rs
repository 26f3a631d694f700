//! Initial state of a level.

use crate::dimension::with_dimension;
use crate::exact::{Forcing, Problem, Term};
use crate::external::{
    BodyForceField, ForceSource, LevelProblem, PlacedBodyForce, ProblemFace, ProblemGrid,
    ProblemLoad, ProblemMaterial, ProblemParticles, owned,
};
use crate::mpm::{BasisName, FrameName, MassName, SchemeName, Solver, TransferName, Vector};
use crate::study::build::conditions::periodic;
use crate::study::build::setup::{Body, setup};
use crate::subject::Start;
use crate::suite::model::grid_size::{cell_size, grid_axis};
use crate::suite::model::load::{EffectName, ListedLoad, LoadTarget};
use crate::suite::model::method::Method;
use crate::suite::model::refine_plan::LevelPlan;
use crate::suite::model::{Case, ConvergencePlan, Scene, SceneFace};
use std::sync::Arc;

/// The problem of one level of a case, of the suite called `suite`.
///
/// # Errors
/// One line that says why there is none.
pub fn level_problem(
    suite: &str,
    plan: &ConvergencePlan,
    case: &Case,
    level: LevelPlan,
) -> Result<LevelProblem, String> {
    let scene = &plan.scene;
    let clock = case.clock(plan, level.dt).ok_or("the time step makes no sense")?;
    let instants = (1..=clock.steps).filter(|step| clock.is_instant(*step)).collect();
    let particles = with_dimension!(scene.dimension(), D => particles::<D>(plan, level))?;
    Ok(LevelProblem {
        suite: suite.to_owned(),
        dimension: scene.dimension(),
        grid: grid(scene, level),
        faces: faces(scene),
        materials: scene.each().iter().map(material).collect(),
        loads: scene.loads.iter().map(load).collect(),
        particles_per_cell: level.ppc,
        steps: clock.steps,
        dt: clock.dt(),
        until: clock.until,
        instants,
        particles,
        body_force: body_force(plan),
        constant_body_force: constant_body_force(plan),
    })
}

/// Whether a particle of the coarsest level starts displaced, or with another F than I.
pub(super) fn starts_deformed(plan: &ConvergencePlan) -> bool {
    let d = plan.scene.dimension();
    let Some(level) = plan.refine.levels.first() else { return false };
    // A level that cannot be handed over says so where that is tried.
    let Ok(start) = with_dimension!(d, D => particles::<D>(plan, *level)) else { return false };
    let identity = |k: usize| f64::from(u8::from(k / d == k % d));
    let mut f = start.deformation_gradient.iter().enumerate();
    start.position != start.reference_position || f.any(|(k, f)| *f != identity(k % (d * d)))
}

fn load(load: &ListedLoad) -> ProblemLoad {
    ProblemLoad { load: load.effect.name(), rows: load.rows() }
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
    };
    scene.faces.iter().map(face).collect()
}

fn material(scene: &Scene) -> ProblemMaterial {
    let law = scene.material.name();
    ProblemMaterial { law, parameters: scene.material.keyed_parameters(), density: scene.density }
}

/// The particles of all bodies, with the stress that each law gives the deformation at the start.
fn particles<const D: usize>(
    plan: &ConvergencePlan,
    level: LevelPlan,
) -> Result<ProblemParticles, String> {
    // Of a method that keeps nothing to itself.
    let method = Method::Mpm {
        basis: BasisName::Linear,
        transfer: TransferName::Flip.into(),
        scheme: SchemeName::Usl,
        start: Start::AtZero,
        mass: MassName::Lumped,
        frame: FrameName::Updated,
    };
    let mut all = ProblemParticles::default();
    for (number, body) in plan.scene.each().iter().enumerate() {
        // Loads do not change an initial state.
        let bare = Scene { loads: Vec::new(), ..body.clone() };
        let body = Body { manufactured: None, keeps_deformation: true, ..Body::of(plan, &bare) };
        let solver = Solver::<D>::new(setup(&body, method, level)?);
        let solver = solver.map_err(|failure| failure.to_string())?;
        let particles = solver.particles();
        let flat = |vectors: &[Vector<D>]| vectors.iter().flatten().copied().collect::<Vec<_>>();
        all.reference_position.extend(flat(&particles.x0));
        all.position.extend(flat(&particles.x));
        all.velocity.extend(flat(&particles.v));
        all.mass.extend(&particles.mass);
        all.reference_volume.extend(&particles.vol0);
        all.volume.extend(&particles.vol);
        for (into, tensors) in [
            (&mut all.deformation_gradient, &particles.def_grad),
            (&mut all.stress, &particles.sigma),
        ] {
            // Algebra stores columns.
            into.extend(tensors.iter().flat_map(|tensor| tensor.transpose().data.0).flatten());
        }
        all.body.extend(vec![number as f64; particles.x0.len()]);
    }
    Ok(all)
}

/// The terms of the loads on each body that are body forces.
fn forces(plan: &ConvergencePlan) -> Vec<Vec<Arc<dyn Term>>> {
    let is_force = |load: &&ListedLoad| {
        matches!(load.effect, EffectName::Gravity | EffectName::BodyForce)
            && load.target() == LoadTarget::Body
    };
    let of_body = |scene: &Scene| -> Vec<Arc<dyn Term>> {
        let forces = scene.loads.iter().filter(is_force);
        forces.map(|load| load.load.clone() as Arc<dyn Term>).collect()
    };
    plan.scene.each().iter().map(of_body).collect()
}

/// The stated body force, and the manufactured one; none where the scene has neither.
fn body_force(plan: &ConvergencePlan) -> Option<BodyForceField> {
    let force = SceneForce { terms: forces(plan), made: plan.manufactured().cloned() };
    let is_none = force.made.is_none() && force.terms.iter().all(Vec::is_empty);
    (!is_none).then(|| BodyForceField(Arc::new(force)))
}

/// The body force of a scene.
#[derive(Clone)]
struct SceneForce {
    /// The stated ones, body by body.
    terms: Vec<Vec<Arc<dyn Term>>>,
    /// The motion that needs a manufactured one.
    made: Option<Problem>,
}

impl SceneForce {
    /// The stated forces on a body, added to `made`.
    fn whole(&self, made: [f64; 3], body: usize, label: &[f64], t: f64) -> [f64; 3] {
        let terms = self.terms.get(body).map_or(&[][..], Vec::as_slice);
        std::array::from_fn(|i| {
            terms.iter().fold(made[i], |sum, term| sum + term.stated(i, label, t, &[0.0; 3]))
        })
    }
}

impl ForceSource for SceneForce {
    fn at(&self, body: usize, label: &[f64], t: f64) -> [f64; 3] {
        let made = self.made.as_ref().map_or([0.0; 3], |made| made.manufactured_force(label, t));
        self.whole(made, body, label, t)
    }

    fn at_places(&self, bodies: &[usize], labels: &[&[f64]]) -> Option<PlacedBodyForce> {
        let mut forcing = Forcing::new(self.made.as_ref()?, labels.iter().copied());
        let (force, places) = (self.clone(), owned(bodies, labels));
        Some(Box::new(move |t, into| {
            forcing.at(t, into, |made| made);
            for (into, (body, label)) in into.iter_mut().zip(&places) {
                *into = force.whole(*into, *body, label, t);
            }
        }))
    }
}

/// The body force, where it is the same at every place and time of the only body.
fn constant_body_force(plan: &ConvergencePlan) -> Option<Vec<f64>> {
    let [terms] = &forces(plan)[..] else { return None };
    let is_constant = plan.manufactured().is_none()
        && !terms.is_empty()
        && terms.iter().all(|term| term.is_constant());
    let component = |i: usize| terms.iter().map(|term| term.stated(i, &[], 0.0, &[0.0; 3])).sum();
    is_constant.then(|| (0..plan.scene.dimension()).map(component).collect())
}
