//! Checks that methods and exact solution define a judged sum over the body, such as the energy.

use crate::exact::Problem;
use crate::mpm::{MassName, VolumeName};
use crate::subject::PlaneState;
use crate::suite::compile::study::CompiledStudy;
use crate::suite::evaluator::{Evaluator, SuitePath};
use crate::suite::grammar::MethodSpec;
use crate::suite::model::{ConvergencePlan, Scene, SceneFace};
use crate::suite::scene::face::face;
use crate::suite::yaml::Diagnostic;
use crate::verify::{JudgedSum, SumNeed};
use std::sync::Arc;

pub(crate) fn judged(study: &CompiledStudy<'_>) -> Result<Option<Arc<JudgedSum>>, Diagnostic> {
    let CompiledStudy { evaluator, spec, plan, .. } = study;
    let path = evaluator.top("judge");
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
    let norm = if plan.norm.is_by_mass() && !plan.norm.is_over_instants() {
        format!("so `{}`, a norm over particles, does", plan.norm.name())
    } else {
        "so a norm over particles does".to_owned()
    };
    if plan.norm.is_over_instants() || plan.norm.is_by_mass() {
        let message = format!("the {name} is one number for the whole body, {norm} not apply");
        let help = "use `rms`, or `linf` for the largest value over the instants";
        return path.then("norm").refuse(&message, help);
    }
    let path = path.then("of");
    if plan.scene.plane == PlaneState::Axisymmetric {
        let message =
            format!("the exact solution does not provide the {name} of a body of revolution");
        return Err(path.diagnostic(&message));
    }
    let Some(problem) = &plan.exact else {
        let message = format!("the {name} of the body needs an exact solution");
        return path.refuse(&message, "state an `exact` or a `manufactured` motion");
    };
    let walls = match need {
        SumNeed::Nothing => Vec::new(),
        SumNeed::StoredEnergy => {
            stored_energy(&path, problem, plan)?;
            averaged_volume(study)?;
            Vec::new()
        }
        SumNeed::Rotation => {
            rotation(&path, plan)?;
            Vec::new()
        }
        SumNeed::Wall => walls(study)?,
    };
    let sum = JudgedSum::new(plan.of, problem, &walls)
        .map_err(|reason| path.diagnostic(&format!("the exact {name} of the body {reason}")))?;
    Ok(Some(Arc::new(sum)))
}

fn no_face(evaluator: &Evaluator<'_>, plan: &ConvergencePlan) -> Diagnostic {
    let message = format!("the {} is not a quantity of a face", plan.of.words());
    let diagnostic = evaluator.top("judge.face").diagnostic_at_key(&message);
    diagnostic.with_help("remove `face`, or judge the `reaction`")
}

fn stored_energy(
    path: &SuitePath<'_>,
    problem: &Problem,
    plan: &ConvergencePlan,
) -> Result<(), Diagnostic> {
    refuse_law_without_energy(path, &plan.scene)?;
    if problem.heat.is_some() {
        let message = "the stored energy is not supported with `heat`: the body also stores heat";
        return Err(path.diagnostic(message));
    }
    if plan.scene.each().iter().any(|body| !body.initial_stress.is_none()) {
        let message = "the exact solution does not provide the stored energy of a body with an \
                       initial stress";
        return Err(path.diagnostic(message));
    }
    if problem.equation.energy(&[[0.0; 3]; 3]).is_none() {
        let message = format!(
            "the exact solution does not provide the stored energy of `{}`",
            problem.equation.name()
        );
        return path.refuse(&message, "judge the `kinetic_energy`");
    }
    Ok(())
}

fn averaged_volume(study: &CompiledStudy<'_>) -> Result<(), Diagnostic> {
    let message = "the force of `volume: averaged` does not derive from a stored energy";
    let help = "use `particle` to judge an energy";
    refuse_setting(study, "volume", [message, help], |method| match method {
        MethodSpec::Mpm { volume: Some(volume), .. } => {
            volume.as_slice().contains(&VolumeName::Averaged)
        }
        _ => false,
    })
}

