//! Refuses keys and features that load steps do not support.

use crate::subject::PlaneState;
use crate::suite::compile::study::StudyDraft;
use crate::suite::evaluator::{COORDINATES, SuitePath};
use crate::suite::grammar::MethodSpec;
use crate::suite::model::{Scene, SceneFace};
use crate::suite::scene::EffectName;
use crate::suite::scene::load::ListedLoad;
use crate::suite::yaml::Diagnostic;
use crate::verify::Quantity;

pub(crate) fn refuse_unfit(draft: &StudyDraft<'_>) -> Result<(), Diagnostic> {
    refuse_time(draft)?;
    if draft.spec.run.load_steps.is_some() { refuse_unfit_scene(draft) } else { Ok(()) }
}

fn refuse_time(draft: &StudyDraft<'_>) -> Result<(), Diagnostic> {
    let StudyDraft { evaluator, spec, .. } = draft;
    let method = |wanted: &dyn Fn(&MethodSpec) -> bool| spec.methods.iter().position(wanted);
    if spec.run.load_steps.is_none() {
        let Some(i) = method(&MethodSpec::is_quasi_static) else { return Ok(()) };
        let path = evaluator.top("methods").then(i).then("mpm").then("scheme");
        let message = "`quasi_static` needs a number of load steps";
        return path.refuse(message, "write `run: {load_steps: 20}` instead of `until`");
    }
    let after_the_last_step = "errors are computed after the last step only";
    let refused = [
        ("run.dt", "dt", spec.run.dt.is_some(), "they have no duration"),
        ("refine.dt", "dt", spec.refine.dt.is_some(), "they have no duration"),
        ("run.instants", "instants", spec.run.instants.is_some(), after_the_last_step),
        ("exact", "exact", spec.exact.is_some(), "it is a motion in time"),
        ("manufactured", "manufactured", spec.manufactured.is_some(), "it is a motion in time"),
        ("reference.fem", "reference.fem", spec.has_fem_reference(), "it is computed in time"),
    ];
    if let Some((path, key, _, reason)) = refused.iter().find(|(_, _, is_stated, _)| *is_stated) {
        let message = format!("`{key}` is not supported with load steps: {reason}");
        let diagnostic = evaluator.top(path).diagnostic_at_key(&message);
        return Err(diagnostic.with_help("state the `equilibrium` under the full load"));
    }
    if OF_VELOCITIES.contains(&spec.judge.of) {
        let message = format!(
            "`{}` is not supported with load steps: they have no velocity",
            spec.judge.of.name()
        );
        let diagnostic = evaluator.top("judge.of").diagnostic(&message);
        return Err(diagnostic.with_help("judge the `displacement` or the `stress`"));
    }
    if spec.equilibrium.is_none() && spec.reference.is_none() {
        let message = "load steps need an `equilibrium` or a `reference`: they end in equilibrium";
        let diagnostic = evaluator.top("run.load_steps").diagnostic_at_key(message);
        return Err(diagnostic.with_help("add `equilibrium: {equation: ..., displacement: [...]}`"));
    }
    let is_dynamic =
        |spec: &MethodSpec| !spec.is_quasi_static() && !matches!(spec, MethodSpec::External { .. });
    match method(&is_dynamic) {
        Some(i) => evaluator.top("methods").then(i).refuse(
            "this method needs time steps, and the suite has load steps",
            "use `mpm: {basis: cpgimp, scheme: quasi_static}`",
        ),
        None => Ok(()),
    }
}

