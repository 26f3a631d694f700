//! Conditions outside the scope of the FEM bar, refused before anything runs.

use crate::suite::compile::evaluator::Evaluator;
use crate::suite::compile::path::Path;
use crate::suite::grammar::ConvergenceSpec;
use crate::suite::model::Scene;
use crate::suite::yaml::Diagnostic;

/// Refuses conditions that the bar does not know, if the suite asks for one.
pub(crate) fn refuse_conditions_unknown_to_fem(
    evaluator: &Evaluator<'_>,
    spec: &ConvergenceSpec,
    scene: &Scene,
) -> Result<(), Diagnostic> {
    if !spec.has_fem_reference() && spec.fem_method().is_none() {
        return Ok(());
    }
    let path = Path::top("scene");
    let help = "remove the FEM, also as `reference`, or the condition";
    for face in &scene.faces {
        if face.hold.is_lacked_by_fem() {
            let message = format!(
                "the {} face {}, and the FEM knows fixed and free ends only",
                face.name,
                face.hold.verb()
            );
            let at = path.then("boundary").then(face.name);
            return Err(evaluator.diagnostic(&at, &message).with_help(help));
        }
    }
    if !scene.initial_stress.is_none() {
        let at = path.then("initial_stress");
        let message = "an initial stress, which the FEM does not have";
        return Err(evaluator.diagnostic_at_key(&at, message).with_help(help));
    }
    if let Some(set) = scene.driven_set() {
        let message = format!("the set `{set}` is driven, which the FEM cannot do");
        let at = path.then("sets").then(set);
        return Err(evaluator.diagnostic_at_key(&at, &message).with_help(help));
    }
    Ok(())
}
