//! The loads that a scene lists, together.

use super::{LoadEntry, LoadSpec};
use crate::suite::evaluator::Evaluator;
use crate::suite::model::Scene;
use crate::suite::model::load::{EffectName, ListedLoad};
use crate::suite::yaml::Diagnostic;

/// Refuses effects without those that they need.
fn refuse_incomplete(evaluator: &Evaluator<'_>, loads: &[LoadSpec]) -> Result<(), Diagnostic> {
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
    refuse_incomplete(evaluator, words)?;
    for (i, load) in words.iter().enumerate() {
        let effect = load.effect();
        let entry = LoadEntry { evaluator, effect, path: load.path(i), scene };
        let load = load.words().compile(&entry)?;
        scene.loads.push(ListedLoad { effect, load });
    }
    scene.loads.sort_by_key(|load| (load.target(), load.effect));
    Ok(())
}
