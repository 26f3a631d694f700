//! Compiles heat problems with a stated temperature, of bodies that move or are at rest.

use super::tolerance::{if_rounded, tolerance};
use crate::exact::Motion;
use crate::exact::heat::{Conduction, Temperature};
use crate::mpm::{FrameName, TransferKind};
use crate::suite::compile::study::StudyDraft;
use crate::suite::evaluator::SuitePath;
use crate::suite::grammar::{ExactSpec, MethodSpec};
use crate::suite::model::Scene;
use crate::suite::scene::boundary::thermal::ThermalFace;
use crate::suite::yaml::{Diagnostic, NumberText, OneOrMany};

/// Compiles the heat problem of a body at rest; returns `None` if the body moves.
pub(crate) fn conduction(
    draft: &StudyDraft<'_>,
    until: f64,
) -> Result<Option<Conduction>, Diagnostic> {
    let StudyDraft { evaluator, spec, scene } = draft;
    refuse_methods_of_other_bodies(draft)?;
    refuse_methods_without_heat(draft)?;
    if !scene.is_at_rest() {
        return Ok(None);
    }
    judged(draft)?;
    let (path, temperature, stated, manufactured) = match (&spec.exact, &spec.manufactured) {
        (Some(exact), None) => {
            ("exact", exact.temperature.as_ref(), exact.tolerance.as_ref(), false)
        }
        (None, Some(made)) => ("manufactured", made.temperature.as_ref(), None, true),
        _ => {
            let at = evaluator.top("scene.material");
            let message = "a `rigid` body needs one exact solution: a temperature under `exact` or \
                           `manufactured`";
            return Err(at.diagnostic(message));
        }
    };
    let path = evaluator.top(path);
    let tolerance = tolerance(&path, stated)?;
    let inputs = ConductionInputs { motion: None, manufactured, until, tolerance };
    let found = problem(&path, temperature, scene, inputs)?;
    let Some(found) = found else {
        let at = evaluator.top("scene.material");
        let diagnostic = at.diagnostic("a `rigid` body needs `heat`");
        return Err(diagnostic.with_help("add `heat` to `loads`, or choose another material"));
    };
    Ok(Some(found))
}

fn refuse_methods_of_other_bodies(draft: &StudyDraft<'_>) -> Result<(), Diagnostic> {
    let StudyDraft { evaluator, spec, scene } = draft;
    let at_rest = scene.is_at_rest();
    let fits = |method: &MethodSpec| matches!(method, MethodSpec::Heat { .. }) == at_rest;
    let Some(i) = spec.methods.iter().position(|method| !fits(method)) else { return Ok(()) };
    let name = scene.material.name();
    let (message, help) = if at_rest {
        (
            format!("this method is for bodies that move, but a `{name}` body does not move"),
            "use `heat: {basis: linear}`",
        )
    } else {
        (
            format!("the method `heat` is for bodies that do not move, but a `{name}` body moves"),
            "use `mpm`, or the material `rigid`",
        )
    };
    evaluator.top("methods").then(i).refuse(&message, help)
}

fn judged(draft: &StudyDraft<'_>) -> Result<(), Diagnostic> {
    let StudyDraft { evaluator, spec, .. } = draft;
    if spec.judge.of.is_of_motion() {
        let message = "the judged quantity needs a motion, but the body is `rigid`";
        return evaluator.top("scene.material").refuse(message, "add `judge: {of: temperature}`");
    }
    let of_exact = |has: fn(&ExactSpec) -> bool| spec.exact.as_ref().is_some_and(has);
    let made = spec.manufactured.as_ref();
    let moves = "this key needs a motion, but the body is `rigid`";
    let stated = [
        (of_exact(|exact| exact.equation.is_some()), "exact.equation", moves),
        (of_exact(|exact| exact.displacement.is_some()), "exact.displacement", moves),
        (of_exact(|exact| exact.linearised.is_some()), "exact.linearised", moves),
        (made.is_some_and(|m| m.displacement.is_some()), "manufactured.displacement", moves),
        (spec.equilibrium.is_some(), "equilibrium", moves),
        (spec.reference.is_some(), "reference", moves),
        (spec.observe.is_some(), "observe", moves),
    ];
    evaluator.refuse_first(&stated, |path, message| {
        let help = "remove it, or choose another material than `rigid`";
        path.diagnostic_at_key(message).with_help(help)
    })
}

