//! Refusal of keys that exclude an equilibrium.
//!
//! A body that comes to rest under a load is compared with its equilibrium once it is there: at the
//! end of the run.

use crate::suite::evaluator::{COORDINATES, Evaluator};
use crate::suite::grammar::{ConvergenceSpec, ExactSpec, NormName};
use crate::suite::model::Scene;
use crate::suite::yaml::{Diagnostic, Path};

/// Refuses a suite whose `equilibrium` makes no sense beside what else it says.
pub(crate) fn refuse(
    evaluator: &Evaluator<'_>,
    spec: &ConvergenceSpec,
    state: &ExactSpec,
    scene: &Scene,
) -> Result<(), Diagnostic> {
    let path = Path::top("equilibrium");
    let others = [
        ("exact", spec.exact.is_some()),
        ("manufactured", spec.manufactured.is_some()),
        ("reference", spec.reference.is_some()),
    ];
    if let Some((other, _)) = others.iter().find(|(_, stated)| *stated) {
        let message = format!("`{other}` is a motion, and the suite states an equilibrium besides");
        return Err(evaluator.diagnostic_at_key(&Path::top(other), &message));
    }
    // Bound without t, for the complaint that there is no t.
    let d = scene.dimension();
    if let Some(texts) = &state.displacement {
        evaluator.vector(&path.then("displacement"), texts, d, &COORDINATES[..d])?;
    }
    if scene.heat().is_some() {
        let message = "a body in which heat flows is not at rest: state a motion under `exact`";
        return Err(evaluator.diagnostic_at_key(&path, message));
    }
    if spec.run.until.as_slice().len() > 1 {
        let at = Path::top("run").then("until").alternative(&spec.run.until, 1);
        let message = "a body comes to rest once, under the loads at the end of its run";
        return Err(evaluator.diagnostic(&at, message).with_label("expected one end"));
    }
    let over_time = [NormName::MaxRms, NormName::MaxL1, NormName::MaxL2, NormName::MaxLinf];
    if over_time.contains(&spec.judge.norm) {
        let message = "on its way a body is not in equilibrium";
        let diagnostic = evaluator.diagnostic(&Path::top("judge").then("norm"), message);
        return Err(diagnostic.with_label("expected a norm at the end: rms, l1, l2 or linf"));
    }
    refuse_driven(evaluator, scene)?;
    match spec.fem_method() {
        Some(i) => {
            let message = "the reference FEM has no damping and does not come to rest";
            Err(evaluator.diagnostic(&Path::top("methods").then(i), message))
        }
        None => Ok(()),
    }
}

/// Where a wall or a set has got to is not known from its velocity at the end.
fn refuse_driven(evaluator: &Evaluator<'_>, scene: &Scene) -> Result<(), Diagnostic> {
    let scene_path = Path::top("scene");
    if let Some(face) = scene.faces.iter().find(|face| face.hold.is_driven()) {
        let message = format!("the face `{}` is driven, and the body comes to rest", face.name);
        return Err(
            evaluator.diagnostic_at_key(&scene_path.then("boundary").then(face.name), &message)
        );
    }
    if let Some(set) = scene.driven_set() {
        let message = format!("the set `{set}` is driven, and the body comes to rest");
        let at = scene_path.then("sets").then(set);
        return Err(evaluator.diagnostic_at_key(&at, &message));
    }
    Ok(())
}
