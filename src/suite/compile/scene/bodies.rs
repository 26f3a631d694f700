//! Scenes with several bodies.
//!
//! A scene has either one `body` with its `material`, or a list of `bodies`. The grid, the walls
//! and the loads belong to the scene and act on every body.

use crate::mpm::MaterialSpec;
use crate::suite::evaluator::{Evaluator, shown};
use crate::suite::grammar::{BodySpec, OneBodySpec, SceneSpec, StressSpec};
use crate::suite::yaml::{Diagnostic, NumberText, Path};

const MOST: usize = 100;

pub(crate) struct Listed<'w> {
    /// Path of the map that contains these keys.
    pub(crate) at: Path,
    pub(crate) body: &'w BodySpec,
    pub(crate) material: &'w MaterialSpec<NumberText>,
    pub(crate) initial_stress: Option<&'w StressSpec>,
    pub(crate) initial_displacement: Option<&'w Vec<NumberText>>,
    pub(crate) initial_velocity: Option<&'w Vec<NumberText>>,
}

pub(crate) fn listed<'w>(
    evaluator: &Evaluator<'_>,
    path: &Path,
    spec: &'w SceneSpec,
) -> Result<Vec<Listed<'w>>, Diagnostic> {
    if let Some(bodies) = &spec.bodies {
        refuse_beside(evaluator, path, spec)?;
        let at = path.then("bodies");
        if bodies.is_empty() || bodies.len() > MOST {
            let diagnostic =
                evaluator.diagnostic(&at, &format!("the scene has {} bodies", bodies.len()));
            return Err(diagnostic.with_label(&format!("expected 1 to {MOST}")));
        }
        let one = |(i, one): (usize, &'w OneBodySpec)| {
            let OneBodySpec { body, material, initial_stress, .. } = one;
            Listed {
                at: at.then(i),
                body,
                material,
                initial_stress: initial_stress.as_ref(),
                initial_displacement: one.initial_displacement.as_ref(),
                initial_velocity: one.initial_velocity.as_ref(),
            }
        };
        return Ok(bodies.iter().enumerate().map(one).collect());
    }
    let missing = |key: &str| {
        let diagnostic = evaluator.diagnostic_at_key(path, &format!("the scene has no `{key}`"));
        diagnostic.with_help("add `body` and `material`, or a list of `bodies` with one of each")
    };
    Ok(vec![Listed {
        at: path.clone(),
        body: spec.body.as_ref().ok_or_else(|| missing("body"))?,
        material: spec.material.as_ref().ok_or_else(|| missing("material"))?,
        initial_stress: spec.initial_stress.as_ref(),
        initial_displacement: spec.initial_displacement.as_ref(),
        initial_velocity: spec.initial_velocity.as_ref(),
    }])
}

/// Refuses keys of a single body next to a list of bodies.
fn refuse_beside(
    evaluator: &Evaluator<'_>,
    path: &Path,
    spec: &SceneSpec,
) -> Result<(), Diagnostic> {
    let alone = [
        ("body", spec.body.is_some()),
        ("material", spec.material.is_some()),
        ("initial_velocity", spec.initial_velocity.is_some()),
        ("initial_stress", spec.initial_stress.is_some()),
        ("initial_displacement", spec.initial_displacement.is_some()),
        ("sets", !spec.sets.as_slice().is_empty()),
    ];
    if let Some((key, _)) = alone.iter().find(|(_, stated)| *stated) {
        let message = format!("`{key}` is for a single body, but the scene lists `bodies`");
        return Err(evaluator.diagnostic_at_key(&path.then(*key), &message));
    }
    for (i, load) in spec.loads.iter().enumerate() {
        let name = load.effect().name();
        let acts = match load.keys().face() {
            Some(_) => "acts on a face of a single body",
            None if load.keys().is_of_one_body() => "is supported for a single body only",
            None => continue,
        };
        let message = format!("`{name}` {acts}, but the scene lists `bodies`");
        return Err(evaluator.diagnostic_at_key(&load.path(i), &message));
    }
    Ok(())
}

pub(crate) fn contact(
    evaluator: &Evaluator<'_>,
    path: &Path,
    spec: &SceneSpec,
) -> Result<Option<f64>, Diagnostic> {
    let Some(contact) = &spec.contact else { return Ok(None) };
    let path = path.then("contact").then("friction");
    let coefficient = evaluator.number(&path, &contact.friction)?;
    if coefficient >= 0.0 {
        return Ok(Some(coefficient));
    }
    let message = format!("the coefficient of friction is {}", shown(coefficient));
    Err(evaluator.diagnostic(&path, &message).with_label("expected zero or a positive number"))
}
