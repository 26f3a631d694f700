//! The heat problem that a stated temperature is to solve, and the methods that know of heat.

use super::tolerance::if_rounded;
use crate::exact::Motion;

use crate::exact::heat::{Conduction, Temperature};
use crate::mpm::{FrameName, TransferKind};
use crate::suite::evaluator::{Evaluator, coordinates_and_time};
use crate::suite::grammar::{ConvergenceSpec, MethodSpec};
use crate::suite::model::Scene;
use crate::suite::scene::boundary::thermal::ThermalFace;
use crate::suite::yaml::{Diagnostic, NumberText, OneOrMany, Path};

/// The heat problem of `scene` with the temperature that a suite states at `path`, not yet checked;
/// none where neither is there.
pub(crate) fn problem(
    evaluator: &Evaluator<'_>,
    path: &Path,
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
                evaluator.diagnostic_at_key(&path, "a temperature, and the scene has no heat");
            return Err(diagnostic.with_help("add `heat` to `loads`"));
        }
        (Some(_), None) => {
            let at = Path::top("scene").then("loads");
            let diagnostic =
                evaluator.diagnostic_at_key(&at, "heat flows, and no temperature is stated");
            return Err(diagnostic.with_help("state `temperature` under `exact` or `manufactured`"));
        }
    };
    let dimension = scene.dimension();
    let formula = evaluator.formula(&path, text, &coordinates_and_time(dimension))?;
    let ConductionInputs { motion, manufactured, until, tolerance } = rest;
    if manufactured && heat.source.is_some() {
        let message = "the source follows from the temperature, and the scene states one besides";
        let help = "remove the `source`, or state the temperature under `exact` to have it checked";
        return Err(evaluator.diagnostic_at_key(&path, message).with_help(help));
    }
    Ok(Some(Conduction {
        from: scene.from.clone(),
        to: scene.to.clone(),
        density: scene.density,
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

/// Refuses methods that know nothing of heat.
pub(crate) fn methods(
    evaluator: &Evaluator<'_>,
    words: &ConvergenceSpec,
    scene: &Scene,
) -> Result<(), Diagnostic> {
    if scene.heat().is_none() {
        return Ok(());
    }
    if words.reference.is_some() {
        let message = "a reference knows nothing of heat, which flows in the scene";
        return Err(evaluator.diagnostic_at_key(&Path::top("reference"), message));
    }
    for (i, method) in words.methods.iter().enumerate() {
        let path = Path::top("methods").then(i);
        match method {
            MethodSpec::Heat { .. } | MethodSpec::External { .. } => {}
            MethodSpec::Fem { .. } => {
                let message = "the reference FEM knows nothing of heat, which flows in the scene";
                return Err(evaluator.diagnostic(&path, message));
            }
            MethodSpec::Mpm { transfer, frame, .. } => {
                let frames = frame.as_ref().map_or(&[][..], OneOrMany::as_slice);
                if frames.contains(&FrameName::Total) {
                    let message = "heat flows in the body as it is now, which a total-Lagrangian \
                                   grid does not see";
                    return Err(evaluator.diagnostic(&path.then("mpm").then("frame"), message));
                }
                if transfer.as_slice().iter().any(|transfer| transfer.kind() == TransferKind::Cells)
                {
                    let message = "heat is summed over particles, and a transfer that integrates \
                                   over cells has other nodal masses";
                    return Err(evaluator.diagnostic(&path.then("mpm").then("transfer"), message));
                }
            }
        }
    }
    Ok(())
}

/// Inputs of a heat problem besides the scene.
pub(crate) struct ConductionInputs {
    /// How the body deforms.
    pub(crate) motion: Option<Motion>,
    /// Whether the source follows from the temperature.
    pub(crate) manufactured: bool,
    /// End of the run (s).
    pub(crate) until: f64,
    /// Largest relative residual.
    pub(crate) tolerance: f64,
}

/// Holds the temperature that is stated at `path` against its problem.
pub(crate) fn refuse_wrong_temperature(
    evaluator: &Evaluator<'_>,
    path: &Path,
    problem: &Conduction,
) -> Result<(), Diagnostic> {
    problem.check().map_err(|violation| {
        let diagnostic = evaluator.diagnostic(&path.then("temperature"), &violation.to_string());
        let rounded = if_rounded(&violation, problem.tolerance);
        diagnostic
            .with_label("this is not a solution of the problem that the scene states")
            .with_help(&format!(
                "correct the formula, or `heat`: numbers, source, boundary, initial state{rounded}"
            ))
    })
}
