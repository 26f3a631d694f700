//! Bodies at rest: of a `rigid` material, in which nothing happens but what `heat` makes of it.
//!
//! No stage of mechanics runs and no column of it is kept, so that every word about motion is
//! refused.

use crate::exact::heat::Conduction;
use crate::suite::compile::truth::conduction::{self, ConductionInputs};
use crate::suite::compile::truth::tolerance::tolerance;
use crate::suite::evaluator::Evaluator;
use crate::suite::grammar::{ConvergenceSpec, ExactSpec, MethodSpec, SceneSpec};
use crate::suite::model::{Scene, SceneFace};
use crate::suite::scene::boundary::FaceAtRest;
use crate::suite::scene::load::LoadSpec;
use crate::suite::yaml::{Diagnostic, Path};
use std::sync::Arc;

/// Sets every face at rest that is not periodic, and refuses words that hold or move the body, and
/// other bodies. `path` is that of the map that holds the body.
pub(crate) fn settle(
    evaluator: &Evaluator<'_>,
    path: &Path,
    words: &SceneSpec,
    faces: &mut [SceneFace],
) -> Result<(), Diagnostic> {
    let idle = |at: &Path, message: &str| {
        let diagnostic = evaluator.diagnostic_at_key(at, message);
        Err(diagnostic.with_help("a `rigid` body is at rest: remove this, or choose a material"))
    };
    if words.bodies.is_some() {
        return idle(&path.then("material"), "a body that does not move in a list of bodies");
    }
    for face in faces {
        if face.hold.is_free() {
            face.hold = Arc::new(FaceAtRest);
        } else if !face.hold.is_periodic() {
            let message = format!("the {} face {}", face.name, face.hold.verb());
            return idle(&path.then("boundary").then(face.name), &message);
        }
    }
    for (key, stated) in [
        ("initial_stress", words.initial_stress.is_some()),
        ("initial_displacement", words.initial_displacement.is_some()),
        ("initial_velocity", words.initial_velocity.is_some()),
        ("sets", !words.sets.as_slice().is_empty()),
    ] {
        if stated {
            return idle(&path.then(key), &format!("`{key}` of a body that does not move"));
        }
    }
    let moves = |load: &LoadSpec| !load.words().acts_at_rest();
    match words.loads.iter().position(moves) {
        Some(i) => idle(&path.then("loads").then(i), "a load on a body that does not move"),
        None => Ok(()),
    }
}

/// The heat problem of a body at rest, checked; none where the body moves.
pub(crate) fn conduction(
    evaluator: &Evaluator<'_>,
    words: &ConvergenceSpec,
    scene: &Scene,
    until: f64,
) -> Result<Option<Conduction>, Diagnostic> {
    methods(evaluator, words, scene)?;
    conduction::methods(evaluator, words, scene)?;
    if !scene.is_at_rest() {
        return Ok(None);
    }
    judged(evaluator, words)?;
    let (path, temperature, stated, manufactured) = match (&words.exact, &words.manufactured) {
        (Some(exact), None) => {
            ("exact", exact.temperature.as_ref(), exact.tolerance.as_ref(), false)
        }
        (None, Some(made)) => ("manufactured", made.temperature.as_ref(), None, true),
        _ => {
            let at = Path::top("scene").then("material");
            let message = "a body at rest has one truth: a temperature, `exact` or `manufactured`";
            return Err(evaluator.diagnostic(&at, message));
        }
    };
    let path = Path::top(path);
    let tolerance = tolerance(evaluator, &path, stated)?;
    let inputs = ConductionInputs { motion: None, manufactured, until, tolerance };
    let problem = conduction::problem(evaluator, &path, temperature, scene, inputs)?;
    let Some(found) = &problem else {
        let at = Path::top("scene").then("material");
        let diagnostic = evaluator.diagnostic(&at, "nothing happens to a body at rest");
        return Err(diagnostic.with_help("add `heat` to `loads`, or choose a material"));
    };
    conduction::refuse_wrong_temperature(evaluator, &path, found)?;
    Ok(problem)
}

/// Bodies at rest have methods of their own.
fn methods(
    evaluator: &Evaluator<'_>,
    words: &ConvergenceSpec,
    scene: &Scene,
) -> Result<(), Diagnostic> {
    let at_rest = scene.is_at_rest();
    let fits = |method: &MethodSpec| matches!(method, MethodSpec::Heat { .. }) == at_rest;
    let Some(i) = words.methods.iter().position(|method| !fits(method)) else { return Ok(()) };
    let name = scene.material.name();
    let (message, help) = if at_rest {
        (format!("a `{name}` body does not move"), "its method is `heat: {basis: linear}`")
    } else {
        (format!("a `{name}` body moves"), "`heat` is the method of a `rigid` one; this is `mpm`")
    };
    Err(evaluator.diagnostic(&Path::top("methods").then(i), &message).with_help(help))
}

/// Refuses what is judged, observed, expected or stated of a motion.
fn judged(evaluator: &Evaluator<'_>, words: &ConvergenceSpec) -> Result<(), Diagnostic> {
    if words.judge.of.is_of_motion() {
        let message = "nothing moves, and what is judged belongs to a motion";
        let diagnostic = evaluator.diagnostic(&Path::top("scene").then("material"), message);
        return Err(diagnostic.with_help("add `judge: {of: temperature}`"));
    }
    let moves = |exact: &ExactSpec| {
        [
            ("equation", exact.equation.is_some()),
            ("displacement", exact.displacement.is_some()),
            ("linearised", exact.linearised.is_some()),
        ]
    };
    let exact = words.exact.as_ref().map(moves).into_iter().flatten();
    let made =
        words.manufactured.as_ref().map(|made| ("displacement", made.displacement.is_some()));
    let stated = exact
        .map(|(key, stated)| (Path::top("exact").then(key), stated))
        .chain(made.map(|(key, stated)| (Path::top("manufactured").then(key), stated)))
        .chain([
            (Path::top("equilibrium"), words.equilibrium.is_some()),
            (Path::top("reference"), words.reference.is_some()),
            (Path::top("observe"), words.observe.is_some()),
        ]);
    match stated.into_iter().find(|(_, stated)| *stated) {
        Some((at, _)) => {
            let diagnostic =
                evaluator.diagnostic_at_key(&at, "this speaks of a motion, and nothing moves");
            Err(diagnostic.with_help("remove it, or choose another material than `rigid`"))
        }
        None => Ok(()),
    }
}
