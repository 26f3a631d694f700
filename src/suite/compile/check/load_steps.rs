//! Checks of suites with load steps in place of time: keys of a motion, and loads, conditions and
//! laws that the quasi-static solver does not support.

use crate::subject::PlaneState;
use crate::suite::evaluator::{COORDINATES, Evaluator};
use crate::suite::grammar::{ConvergenceSpec, MethodSpec};
use crate::suite::model::{Scene, SceneFace};
use crate::suite::scene::EffectName;
use crate::suite::scene::load::ListedLoad;
use crate::suite::yaml::{Diagnostic, Path};

/// Refuses load steps with keys of a motion in time, and quasi-static methods without load steps.
///
/// # Errors
/// A diagnostic at the key, with the reason.
pub(crate) fn refuse_time(
    evaluator: &Evaluator<'_>,
    spec: &ConvergenceSpec,
) -> Result<(), Diagnostic> {
    let method = |wanted: &dyn Fn(&MethodSpec) -> bool| spec.methods.iter().position(wanted);
    if spec.run.load_steps.is_none() {
        let Some(i) = method(&MethodSpec::is_quasi_static) else { return Ok(()) };
        let path = Path::top("methods").then(i).then("mpm").then("scheme");
        let message = "`quasi_static` needs a number of load steps";
        let diagnostic = evaluator.diagnostic(&path, message);
        return Err(diagnostic.with_help("write `run: {load_steps: 20}` in place of `until`"));
    }
    let run = Path::top("run");
    let refused = [
        (spec.run.dt.is_some(), run.then("dt"), "load steps have no length in time"),
        (
            spec.refine.dt.is_some(),
            Path::top("refine").then("dt"),
            "load steps have no length in time",
        ),
        (
            spec.run.instants.is_some(),
            run.then("instants"),
            "the error is taken after the last load step",
        ),
        (
            spec.exact.is_some(),
            Path::top("exact"),
            "an `exact` solution is a motion in time, and load steps have no time",
        ),
        (
            spec.manufactured.is_some(),
            Path::top("manufactured"),
            "a manufactured force belongs to a motion in time, and load steps have no time",
        ),
        (
            spec.has_fem_reference(),
            Path::top("reference").then("fem"),
            "the reference FEM is computed in time, and load steps have no time",
        ),
    ];
    if let Some((_, path, message)) = refused.into_iter().find(|(is_refused, ..)| *is_refused) {
        let diagnostic = evaluator.diagnostic_at_key(&path, message);
        return Err(diagnostic.with_help("state the `equilibrium` under the whole load"));
    }
    if spec.equilibrium.is_none() && spec.reference.is_none() {
        let message = "load steps end in an equilibrium, and the suite states none";
        let diagnostic = evaluator.diagnostic_at_key(&run.then("load_steps"), message);
        return Err(diagnostic.with_help("add `equilibrium: {equation: ..., displacement: [...]}`"));
    }
    let is_dynamic =
        |spec: &MethodSpec| !spec.is_quasi_static() && !matches!(spec, MethodSpec::External { .. });
    match method(&is_dynamic) {
        Some(i) => {
            let message = "this method integrates in time, and load steps have no time";
            let diagnostic = evaluator.diagnostic(&Path::top("methods").then(i), message);
            Err(diagnostic.with_help("use `mpm: {basis: cpgimp, scheme: quasi_static}`"))
        }
        None => Ok(()),
    }
}

