//! Checks exact solutions of several bodies, and the conditions on their common faces.
//!
//! Neighbouring bodies are boxes in a row along an axis. The high face of a box and the low face of
//! the next box have the same extent; there may be a gap between them. Conditions between faces of
//! different extent, or on round rims, are not implemented.

use crate::exact::{Interface, Problem, Survey, Violation, meets};
use crate::suite::evaluator::{Evaluator, SuitePath};
use crate::suite::grammar::ConvergenceSpec;
use crate::suite::model::Scene;
use crate::suite::yaml::Diagnostic;
use std::sync::Arc;

const CONTACT: &str = "bodies without `contact` share one velocity field and stick together: if \
                       they can separate or slide, add `contact: {friction: 0}` to `scene`";

pub(crate) fn refuse(evaluator: &Evaluator<'_>, spec: &ConvergenceSpec) -> Result<(), Diagnostic> {
    let of_one = [
        (spec.manufactured.is_some(), "manufactured", "manufactured"),
        (spec.equilibrium.is_some(), "equilibrium", "equilibrium"),
        (spec.has_fem_reference(), "reference", "reference"),
    ];
    evaluator.refuse_first(&of_one, |path, key| {
        let message = format!("`{key}` is for a single body, but the scene lists `bodies`");
        let help = "state a solution under `exact`, or bound the drift of conserved sums";
        path.diagnostic_at_key(&message).with_help(help)
    })
}

/// Checks the `problems` of all bodies with `check`, and the conditions on their common faces.
pub(crate) fn refuse_violated_conditions(
    evaluator: &Evaluator<'_>,
    scene: &Scene,
    mut problems: Vec<Problem>,
    check: impl Fn(&Problem, &Survey) -> Result<(), Diagnostic>,
    diagnostic: impl Fn(Violation) -> Diagnostic,
) -> Result<(), Diagnostic> {
    let at = evaluator.top("scene.bodies");
    if let Some(i) = problems.iter().position(|problem| problem.outline.is_some()) {
        let message = "an exact solution of several bodies can be checked only for boxes";
        return Err(at.then(i).then("body").diagnostic_at_key(message));
    }
    let pairs = pairs(&problems);
    for &(i, k, axis) in &pairs {
        let apart = problems[i].to[axis] != problems[k].from[axis];
        if apart && scene.contact.is_none() {
            let message = "the exact solution of bodies with a gap and one velocity field depends \
                           on the cell size";
            return at.then(k).then("body").refuse_key(message, CONTACT);
        }
        problems[i].faces[2 * axis + 1].condition = Arc::new(Interface);
        problems[k].faces[2 * axis].condition = Arc::new(Interface);
    }
    refuse_other_touch(&at, &problems, &pairs)?;
    let surveys = Survey::of_each(&problems);
    problems.iter().zip(&surveys).try_for_each(|(problem, survey)| check(problem, survey))?;
    for (i, k, axis) in pairs {
        let largest = &surveys[i].largest;
        meets(&problems[i], &problems[k], axis, scene.contact, largest).map_err(|violation| {
            let diagnostic = diagnostic(violation);
            match (scene.contact, diagnostic.help()) {
                (None, Some(help)) => {
                    let help = format!("{help}; {CONTACT}");
                    diagnostic.with_help(&help)
                }
                _ => diagnostic,
            }
        })?;
    }
    Ok(())
}

/// Returns the pairs of neighbouring bodies: the indices of both bodies, and the axis.
fn pairs(problems: &[Problem]) -> Vec<(usize, usize, usize)> {
    let mut pairs = Vec::new();
    let d = problems.first().map_or(0, Problem::dimension);
    for axis in 0..d {
        let same = |a: &Problem, b: &Problem| {
            (0..d).all(|i| i == axis || (a.from[i] == b.from[i] && a.to[i] == b.to[i]))
        };
        for (i, one) in problems.iter().enumerate() {
            let after = problems
                .iter()
                .enumerate()
                .filter(|(_, other)| same(one, other) && other.from[axis] >= one.to[axis]);
            let next = after.min_by(|(_, a), (_, b)| a.from[axis].total_cmp(&b.from[axis]));
            pairs.extend(next.map(|(k, _)| (i, k, axis)));
        }
    }
    pairs
}

fn refuse_other_touch(
    at: &SuitePath<'_>,
    problems: &[Problem],
    pairs: &[(usize, usize, usize)],
) -> Result<(), Diagnostic> {
    for (i, one) in problems.iter().enumerate() {
        for (k, other) in problems.iter().enumerate() {
            let known = pairs.iter().any(|(a, b, _)| (*a, *b) == (i, k) || (*a, *b) == (k, i));
            let touch = (0..one.dimension())
                .all(|axis| one.from[axis] <= other.to[axis] && other.from[axis] <= one.to[axis]);
            if i < k && touch && !known {
                let message = "an exact solution can be checked only for boxes that share a whole \
                               face";
                return Err(at.then(k).then("body").diagnostic_at_key(message));
            }
        }
    }
    Ok(())
}
