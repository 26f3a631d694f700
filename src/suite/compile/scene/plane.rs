//! State of a two-dimensional body across its plane, from words.

use crate::mpm::MaterialPlan;
use crate::subject::PlaneState;
use crate::suite::evaluator::Evaluator;
use crate::suite::grammar::SceneSpec;
use crate::suite::yaml::{Diagnostic, Path};

/// The state that the scene states, plane strain unless it does.
pub(crate) fn plane(
    evaluator: &Evaluator<'_>,
    path: &Path,
    words: &SceneSpec,
    dimension: usize,
) -> Result<PlaneState, Diagnostic> {
    let Some(plane) = words.plane else { return Ok(PlaneState::Strain) };
    if dimension != 2 {
        let message = format!("a plane, and the scene is {dimension}-D");
        return Err(evaluator
            .diagnostic(&path.then("plane"), &message)
            .with_label("expected in a scene of `dimension: 2`"));
    }
    if plane == PlaneState::Axisymmetric && words.bodies.is_some() {
        let message = "`plane: axisymmetric`, and several bodies are not known to be of revolution";
        return Err(evaluator.diagnostic_at_key(&path.then("bodies"), message));
    }
    for (i, load) in words.loads.iter().enumerate() {
        if let Some(reason) = load.words().against_plane(plane) {
            let message = format!("`plane: {}`, and {reason}", plane.name());
            return Err(evaluator.diagnostic_at_key(&load.path(i), &message));
        }
    }
    Ok(plane)
}

/// Refuses a material whose law is not known in the state across the plane; `path` is that of the
/// material.
pub(crate) fn knows(
    evaluator: &Evaluator<'_>,
    path: &Path,
    material: &MaterialPlan,
    plane: PlaneState,
) -> Result<(), Diagnostic> {
    if material.in_plane::<2>(plane).is_some() {
        return Ok(());
    }
    let name = material.name();
    let message = format!("the law `{name}` is not known in plane stress, where sigma_33 = 0");
    let diagnostic = evaluator.diagnostic_at_key(&path.then(name), &message);
    Err(diagnostic.with_help("take `linear_elastic`, `neo_hookean` or `hencky`"))
}
