//! The scene as a whole: its bodies, and how they lie to each other and on the grid.

use super::{bodies, body, outline, sets};
use crate::suite::compile::evaluator::Evaluator;
use crate::suite::compile::path::Path;
use crate::suite::compile::scene::scene_words::SceneWords;
use crate::suite::model::Scene;
use crate::suite::yaml::Diagnostic;

/// Checks the scene of a suite.
pub(crate) fn scene(
    evaluator: &Evaluator<'_>,
    words: &SceneWords<'_>,
) -> Result<Scene, Diagnostic> {
    let path = Path::top("scene");
    let listed = bodies::listed(evaluator, &path, words)?;
    let contact = bodies::contact(evaluator, &path, words)?;
    let each = listed.iter().map(|listed| body::body(evaluator, listed, words));
    let each = each.collect::<Result<Vec<Scene>, _>>()?;
    let scene = bodies::together(evaluator, &path, each, words.bodies.is_some(), contact)?;
    sets::refuse_idle(evaluator, &path, &scene)?;
    body::on_grid(evaluator, &path, &scene)?;
    let with_rims = scene.each().iter().filter(|body| body.mapped.is_none());
    for outline in with_rims.filter_map(|body| body.outline.as_deref()) {
        outline::fits(evaluator, &path, outline, scene.grid.as_ref())?;
    }
    Ok(scene)
}
