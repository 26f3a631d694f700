//! Several bodies in a scene, from words.
//!
//! A scene has one `body` with its `material`, or a list of `bodies`. The grid, its walls and the
//! loads are those of the scene: they act on every body.

use crate::exact::Polygon;
use crate::mpm::MaterialSpec;
use crate::suite::compile::boundary::FreeFace;
use crate::suite::compile::evaluator::Evaluator;
use crate::suite::compile::path::Path;
use crate::suite::compile::scene::scene_words::SceneWords;
use crate::suite::compile::wording::shown;
use crate::suite::grammar::{BodySpec, OneBodySpec, SceneSpec, StressSpec};
use crate::suite::model::Scene;
use crate::suite::yaml::{Diagnostic, NumberText};
use std::sync::Arc;

/// Most bodies of a scene.
const MOST: usize = 100;

/// The words of one body, and where they stand.
pub(crate) struct Listed<'w> {
    /// The map that holds them.
    pub(crate) at: Path,
    pub(crate) body: &'w BodySpec,
    pub(crate) material: &'w MaterialSpec<NumberText>,
    pub(crate) initial_stress: Option<&'w StressSpec>,
    pub(crate) initial_displacement: Option<&'w Vec<NumberText>>,
    pub(crate) initial_velocity: Option<&'w Vec<NumberText>>,
}

/// The bodies that a scene lists: one or several.
pub(crate) fn listed<'w>(
    evaluator: &Evaluator<'_>,
    path: &Path,
    words: &'w SceneWords<'_>,
) -> Result<Vec<Listed<'w>>, Diagnostic> {
    if let Some(bodies) = &words.bodies {
        refuse_beside(evaluator, path, words)?;
        let at = path.then("bodies");
        if bodies.is_empty() || bodies.len() > MOST {
            let diagnostic =
                evaluator.diagnostic(&at, &format!("a scene of {} bodies", bodies.len()));
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
        let diagnostic = evaluator.diagnostic_at_key(path, &format!("a scene without `{key}`"));
        diagnostic.with_help("add `body` and `material`, or a list of `bodies` with one of each")
    };
    Ok(vec![Listed {
        at: path.clone(),
        body: words.body.as_ref().ok_or_else(|| missing("body"))?,
        material: words.material.as_ref().ok_or_else(|| missing("material"))?,
        initial_stress: words.initial_stress.as_ref(),
        initial_displacement: words.initial_displacement.as_ref(),
        initial_velocity: words.initial_velocity.as_ref(),
    }])
}

/// Refuses words that speak of one body beside a list of bodies.
fn refuse_beside(
    evaluator: &Evaluator<'_>,
    path: &Path,
    words: &SceneWords<'_>,
) -> Result<(), Diagnostic> {
    let alone = [
        ("body", words.body.is_some()),
        ("material", words.material.is_some()),
        ("initial_velocity", words.initial_velocity.is_some()),
        ("initial_stress", words.initial_stress.is_some()),
        ("initial_displacement", words.initial_displacement.is_some()),
        ("sets", !words.sets.as_slice().is_empty()),
    ];
    if let Some((key, _)) = alone.iter().find(|(_, stated)| *stated) {
        let message = format!("`{key}` speaks of one body, and the scene has several");
        return Err(evaluator.diagnostic_at_key(&path.then(*key), &message));
    }
    for (i, load) in words.loads.iter().enumerate() {
        let name = load.effect().name();
        let acts = match load.words().face() {
            Some(_) => "acts on a face of",
            None if load.words().is_of_one_body() => "is that of",
            None => continue,
        };
        let message = format!("`{name}` {acts} one body, and the scene has several");
        return Err(evaluator.diagnostic_at_key(&load.path(i), &message));
    }
    Ok(())
}

/// The coefficient of friction between bodies, if they have contact.
pub(crate) fn contact(
    evaluator: &Evaluator<'_>,
    path: &Path,
    words: &SceneSpec,
) -> Result<Option<f64>, Diagnostic> {
    let Some(contact) = &words.contact else { return Ok(None) };
    let path = path.then("contact").then("friction");
    let coefficient = evaluator.number(&path, &contact.friction)?;
    if coefficient >= 0.0 {
        return Ok(Some(coefficient));
    }
    let message = format!("the coefficient of friction is {}", shown(coefficient));
    Err(evaluator.diagnostic(&path, &message).with_label("expected zero or a positive number"))
}

