//! Loads that a study or the reference FEM does not go with, refused before anything runs.

use crate::suite::evaluator::Evaluator;
use crate::suite::grammar::ConvergenceSpec;
use crate::suite::model::Scene;
use crate::suite::scene::load::{LoadEntry, StudyFacts};
use crate::suite::yaml::{Diagnostic, Path};

/// Refuses what the loads of the scene do not go with, and the FEM where it lacks one.
pub(crate) fn refuse_foreign(
    evaluator: &Evaluator<'_>,
    spec: &ConvergenceSpec,
    scene: &Scene,
    until: f64,
) -> Result<(), Diagnostic> {
    let study = StudyFacts { manufactured: spec.manufactured.is_some(), until };
    for (i, load) in spec.scene.loads.iter().enumerate() {
        let entry = LoadEntry { evaluator, effect: load.effect(), path: load.path(i), scene };
        load.words().check(&entry, &study)?;
        if let Some(lacked) = load.words().lacked_by_fem() {
            refuse_fem_without(evaluator, spec, lacked)?;
        }
    }
    Ok(())
}

/// Refuses the reference FEM, as method or as reference, for a scene with an effect that it lacks.
fn refuse_fem_without(
    evaluator: &Evaluator<'_>,
    spec: &ConvergenceSpec,
    effect: &str,
) -> Result<(), Diagnostic> {
    let message = format!("the reference FEM has no {effect}, and the scene has");
    if spec.has_fem_reference() {
        return Err(evaluator.diagnostic_at_key(&Path::top("reference"), &message));
    }
    match spec.fem_method() {
        Some(i) => Err(evaluator.diagnostic(&Path::top("methods").then(i), &message)),
        None => Ok(()),
    }
}