/// Refuses a scene that load steps have no meaning for, or that the quasi-static solver does not
/// support.
///
/// # Errors
/// A diagnostic at the part of the scene, with the reason.
pub(crate) fn refuse_unfit(
    evaluator: &Evaluator<'_>,
    spec: &ConvergenceSpec,
    scene: &Scene,
) -> Result<(), Diagnostic> {
    if spec.run.load_steps.is_none() {
        return Ok(());
    }
    let top = Path::top("scene");
    let help = "load steps need loads and walls that depend neither on time nor on the motion";
    let refused = [
        (!scene.bodies.is_empty(), "bodies", "load steps of several bodies are not implemented"),
        (
            scene.plane != PlaneState::Strain,
            "plane",
            "load steps are implemented in plane strain and 3-D only",
        ),
        (
            !scene.initial_stress.is_none(),
            "initial_stress",
            "load steps start from a body without stress",
        ),
        (
            !scene.initial_displacement.is_empty(),
            "initial_displacement",
            "load steps start from the reference configuration",
        ),
        (!scene.initial_velocity.is_empty(), "initial_velocity", "load steps have no velocity"),
        (scene.loads.is_empty(), "material", "load steps apply a load, and the scene has none"),
    ];
    if let Some((_, key, message)) = refused.into_iter().find(|(is_refused, ..)| *is_refused) {
        return Err(evaluator.diagnostic_at_key(&top.then(key), message));
    }
    for (listed, stated) in scene.loads.iter().zip(listed_paths(spec, scene)) {
        if let Some(reason) = against_load(listed, scene.dimension()) {
            let message = format!("`{}` in load steps: {reason}", listed.effect.name());
            return Err(evaluator.diagnostic(&stated, &message).with_help(help));
        }
    }
    let moving = |face: &&SceneFace| !KNOWN_CONDITIONS.contains(&face.condition());
    if let Some(face) = scene.faces.iter().find(moving) {
        let message = format!("the {} face {}, not in load steps", face.name, face.hold.verb());
        let at = top.then("boundary").then(face.name);
        return Err(evaluator.diagnostic_at_key(&at, &message).with_help(help));
    }
    if let Some(axis) = (0..scene.dimension()).find(|axis| !is_held(scene, *axis)) {
        let message = format!("nothing holds the body along {}", COORDINATES[axis]);
        let diagnostic = evaluator.diagnostic_at_key(&top.then("body"), &message);
        return Err(diagnostic.with_help("fix a face, or add a roller with this normal"));
    }
    let is_built_in = spec.methods.iter().any(MethodSpec::is_quasi_static);
    match scene.material.properties().has_tangent() {
        Err(reason) if is_built_in => {
            let name = scene.material.name();
            let message = format!("`quasi_static` does not support `{name}`: {reason}");
            let help = "laws with a tangent: neo_hookean, hencky, j2, drucker_prager, mohr_coulomb";
            Err(evaluator.diagnostic(&top.then("material"), &message).with_help(help))
        }
        _ => Ok(()),
    }
}

/// Whether a face holds the body along an axis.
fn is_held(scene: &Scene, axis: usize) -> bool {
    let holds = |face: &SceneFace| {
        face.hold.holds_all_components() || (face.hold.is_held() && face.axis == axis)
    };
    scene.faces.iter().any(holds)
}

/// Conditions on faces that neither move nor depend on the motion.
const KNOWN_CONDITIONS: [&str; 4] = ["free", "fixed", "roller", "periodic"];

/// Why a load cannot be applied in load steps.
fn against_load(load: &ListedLoad, dimension: usize) -> Option<&'static str> {
    match load.effect {
        EffectName::Damping | EffectName::LocalDamping | EffectName::ArtificialViscosity => {
            return Some("there is no velocity to damp");
        }
        EffectName::PrescribedVelocity => return Some("a velocity belongs to a motion in time"),
        EffectName::Heat | EffectName::ThermalExpansion => {
            return Some("heat flows in time");
        }
        EffectName::Pressure => {
            return Some("it follows the face, and the tangent has no such term");
        }
        EffectName::Gravity
        | EffectName::BodyForce
        | EffectName::Traction
        | EffectName::SetForce => {}
    }
    let [_, of_time, of_displacement] =
        load.numbers().field.map_or([false; 3], |field| field.depends_on(dimension));
    if of_time {
        return Some("it depends on t, and load steps have no time");
    }
    of_displacement.then_some("it depends on the displacement, and the tangent has no such term")
}

/// Paths of the loads, in the order of the scene.
fn listed_paths(spec: &ConvergenceSpec, scene: &Scene) -> Vec<Path> {
    let mut stated: Vec<(EffectName, Path)> = spec
        .scene
        .loads
        .iter()
        .enumerate()
        .map(|(i, load)| (load.effect(), load.path(i)))
        .collect();
    let mut path_of = |load: &ListedLoad| {
        let place = stated.iter().position(|(effect, _)| *effect == load.effect)?;
        Some(stated.remove(place).1)
    };
    scene.loads.iter().map(|load| path_of(load).unwrap_or_else(|| Path::top("scene"))).collect()
}
