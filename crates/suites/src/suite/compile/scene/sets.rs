//! Compiles particle sets.

use super::outline::{self, Shape};
use crate::exact::{Outline, Region};
use crate::suite::evaluator::{SuitePath, shown};
use crate::suite::grammar::{SceneSpec, SetSpec};
use crate::suite::scene::load::LoadTarget;
use crate::suite::scene::{Scene, face::FACES};
use crate::suite::yaml::Diagnostic;

/// A set counts as empty if at most this share of its volume is in the body.
const SLIVER: f64 = 1e-12;

pub(crate) fn declared(
    path: &SuitePath<'_>,
    spec: &SceneSpec,
    shape: &Shape,
) -> Result<Vec<Region>, Diagnostic> {
    let declare = |(name, SetSpec::Box(spec)): &(String, SetSpec)| {
        let at = path.then("sets").then(name.as_str());
        refuse_face_name(&at, name)?;
        let at = at.then("box");
        let (from, to) = outline::corners(&at, spec, shape.from.len())?;
        let set = Region { name: name.clone(), from, to };
        refuse_outside(&at, &set, &shape.from, &shape.to)?;
        if let Some(outline) = shape.outline.as_deref() {
            refuse_beside(&at, &set, outline)?;
        }
        Ok(set)
    };
    spec.sets.as_slice().iter().map(declare).collect()
}

fn refuse_face_name(path: &SuitePath<'_>, name: &str) -> Result<(), Diagnostic> {
    if !FACES.contains(&name) {
        return Ok(());
    }
    path.refuse_key(&format!("`{name}` is the name of a face"), "give the set another name")
}

fn refuse_outside(
    path: &SuitePath<'_>,
    set: &Region,
    from: &[f64],
    to: &[f64],
) -> Result<(), Diagnostic> {
    for axis in 0..from.len() {
        if !(set.from[axis] < to[axis] && set.to[axis] > from[axis]) {
            let (low, high) = (shown(set.from[axis]), shown(set.to[axis]));
            let message =
                format!("the set `{}` from {low} to {high} is outside the body", set.name);
            let (from, to) = (shown(from[axis]), shown(to[axis]));
            let label = format!("the body is from {from} to {to}");
            let diagnostic = path.then("from").then(axis).diagnostic(&message);
            return Err(diagnostic.with_label(&label));
        }
    }
    Ok(())
}

fn refuse_beside(
    path: &SuitePath<'_>,
    set: &Region,
    outline: &dyn Outline,
) -> Result<(), Diagnostic> {
    let ends = outline.ends();
    let (from, to) = set.within(&ends.0, &ends.1);
    let size: f64 = from.iter().zip(&to).map(|(from, to)| to - from).product();
    if outline.volume_within(&from, &to) > SLIVER * size {
        return Ok(());
    }
    let message = format!("the set `{}` contains no part of the {}", set.name, outline.kind());
    let label = format!("the body is a {}", outline.row());
    Err(path.then("from").diagnostic(&message).with_label(&label))
}

pub(crate) fn refuse_idle(path: &SuitePath<'_>, scene: &Scene) -> Result<(), Diagnostic> {
    let idle = |i: &usize| scene.loads_on(LoadTarget::Set(*i)).next().is_none();
    let Some(i) = (0..scene.sets.len()).find(idle) else { return Ok(()) };
    let name = &scene.sets[i].name;
    let path = path.then("sets").then(name.as_str());
    let diagnostic = path.diagnostic_at_key(&format!("the set `{name}` is never used"));
    Err(diagnostic.with_help("remove it, or let a load act on it"))
}
