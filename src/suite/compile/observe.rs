//! The place that `observe` watches.

use crate::suite::evaluator::{Evaluator, shown};
use crate::suite::grammar::ObserveSpec;
use crate::suite::model::Scene;
use crate::suite::yaml::{Diagnostic, Path};

/// The place that is watched: one in the body.
pub(super) fn observed(
    evaluator: &Evaluator<'_>,
    spec: &ObserveSpec,
    scene: &Scene,
) -> Result<Vec<f64>, Diagnostic> {
    let path = Path::top("observe").then("at");
    let place = evaluator.point(&path, &spec.at, scene.dimension())?;
    for (axis, x) in place.iter().enumerate() {
        let (from, to) = (scene.from[axis], scene.to[axis]);
        if !(from..=to).contains(x) {
            let message = format!("{} is outside the body", shown(*x));
            let label = format!("expected a number from {} to {}", shown(from), shown(to));
            return Err(evaluator.diagnostic(&path.then(axis), &message).with_label(&label));
        }
    }
    let outside = scene.outline.as_ref().filter(|outline| !outline.holds(&place));
    if let Some(kind) = outside.map(|outline| outline.kind()) {
        let diagnostic = evaluator.diagnostic(&path, "this place is outside the body");
        return Err(diagnostic.with_label(&format!("expected a place in the {kind}")));
    }
    Ok(place)
}