fn refuse_unfit_scene(draft: &StudyDraft<'_>) -> Result<(), Diagnostic> {
    let StudyDraft { evaluator, spec, scene } = draft;
    let top = evaluator.top("scene");
    let help = "load steps need loads and walls that depend neither on time nor on the motion";
    let in_plane_stress =
        "load steps are not supported in plane stress, whose laws have no tangent";
    let displaced = "`initial_displacement` is not supported with load steps: they start from the \
                     reference configuration";
    let moving = "`initial_velocity` is not supported with load steps: they have no velocity";
    let is_displaced = !scene.initial_displacement.is_empty();
    let refused = [
        (!scene.bodies.is_empty(), "bodies", "load steps are supported for a single body only"),
        (scene.plane == PlaneState::Stress, "plane", in_plane_stress),
        (is_displaced, "initial_displacement", displaced),
        (!scene.initial_velocity.is_empty(), "initial_velocity", moving),
        (scene.loads.is_empty(), "material", "load steps need a load, but the scene has none"),
    ];
    if let Some((_, key, message)) = refused.into_iter().find(|(is_refused, ..)| *is_refused) {
        return Err(top.then(key).diagnostic_at_key(message));
    }
    for (listed, stated) in scene.loads.iter().zip(listed_paths(draft)) {
        if let Some(reason) = against_load(listed, scene.dimension()) {
            let message =
                format!("`{}` is not supported in load steps: {reason}", listed.effect.name());
            return stated.refuse(&message, help);
        }
    }
    let moving = |face: &&SceneFace| !KNOWN_CONDITIONS.contains(&face.condition());
    if let Some(face) = scene.faces.iter().find(moving) {
        let message = format!(
            "the {} face {}, which load steps do not support",
            face.name,
            face.hold.kind().verb
        );
        let at = top.then("boundary").then(face.name);
        return at.refuse_key(&message, help);
    }
    if let Some(axis) = (0..scene.dimension()).find(|axis| !is_held(scene, *axis)) {
        let message = format!("nothing holds the body along {}", COORDINATES[axis]);
        let diagnostic = top.then("body").diagnostic_at_key(&message);
        return Err(diagnostic.with_help("fix a face, or add a roller with this normal"));
    }
    let is_built_in = spec.methods.iter().any(MethodSpec::is_quasi_static);
    match scene.material.properties().has_tangent() {
        Err(reason) if is_built_in => {
            let name = scene.material.name();
            let message = format!("`quasi_static` does not support `{name}`: {reason}");
            let help = "laws with a tangent: neo_hookean, hencky, j2, drucker_prager, mohr_coulomb";
            top.then("material").refuse(&message, help)
        }
        _ => Ok(()),
    }
}

/// Whether a face prevents rigid translation along an axis. A body of revolution has no rigid
/// translation along its radius.
fn is_held(scene: &Scene, axis: usize) -> bool {
    if scene.plane == PlaneState::Axisymmetric && axis == 0 {
        return true;
    }
    let holds = |face: &SceneFace| {
        face.hold.holds_all_components() || (face.hold.is_held() && face.axis == axis)
    };
    scene.faces.iter().any(holds)
}

/// Quantities that are zero if the body has no velocity.
const OF_VELOCITIES: [Quantity; 4] =
    [Quantity::Velocity, Quantity::KineticEnergy, Quantity::Momentum, Quantity::AngularMomentum];

const KNOWN_CONDITIONS: [&str; 4] = ["free", "fixed", "roller", "periodic"];

fn against_load(load: &ListedLoad, dimension: usize) -> Option<&'static str> {
    match load.effect {
        EffectName::Damping | EffectName::LocalDamping | EffectName::ArtificialViscosity => {
            return Some("there is no velocity to damp");
        }
        EffectName::PrescribedVelocity => return Some("a velocity belongs to a motion in time"),
        EffectName::Heat | EffectName::ThermalExpansion => {
            return Some("heat conduction depends on time");
        }
        EffectName::Pressure => {
            return Some("it is a follower load, which the tangent does not contain");
        }
        EffectName::Gravity
        | EffectName::BodyForce
        | EffectName::Traction
        | EffectName::SetForce => {}
    }
    let [_, of_time, of_displacement] =
        load.numbers().field.map_or([false; 3], |field| field.depends_on(dimension));
    if of_time {
        return Some("it depends on t, but load steps have no time");
    }
    of_displacement.then_some("it depends on the displacement, which the tangent does not contain")
}

/// Returns the paths of the loads in the suite file, in the order of `scene`.
fn listed_paths<'a>(draft: &StudyDraft<'a>) -> Vec<SuitePath<'a>> {
    let StudyDraft { evaluator, spec, scene } = draft;
    let mut stated: Vec<(EffectName, SuitePath<'_>)> = spec
        .scene
        .loads
        .iter()
        .enumerate()
        .map(|(i, load)| (load.effect(), load.path(evaluator, i)))
        .collect();
    let mut path_of = |load: &ListedLoad| {
        let place = stated.iter().position(|(effect, _)| *effect == load.effect)?;
        Some(stated.remove(place).1)
    };
    scene.loads.iter().map(|load| path_of(load).unwrap_or_else(|| evaluator.top("scene"))).collect()
}
