//! Checks that a judged sum over the body is defined for every subject and for the exact solution.

use crate::exact::Problem;
use crate::mpm::{MassName, VolumeName};
use crate::subject::PlaneState;
use crate::suite::evaluator::Evaluator;
use crate::suite::grammar::{ConvergenceSpec, MethodSpec};
use crate::suite::model::{ConvergencePlan, Scene, SceneFace};
use crate::suite::scene::face::face;
use crate::suite::yaml::{Diagnostic, Path};
use crate::verify::{JudgedSum, SumNeed};
use std::sync::Arc;

/// The judged sum with its exact value, if `judge` names a sum.
///
/// # Errors
/// The reason why a subject or the exact solution does not define the sum.
pub(crate) fn judged(
    evaluator: &Evaluator<'_>,
    spec: &ConvergenceSpec,
    plan: &ConvergencePlan,
) -> Result<Option<Arc<JudgedSum>>, Diagnostic> {
    let path = Path::top("judge");
    let Some(need) = plan.of.sum_need() else {
        return match spec.judge.face {
            None => Ok(None),
            Some(_) => Err(no_face(evaluator, plan)),
        };
    };
    if need != SumNeed::Wall && spec.judge.face.is_some() {
        return Err(no_face(evaluator, plan));
    }
    let name = plan.of.words();
    if plan.norm.is_over_instants() {
        let message = format!("the {name} is one number at a time, and `rms` is over the instants");
        let diagnostic = evaluator.diagnostic(&path.then("norm"), &message);
        return Err(diagnostic.with_help("take `rms`, or `linf` for the largest over the instants"));
    }
    if plan.norm.is_by_mass() {
        let norm = plan.norm.name();
        let message = format!("the {name} is one number at a time, and `{norm}` weights particles");
        let diagnostic = evaluator.diagnostic(&path.then("norm"), &message);
        return Err(diagnostic.with_help("take `rms`, or `linf` for the largest over the instants"));
    }
    let path = path.then("of");
    if plan.scene.plane == PlaneState::Axisymmetric {
        let message = format!("the {name} of a body of revolution is not known to the truth");
        return Err(evaluator.diagnostic(&path, &message));
    }
    let Some(problem) = &plan.exact else {
        let message = format!("no truth tells the {name} of the body");
        let diagnostic = evaluator.diagnostic(&path, &message);
        return Err(diagnostic.with_help("state an `exact` or a `manufactured` motion"));
    };
    let walls = match need {
        SumNeed::Nothing => Vec::new(),
        SumNeed::StoredEnergy => {
            stored_energy(evaluator, &path, problem, plan)?;
            averaged_volume(evaluator, spec)?;
            Vec::new()
        }
        SumNeed::Rotation => {
            rotation(evaluator, &path, plan)?;
            Vec::new()
        }
        SumNeed::Wall => walls(evaluator, spec, plan)?,
    };
    let sum = JudgedSum::new(plan.of, problem, &walls).map_err(|reason| {
        evaluator.diagnostic(&path, &format!("the exact {name} of the body {reason}"))
    })?;
    Ok(Some(Arc::new(sum)))
}

fn no_face(evaluator: &Evaluator<'_>, plan: &ConvergencePlan) -> Diagnostic {
    let message = format!("the {} is not that of a face", plan.of.words());
    let diagnostic = evaluator.diagnostic_at_key(&Path::top("judge").then("face"), &message);
    diagnostic.with_help("remove it, or judge the `reaction`")
}

/// Refuses an energy that the law of the solver or of the exact solution does not define.
fn stored_energy(
    evaluator: &Evaluator<'_>,
    path: &Path,
    problem: &Problem,
    plan: &ConvergencePlan,
) -> Result<(), Diagnostic> {
    refuse_law_without_energy(evaluator, path, &plan.scene)?;
    if problem.heat.is_some() {
        let message = "the energy of a body in which heat flows is more than that of its strain";
        return Err(evaluator.diagnostic(path, message));
    }
    if plan.scene.each().iter().any(|body| !body.initial_stress.is_none()) {
        let message = "the truth knows no stored energy beside an initial stress";
        return Err(evaluator.diagnostic(path, message));
    }
    if problem.equation.energy(&[[0.0; 3]; 3]).is_none() {
        let message = format!("the truth knows no stored energy of `{}`", problem.equation.name());
        let diagnostic = evaluator.diagnostic(path, &message);
        return Err(diagnostic.with_help("judge the `kinetic_energy`"));
    }
    Ok(())
}

/// Refuses an energy from which the force of a method does not derive.
fn averaged_volume(evaluator: &Evaluator<'_>, spec: &ConvergenceSpec) -> Result<(), Diagnostic> {
    let is_averaged = |method: &MethodSpec| match method {
        MethodSpec::Mpm { volume: Some(volume), .. } => {
            volume.as_slice().contains(&VolumeName::Averaged)
        }
        _ => false,
    };
    let Some(i) = spec.methods.iter().position(is_averaged) else { return Ok(()) };
    let message = "the force of `volume: averaged` does not derive from a stored energy";
    let path = Path::top("methods").then(i).then("mpm").then("volume");
    Err(evaluator.diagnostic(&path, message).with_help("take `particle` to judge an energy"))
}