/// The scene of all `bodies`: the first one's, if they are not a list.
pub(crate) fn together(
    evaluator: &Evaluator<'_>,
    path: &Path,
    mut bodies: Vec<Scene>,
    several: bool,
    contact: Option<f64>,
) -> Result<Scene, Diagnostic> {
    let Some(first) = bodies.first() else {
        return Err(evaluator.diagnostic(path, "a scene without a body"));
    };
    let mut scene = Scene { contact, ..first.clone() };
    if !several {
        return Ok(scene);
    }
    (scene.outline, scene.mapped) = (None, None);
    for body in &bodies {
        for axis in 0..scene.from.len() {
            scene.from[axis] = scene.from[axis].min(body.from[axis]);
            scene.to[axis] = scene.to[axis].max(body.to[axis]);
        }
    }
    apart(evaluator, path, &bodies)?;
    let mut faces = scene.faces.iter();
    let against = faces.find_map(|face| Some((face.name, face.hold.against_several_bodies()?)));
    if let Some((name, why)) = against {
        return Err(evaluator.diagnostic_at_key(&path.then("boundary").then(name), why));
    }
    for body in &mut bodies {
        inner_faces_are_free(body, &scene);
    }
    scene.bodies = bodies;
    Ok(scene)
}

/// Walls hold the faces of a body that lie on those of the box around all bodies.
fn inner_faces_are_free(body: &mut Scene, scene: &Scene) {
    for face in &mut body.faces {
        let axis = face.axis;
        let at_wall = if face.high {
            body.to[axis] == scene.to[axis]
        } else {
            body.from[axis] == scene.from[axis]
        };
        if !at_wall {
            face.hold = Arc::new(FreeFace);
        }
    }
    if body.outline.is_some() && body.mapped.is_none() {
        body.faces.clear();
    }
}

/// No two bodies have a place in common.
fn apart(evaluator: &Evaluator<'_>, path: &Path, bodies: &[Scene]) -> Result<(), Diagnostic> {
    for (i, body) in bodies.iter().enumerate() {
        if let Some(k) = bodies[..i].iter().position(|other| overlap(body, other)) {
            let message = format!("body {} and body {} have places in common", k + 1, i + 1);
            let at = path.then("bodies").then(i).then("body");
            return Err(evaluator.diagnostic_at_key(&at, &message));
        }
    }
    Ok(())
}

/// Whether two bodies overlap; a ring counts as a disk.
fn overlap(one: &Scene, other: &Scene) -> bool {
    let boxes = (0..one.from.len())
        .all(|axis| one.from[axis] < other.to[axis] && other.from[axis] < one.to[axis]);
    let ball = |body: &'_ Scene| -> Option<(Vec<f64>, f64)> {
        let (centre, radius) = body.outline.as_ref()?.ball()?;
        Some((centre.to_vec(), radius))
    };
    boxes
        && match (ball(one), ball(other)) {
            (Some((centre, radius)), Some((other, other_radius))) => {
                let ends = centre.iter().zip(&other);
                ends.fold(0.0, |all, (a, b)| libm::hypot(all, b - a)) < radius + other_radius
            }
            (Some((centre, radius)), None) => distance(other, &centre) < radius,
            (None, Some((centre, radius))) => distance(one, &centre) < radius,
            (None, None) => match (polygon(one), polygon(other)) {
                (Some(one), Some(other)) => one.overlaps(&other),
                _ => true,
            },
        }
}

/// Distance (m) of a place from a body.
fn distance(body: &Scene, place: &[f64]) -> f64 {
    if let Some(outline) = &body.outline {
        return outline.distance(place);
    }
    let ends = body.from.iter().zip(&body.to).zip(place);
    ends.fold(0.0, |all, ((from, to), x)| libm::hypot(all, x.clamp(*from, *to) - x))
}

/// A body in the plane with straight sides.
fn polygon(body: &Scene) -> Option<Polygon> {
    let ([left, bottom], [right, top]) = (&body.from[..], &body.to[..]) else { return None };
    let corners = match &body.outline {
        Some(outline) => outline.trace().into_iter().map(<[f64; 2]>::from).collect(),
        None => vec![[*left, *bottom], [*right, *bottom], [*right, *top], [*left, *top]],
    };
    Polygon::new("polygon", &corners).ok()
}