fn refuse_setting(
    CompiledStudy { evaluator, spec, .. }: &CompiledStudy<'_>,
    key: &str,
    [message, help]: [&str; 2],
    is_meant: impl Fn(&MethodSpec) -> bool,
) -> Result<(), Diagnostic> {
    let Some(i) = spec.methods.iter().position(is_meant) else { return Ok(()) };
    let path = evaluator.top("methods").then(i).then("mpm").then(key);
    path.refuse(message, help)
}

fn rotation(path: &SuitePath<'_>, plan: &ConvergencePlan) -> Result<(), Diagnostic> {
    if plan.scene.dimension() == 1 {
        return Err(path.diagnostic("there is no angular momentum in 1-D"));
    }
    if plan.scene.faces.iter().any(|face| face.hold.is_periodic()) {
        return Err(path.diagnostic("the angular momentum of a periodic body is not defined"));
    }
    Ok(())
}

fn walls(study: &CompiledStudy<'_>) -> Result<Vec<usize>, Diagnostic> {
    let CompiledStudy { evaluator, spec, plan, .. } = study;
    let (path, faces) = (evaluator.top("judge"), &plan.scene.faces);
    let of = path.then("of");
    if !plan.scene.bodies.is_empty() {
        let message = "the reaction is not supported for several bodies: they share the walls";
        return Err(of.diagnostic(message));
    }
    consistent_mass(study)?;
    let Some(name) = &spec.judge.face else {
        let held: Vec<usize> = (0..faces.len()).filter(|i| faces[*i].hold.is_held()).collect();
        if held.is_empty() {
            let diagnostic = of.diagnostic("there is no reaction, because no face is held");
            return Err(diagnostic.with_help("hold a face: `fixed` or `roller`"));
        }
        return match held.iter().find(|i| !faces[**i].hold.stays()) {
            Some(moving) => Err(no_reaction(&of, &faces[*moving])),
            None => Ok(held),
        };
    };
    let path = path.then("face");
    let number = face(&path, name, plan.scene.dimension(), false)?;
    let wall = &faces[number];
    if !wall.hold.stays() {
        return Err(no_reaction(&path, wall));
    }
    let slides = |face: &SceneFace| face.hold.stays() && !face.hold.holds_all_components();
    let is_shared = |other: &&SceneFace| {
        other.axis != wall.axis && other.hold.is_held() && !(slides(wall) && slides(other))
    };
    if let Some(other) = faces.iter().find(is_shared) {
        let message = format!(
            "the reactions of `{name}` and `{}` cannot be separated: both hold the nodes on the \
             common edge",
            other.name
        );
        return path.refuse(&message, "leave `face` out to judge all walls together");
    }
    Ok(vec![number])
}

fn no_reaction(path: &SuitePath<'_>, face: &SceneFace) -> Diagnostic {
    let (name, verb) = (face.name, face.hold.kind().verb);
    let message = format!("the {name} face {verb}: only a fixed face or a roller has a reaction");
    path.diagnostic(&message)
}

fn consistent_mass(study: &CompiledStudy<'_>) -> Result<(), Diagnostic> {
    let message = "with a consistent mass matrix, a reaction contains the inertia of other nodes";
    let help = "use `lumped` to judge a reaction";
    refuse_setting(study, "mass", [message, help], |method| match method {
        MethodSpec::Mpm { mass: Some(mass), .. } => mass.as_slice().contains(&MassName::Consistent),
        _ => false,
    })
}

pub(crate) fn refuse_law_without_energy(
    path: &SuitePath<'_>,
    scene: &Scene,
) -> Result<(), Diagnostic> {
    let material = &scene.material;
    let mut energy = material.properties().has_energy(scene.dimension());
    let is_prestressed = scene.each().iter().any(|body| !body.initial_stress.is_none());
    if is_prestressed && material.properties().depends_on_deformation_alone().is_err() {
        energy = Err("is integrated in rate form and has no stored energy with an initial stress");
    }
    let Err(reason) = energy else { return Ok(()) };
    let message = format!("the law `{}` {reason}", material.name());
    path.refuse_key(&message, "use `neo_hookean` or `hencky`")
}