/// Refuses an angular momentum on a line, and of a body that has no one place.
fn rotation(
    evaluator: &Evaluator<'_>,
    path: &Path,
    plan: &ConvergencePlan,
) -> Result<(), Diagnostic> {
    if plan.scene.dimension() == 1 {
        return Err(evaluator.diagnostic(path, "there is no angular momentum in 1-D"));
    }
    if plan.scene.faces.iter().any(|face| face.hold.is_periodic()) {
        let message = "a periodic body has no place about which it could turn";
        return Err(evaluator.diagnostic(path, message));
    }
    Ok(())
}

/// Indices of the walls whose reaction is judged.
fn walls(
    evaluator: &Evaluator<'_>,
    spec: &ConvergenceSpec,
    plan: &ConvergencePlan,
) -> Result<Vec<usize>, Diagnostic> {
    let (path, faces) = (Path::top("judge"), &plan.scene.faces);
    let of = path.then("of");
    if !plan.scene.bodies.is_empty() {
        let message = "several bodies share the walls, which tell no reaction then";
        return Err(evaluator.diagnostic(&of, message));
    }
    consistent_mass(evaluator, spec)?;
    let Some(name) = &spec.judge.face else {
        let held: Vec<usize> = (0..faces.len()).filter(|i| faces[*i].hold.is_held()).collect();
        if held.is_empty() {
            let diagnostic = evaluator.diagnostic(&of, "nothing is held, and so nothing reacts");
            return Err(diagnostic.with_help("hold a face: `fixed` or `roller`"));
        }
        return match held.iter().find(|i| !faces[**i].hold.stays()) {
            Some(moving) => Err(no_reaction(evaluator, &of, &faces[*moving])),
            None => Ok(held),
        };
    };
    let path = path.then("face");
    let number = face(evaluator, &path, name, plan.scene.dimension(), false)?;
    let wall = &faces[number];
    if !wall.hold.stays() {
        return Err(no_reaction(evaluator, &path, wall));
    }
    let slides = |face: &SceneFace| face.hold.stays() && !face.hold.holds_all_components();
    let is_shared = |other: &&SceneFace| {
        other.axis != wall.axis && other.hold.is_held() && !(slides(wall) && slides(other))
    };
    if let Some(other) = faces.iter().find(is_shared) {
        let message = format!(
            "nodes on the edge between `{name}` and `{}` are held by both, and tell one force",
            other.name
        );
        let diagnostic = evaluator.diagnostic(&path, &message);
        return Err(diagnostic.with_help("leave `face` out to judge all walls together"));
    }
    Ok(vec![number])
}

fn no_reaction(evaluator: &Evaluator<'_>, path: &Path, face: &SceneFace) -> Diagnostic {
    let (name, verb) = (face.name, face.hold.verb());
    let message =
        format!("the {name} face {verb}: a reaction is told of a fixed face or a roller only");
    evaluator.diagnostic(path, &message)
}

/// Refuses a consistent mass matrix, which adds the inertia of other nodes to the reaction of a
/// wall.
fn consistent_mass(evaluator: &Evaluator<'_>, spec: &ConvergenceSpec) -> Result<(), Diagnostic> {
    let is_consistent = |method: &MethodSpec| match method {
        MethodSpec::Mpm { mass: Some(mass), .. } => mass.as_slice().contains(&MassName::Consistent),
        _ => false,
    };
    let Some(i) = spec.methods.iter().position(is_consistent) else { return Ok(()) };
    let message = "with a consistent mass matrix the inertia of other nodes is part of a reaction";
    let path = Path::top("methods").then(i).then("mpm").then("mass");
    Err(evaluator.diagnostic(&path, message).with_help("take `lumped` to judge a reaction"))
}

/// Refuses a bound on the energy of a body whose law has no energy; `path` is the path of the
/// bound.
pub(crate) fn refuse_law_without_energy(
    evaluator: &Evaluator<'_>,
    path: &Path,
    scene: &Scene,
) -> Result<(), Diagnostic> {
    let material = &scene.material;
    let mut energy = material.properties().has_energy(scene.dimension());
    let is_prestressed = scene.each().iter().any(|body| !body.initial_stress.is_none());
    if is_prestressed && material.properties().depends_on_deformation_alone().is_err() {
        energy = Err("is integrated in rate form, and has no energy beside an initial stress");
    }
    let Err(reason) = energy else { return Ok(()) };
    let message = format!("the law `{}` {reason}", material.name());
    let diagnostic = evaluator.diagnostic_at_key(path, &message);
    Err(diagnostic.with_help("take `neo_hookean` or `hencky`"))
}
