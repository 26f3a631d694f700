//! The loads that a scene lists, together.

use super::{LoadEntry, LoadSpec, StudyFacts};
use crate::suite::compile::evaluator::Evaluator;
use crate::suite::compile::path::Path;
use crate::suite::grammar::ConvergenceSpec;
use crate::suite::model::Scene;
use crate::suite::model::load::{EffectName, ListedLoad};
use crate::suite::yaml::Diagnostic;

/// Refuses effects without those that they need.
pub(crate) fn refuse_incomplete(
    evaluator: &Evaluator<'_>,
    loads: &[LoadSpec],
) -> Result<(), Diagnostic> {
    let listed: Vec<EffectName> = loads.iter().map(LoadSpec::effect).collect();
    EffectName::combine(&listed).map_err(|(effect, message)| {
        let at = listed.iter().position(|listed| *listed == effect).unwrap_or(0);
        evaluator.diagnostic_at_key(&loads[at].path(at), &message)
    })
}

/// Adds the loads to a scene that has none, in the order in which solvers apply them.
pub(crate) fn add(
    evaluator: &Evaluator<'_>,
    words: &[LoadSpec],
    scene: &mut Scene,
) -> Result<(), Diagnostic> {
    for (i, load) in words.iter().enumerate() {
        let effect = load.effect();
        let entry = LoadEntry { evaluator, effect, path: load.path(i), scene };
        let load = load.words().compile(&entry)?;
        scene.loads.push(ListedLoad { effect, load });
    }
    scene.loads.sort_by_key(|load| (load.target(), load.effect));
    Ok(())
}

/// Refuses what the loads of the scene do not go with, and the FEM where it lacks one.
pub(crate) fn refuse_foreign(
    evaluator: &Evaluator<'_>,
    spec: &ConvergenceSpec,
    loads: &[LoadSpec],
    scene: &Scene,
    until: f64,
) -> Result<(), Diagnostic> {
    let study = StudyFacts { manufactured: spec.manufactured.is_some(), until };
    for (i, load) in loads.iter().enumerate() {
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
