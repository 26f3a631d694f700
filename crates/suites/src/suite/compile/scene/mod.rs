//! Compiles the scene: its bodies, and their positions relative to each other and the grid.
//!
//! A scene has either one `body` with its `material`, or a list of `bodies`. The grid, the walls
//! and the loads belong to the scene and act on every body.

mod body;
mod material;
pub(crate) mod outline;
mod sets;

use crate::exact::Polygon;
use crate::suite::evaluator::{Evaluator, SuitePath, shown};
use crate::suite::grammar::{OneBodySpec, SceneSpec};
use crate::suite::model::{Scene, SceneFace};
use crate::suite::scene::boundary::FreeFace;
use crate::suite::yaml::Diagnostic;
use std::sync::Arc;

const MOST: usize = 100;

pub(crate) fn scene(evaluator: &Evaluator<'_>, spec: &SceneSpec) -> Result<Scene, Diagnostic> {
    let path = evaluator.top("scene");
    let bodies = listed(&path, spec)?;
    let contact = contact(&path, spec)?;
    let each = bodies.iter().map(|(at, own)| body::body(at, own, spec));
    let each = each.collect::<Result<Vec<Scene>, _>>()?;
    let scene = together(&path, each, spec.bodies.is_some(), contact)?;
    sets::refuse_idle(&path, &scene)?;
    on_grid(&path, &scene)?;
    let with_rims = scene.each().iter().filter(|body| body.mapped.is_none());
    for outline in with_rims.filter_map(|body| body.outline.as_deref()) {
        outline::fits(&path, outline, scene.grid.as_ref())?;
    }
    Ok(scene)
}

fn listed<'a>(
    path: &SuitePath<'a>,
    spec: &SceneSpec,
) -> Result<Vec<(SuitePath<'a>, OneBodySpec)>, Diagnostic> {
    if let Some(bodies) = &spec.bodies {
        refuse_beside(path, spec)?;
        let at = path.then("bodies");
        if bodies.is_empty() || bodies.len() > MOST {
            let diagnostic = at.diagnostic(&format!("the scene has {} bodies", bodies.len()));
            return Err(diagnostic.with_label(&format!("expected 1 to {MOST}")));
        }
        return Ok(bodies.iter().enumerate().map(|(i, own)| (at.then(i), own.clone())).collect());
    }
    let missing = |key: &str| {
        let diagnostic = path.diagnostic_at_key(&format!("the scene has no `{key}`"));
        diagnostic.with_help("add `body` and `material`, or a list of `bodies` with one of each")
    };
    let own = OneBodySpec {
        body: spec.body.clone().ok_or_else(|| missing("body"))?,
        material: spec.material.clone().ok_or_else(|| missing("material"))?,
        initial_stress: spec.initial_stress.clone(),
        initial_displacement: spec.initial_displacement.clone(),
        initial_velocity: spec.initial_velocity.clone(),
    };
    Ok(vec![(path.clone(), own)])
}

fn refuse_beside(path: &SuitePath<'_>, spec: &SceneSpec) -> Result<(), Diagnostic> {
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
        return Err(path.then(*key).diagnostic_at_key(&message));
    }
    for (i, load) in spec.loads.iter().enumerate() {
        let name = load.effect().name();
        let acts = match load.keys().face() {
            Some(_) => "acts on a face of a single body",
            None if load.keys().is_of_one_body() => "is supported for a single body only",
            None => continue,
        };
        let message = format!("`{name}` {acts}, but the scene lists `bodies`");
        return Err(load.path(path.evaluator, i).diagnostic_at_key(&message));
    }
    Ok(())
}

fn contact(path: &SuitePath<'_>, spec: &SceneSpec) -> Result<Option<f64>, Diagnostic> {
    let Some(contact) = &spec.contact else { return Ok(None) };
    let path = path.then("contact").then("friction");
    path.zero_or_positive(&contact.friction, "the coefficient of friction").map(Some)
}

/// Refuses a grid that does not contain the body or does not end at its fixed and periodic faces.
/// The period of a body that may start deformed is checked later.
fn on_grid(path: &SuitePath<'_>, scene: &Scene) -> Result<(), Diagnostic> {
    let Some((from, to)) = &scene.grid else { return Ok(()) };
    let deforms = scene.material.properties().depends_on_deformation_alone().is_ok();
    let given = |face: &&SceneFace| !(deforms && face.hold.is_periodic());
    for face in scene.faces.iter().filter(given) {
        let (body, grid, key) = if face.high {
            (scene.to[face.axis], to[face.axis], "to")
        } else {
            (scene.from[face.axis], from[face.axis], "from")
        };
        let outside = if face.high { grid < body } else { grid > body };
        let apart = !face.hold.is_free() && grid != body;
        if outside || apart {
            let name = face.name;
            let message = if outside {
                format!(
                    "the body's {name} face at {body} is outside the grid, which ends at {grid}"
                )
            } else {
                let verb = face.hold.kind().verb;
                format!("the {name} face at {body} {verb}, but the grid ends at {grid}")
            };
            let at = path.then("grid").then(key).then(face.axis);
            let beyond = if face.high { "at least" } else { "at most" };
            let label = if apart { "exactly" } else { beyond };
            let label = format!("expected {label} {}", shown(body));
            return Err(at.diagnostic(&message).with_label(&label));
        }
    }
    Ok(())
}

/// Combines all `bodies` into one scene. If `several` is false, returns the only body.
fn together(
    path: &SuitePath<'_>,
    mut bodies: Vec<Scene>,
    several: bool,
    contact: Option<f64>,
) -> Result<Scene, Diagnostic> {
    let Some(first) = bodies.first() else {
        return Err(path.diagnostic("the scene has no body"));
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
    apart(path, &bodies)?;
    let mut faces = scene.faces.iter();
    let against =
        faces.find_map(|face| Some((face.name, face.hold.kind().against_several_bodies?)));
    if let Some((name, why)) = against {
        return Err(path.then("boundary").then(name).diagnostic_at_key(why));
    }
    for body in &mut bodies {
        inner_faces_are_free(body, &scene);
    }
    scene.bodies = bodies;
    Ok(scene)
}

/// Frees faces inside the bounding box of all bodies, because walls exist only on the box.
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

fn apart(path: &SuitePath<'_>, bodies: &[Scene]) -> Result<(), Diagnostic> {
    for (i, body) in bodies.iter().enumerate() {
        if let Some(k) = bodies[..i].iter().position(|other| overlap(body, other)) {
            let message = format!("body {} and body {} overlap", k + 1, i + 1);
            let at = path.then("bodies").then(i).then("body");
            return Err(at.diagnostic_at_key(&message));
        }
    }
    Ok(())
}

/// Whether two bodies overlap; a ring is treated as a disk.
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

/// Returns the distance of a position from a body (m).
fn distance(body: &Scene, place: &[f64]) -> f64 {
    if let Some(outline) = &body.outline {
        return outline.distance(place);
    }
    let ends = body.from.iter().zip(&body.to).zip(place);
    ends.fold(0.0, |all, ((from, to), x)| libm::hypot(all, x.clamp(*from, *to) - x))
}

fn polygon(body: &Scene) -> Option<Polygon> {
    let ([left, bottom], [right, top]) = (&body.from[..], &body.to[..]) else { return None };
    let corners = match &body.outline {
        Some(outline) => outline.trace().into_iter().map(<[f64; 2]>::from).collect(),
        None => vec![[*left, *bottom], [*right, *bottom], [*right, *top], [*left, *top]],
    };
    Polygon::new("polygon", &corners).ok()
}