pub(crate) fn problem(
    path: &SuitePath<'_>,
    temperature: Option<&NumberText>,
    scene: &Scene,
    rest: ConductionInputs,
) -> Result<Option<Conduction>, Diagnostic> {
    let path = path.then("temperature");
    let (heat, text) = match (scene.heat(), temperature) {
        (Some(heat), Some(text)) => (heat, text),
        (None, None) => return Ok(None),
        (None, Some(_)) => {
            let diagnostic =
                path.diagnostic_at_key("a temperature is stated, but the scene has no `heat`");
            return Err(diagnostic.with_help("add `heat` to `loads`"));
        }
        (Some(_), None) => {
            let at = path.evaluator.top("scene.loads");
            let diagnostic =
                at.diagnostic_at_key("the scene has `heat`, but no temperature is stated");
            return Err(diagnostic.with_help("state `temperature` under `exact` or `manufactured`"));
        }
    };
    let dimension = scene.dimension();
    let formula = path.field(text, dimension)?;
    let ConductionInputs { motion, manufactured, until, tolerance } = rest;
    if manufactured && heat.source.is_some() {
        let message = "the manufactured temperature defines the source: remove `source`";
        let help = "to have a stated source checked, state the temperature under `exact`";
        return path.refuse_key(message, help);
    }
    Ok(Some(Conduction {
        from: scene.from.clone(),
        to: scene.to.clone(),
        // A varying density is refused in `compile::scene::material`.
        density: scene.density.largest(),
        conductivity: heat.conductivity,
        capacity: heat.capacity,
        source: heat.source.clone(),
        initial: heat.initial.clone(),
        faces: heat.faces.iter().map(ThermalFace::exact).collect(),
        temperature: Temperature::new(formula, dimension),
        motion,
        manufactured,
        until,
        tolerance,
    }))
}

fn refuse_methods_without_heat(draft: &StudyDraft<'_>) -> Result<(), Diagnostic> {
    let StudyDraft { evaluator, spec, scene } = draft;
    if scene.heat().is_none() {
        return Ok(());
    }
    if spec.reference.is_some() {
        let message = "`reference` does not support heat";
        return Err(evaluator.top("reference").diagnostic_at_key(message));
    }
    for (i, method) in spec.methods.iter().enumerate() {
        let path = evaluator.top("methods").then(i);
        match method {
            MethodSpec::Heat { .. } | MethodSpec::External { .. } => {}
            MethodSpec::Fem { .. } => {
                return Err(path.diagnostic("the built-in FEM does not support heat"));
            }
            MethodSpec::Mpm { transfer, frame, .. } => {
                let frames = frame.as_ref().map_or(&[][..], OneOrMany::as_slice);
                if frames.contains(&FrameName::Total) {
                    let message = "`total_lagrangian` does not support heat, which flows in the \
                                   deformed body";
                    return Err(path.then("mpm").then("frame").diagnostic(message));
                }
                let transfers = transfer.as_ref().map_or(&[][..], OneOrMany::as_slice);
                if transfers.iter().any(|transfer| transfer.0.kind() == TransferKind::Cells) {
                    let message = "a transfer that integrates over cells does not support heat, \
                                   which is summed over particles";
                    return Err(path.then("mpm").then("transfer").diagnostic(message));
                }
            }
        }
    }
    Ok(())
}

pub(crate) struct ConductionInputs {
    pub(crate) motion: Option<Motion>,
    pub(crate) manufactured: bool,
    /// End of the run (s).
    pub(crate) until: f64,
    /// Maximum relative residual.
    pub(crate) tolerance: f64,
}

pub(crate) fn refuse_wrong_temperature(
    path: &SuitePath<'_>,
    problem: &Conduction,
) -> Result<(), Diagnostic> {
    problem.check().map_err(|violation| {
        let diagnostic = path.then("temperature").diagnostic(&violation.to_string());
        let rounded = if_rounded(&violation, problem.tolerance);
        diagnostic
            .with_label("this is not a solution of the problem that the scene states")
            .with_help(&format!(
                "correct the formula, or `heat`: numbers, source, boundary, initial state{rounded}"
            ))
    })
}
