//! Boundary conditions of the faces, from `boundary`.

use crate::suite::evaluator::Evaluator;
use crate::suite::grammar::SceneSpec;
use crate::suite::model::SceneFace;
use crate::suite::scene::boundary::{BoundaryCondition, FaceEntry, FreeFace};
use crate::suite::scene::face::{FACES, face};
use crate::suite::yaml::{Diagnostic, Path};
use std::sync::Arc;

/// The faces of a body that has a box or four sides, in their order.
pub(crate) fn faces(
    evaluator: &Evaluator<'_>,
    path: &Path,
    words: &SceneSpec,
    dimension: usize,
) -> Result<Vec<SceneFace>, Diagnostic> {
    let holds = holds(evaluator, path, words, dimension)?;
    let build = |(i, hold)| SceneFace { name: FACES[i], axis: i / 2, high: i % 2 == 1, hold };
    Ok(holds.into_iter().enumerate().map(build).collect())
}

/// Boundary conditions of the faces, in their order.
fn holds(
    evaluator: &Evaluator<'_>,
    path: &Path,
    words: &SceneSpec,
    dimension: usize,
) -> Result<Vec<Arc<dyn BoundaryCondition>>, Diagnostic> {
    let path = path.then("boundary");
    let free: Arc<dyn BoundaryCondition> = Arc::new(FreeFace);
    let mut holds = vec![free; 2 * dimension];
    for (name, words) in words.boundary.as_slice() {
        let at = path.then(name.as_str());
        let face = face(evaluator, &at, name, dimension, true)?;
        let (condition, words) = words.named();
        let entry = FaceEntry { evaluator, path: at.then(condition), dimension };
        holds[face] = words.compile(&entry)?;
    }
    both_ends(evaluator, &path, &holds)?;
    Ok(holds)
}

/// A face can only be periodic together with the opposite one.
fn both_ends(
    evaluator: &Evaluator<'_>,
    path: &Path,
    holds: &[Arc<dyn BoundaryCondition>],
) -> Result<(), Diagnostic> {
    for (i, hold) in holds.iter().enumerate() {
        let (name, other) = (FACES[i], FACES[i ^ 1]);
        if hold.is_periodic() && !holds[i ^ 1].is_periodic() {
            let verb = holds[i ^ 1].verb();
            let message = format!("the {name} face is periodic, and the {other} face {verb}");
            let diagnostic = evaluator.diagnostic(&path.then(name), &message);
            return Err(diagnostic.with_label(&format!("expected `{other}: periodic` as well")));
        }
    }
    Ok(())
}
