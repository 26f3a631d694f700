//! Boundary conditions of the faces, from `boundary`.

use crate::suite::compile::evaluator::Evaluator;
use crate::suite::compile::path::Path;
use crate::suite::compile::scene::face::face;
use crate::suite::compile::wording::shown;
use crate::suite::grammar::{BoundarySpec, SceneSpec};
use crate::suite::model::BoundaryCondition;
use crate::suite::model::scene::FACES;
use crate::suite::yaml::{Diagnostic, NumberText};

/// Boundary conditions of the faces, in their order; `variables` are the coordinates and t.
pub(crate) fn holds(
    evaluator: &Evaluator<'_>,
    path: &Path,
    words: &SceneSpec,
    variables: &[&str],
) -> Result<Vec<BoundaryCondition>, Diagnostic> {
    let dimension = variables.len() - 1;
    let path = path.then("boundary");
    let mut holds = vec![BoundaryCondition::Free; 2 * dimension];
    for (name, words) in words.boundary.as_slice() {
        let at = path.then(name.as_str());
        let face = face(evaluator, &at, name, dimension, true)?;
        holds[face] = match words {
            BoundarySpec::Fixed => BoundaryCondition::Fixed,
            BoundarySpec::Roller => BoundaryCondition::Roller,
            BoundarySpec::Friction(text) => friction(evaluator, &at.then("friction"), text)?,
            BoundarySpec::Periodic => BoundaryCondition::Periodic,
            BoundarySpec::Velocity(texts) => {
                let at = at.then("velocity");
                BoundaryCondition::Velocity(evaluator.vector(&at, texts, dimension, variables)?)
            }
        };
    }
    both_ends(evaluator, &path, &holds)?;
    Ok(holds)
}

fn friction(
    evaluator: &Evaluator<'_>,
    path: &Path,
    text: &NumberText,
) -> Result<BoundaryCondition, Diagnostic> {
    let coefficient = evaluator.number(path, text)?;
    if coefficient >= 0.0 {
        return Ok(BoundaryCondition::Friction(coefficient));
    }
    let message = format!("the coefficient of friction is {}", shown(coefficient));
    Err(evaluator.diagnostic(path, &message).with_label("expected zero or a positive number"))
}

/// A face can only be periodic together with the opposite one.
fn both_ends(
    evaluator: &Evaluator<'_>,
    path: &Path,
    holds: &[BoundaryCondition],
) -> Result<(), Diagnostic> {
    for (i, hold) in holds.iter().enumerate() {
        let (name, other) = (FACES[i], FACES[i ^ 1]);
        if matches!(hold, BoundaryCondition::Periodic)
            && !matches!(holds[i ^ 1], BoundaryCondition::Periodic)
        {
            let verb = holds[i ^ 1].verb();
            let message = format!("the {name} face is periodic, and the {other} face {verb}");
            let diagnostic = evaluator.diagnostic(&path.then(name), &message);
            return Err(diagnostic.with_label(&format!("expected `{other}: periodic` as well")));
        }
    }
    Ok(())
}
