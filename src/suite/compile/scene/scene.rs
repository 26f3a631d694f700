//! The body and what acts on it, from words.

use super::{
    bodies, bodies::Listed, body, body::Shape, boundary, boundary::FACES, material::material,
    quadrilateral::faces_are_sides, rest, sets,
};
use crate::{
    exact::{Region, formula::Formula},
    mpm::{EffectName, MaterialPlan, Placement},
    suite::{
        compile::{
            coordinates::coordinates_and_time,
            evaluator::Binder,
            load::{damping, expansion::expansion, heat::heat, surface, viscosity},
            path::Path,
            truth::law,
            wording::shown,
        },
        grammar::{LoadWords, SceneWords, SetWords},
        model::{Scene, SceneFace},
        yaml::{Complaint, NumberText},
    },
};

/// Checks the scene of a suite.
pub(crate) fn scene(binder: &Binder<'_>, words: &SceneWords) -> Result<Scene, Complaint> {
    let path = Path::top("scene");
    let listed = bodies::listed(binder, &path, words)?;
    let contact = bodies::contact(binder, &path, words)?;
    let each = listed.iter().map(|listed| body(binder, listed, words));
    let each = each.collect::<Result<Vec<Scene>, _>>()?;
    let scene = bodies::together(binder, &path, each, words.bodies.is_some(), contact)?;
    sets::refuse_idle(binder, &path, &scene.sets)?;
    body::on_grid(binder, &path, &scene)?;
    for round in scene.each().iter().filter_map(|body| body.round.as_ref()) {
        body::fits(binder, &path, round, scene.grid.as_ref())?;
    }
    Ok(scene)
}

/// One body, and what acts on it.
fn body(binder: &Binder<'_>, own: &Listed<'_>, words: &SceneWords) -> Result<Scene, Complaint> {
    let path = Path::top("scene");
    let dimension = dimension(binder, &path, &words.dimension)?;
    let at = own.at.then("body");
    let (mut round, mut quadrilateral) = (None, None);
    let (from, to) = match body::shape(binder, &at, own.body, dimension)? {
        Shape::Box(words) => body::corners(binder, &at.then("box"), words, dimension)?,
        Shape::Round(found) => {
            if words.bodies.is_none() {
                body::rims_are_free(binder, &path, words, &found)?;
            }
            round.insert(found).corners()
        }
        Shape::Quadrilateral(found) => {
            faces_are_sides(binder, &path, words, &found)?;
            quadrilateral.insert(found).ends()
        }
    };
    let grid = words
        .grid
        .as_ref()
        .map(|grid| body::corners(binder, &path.then("grid"), grid, dimension))
        .transpose()?;
    let sets = declared_sets(binder, &path, words, (&from, &to))?;
    let (material, density) = material(binder, &own.at.then("material"), own.material)?;
    let mut scene = Scene {
        from,
        to,
        grid,
        initial_displacement: initial_displacement(binder, &path, words, dimension, &material)?,
        material,
        density,
        faces: if round.is_some() && words.bodies.is_none() {
            Vec::new()
        } else {
            faces(binder, &path, words, dimension)?
        },
        round,
        quadrilateral,
        sets,
        gravity: None,
        body_force: None,
        damping: None,
        local_damping: None,
        viscosity: None,
        heat: None,
        expansion: None,
        initial_velocity: initial_velocity(binder, own, dimension)?,
        bodies: Vec::new(),
        contact: None,
    };
    combined(binder, &path.then("loads"), &words.loads)?;
    if scene.is_at_rest() {
        rest::settle(binder, &path, words, &mut scene.faces)?;
    }
    for (i, load) in words.loads.iter().enumerate() {
        add_load(binder, &path.then("loads").then(i), load, &mut scene)?;
    }
    Ok(scene)
}

fn dimension(binder: &Binder<'_>, path: &Path, text: &NumberText) -> Result<usize, Complaint> {
    let path = path.then("dimension");
    let dimension = binder.number(&path, text)?;
    match [1.0, 2.0, 3.0].iter().position(|d| *d == dimension) {
        Some(index) => Ok(index + 1),
        None => Err(binder
            .complain(&path, &format!("a scene of dimension {}", shown(dimension)))
            .with_label("expected 1, 2 or 3")),
    }
}

fn faces(
    binder: &Binder<'_>,
    path: &Path,
    words: &SceneWords,
    dimension: usize,
) -> Result<Vec<SceneFace>, Complaint> {
    let holds = boundary::holds(binder, path, words, &coordinates_and_time(dimension))?;
    let build = |(i, hold)| SceneFace {
        name: FACES[i],
        axis: i / 2,
        high: i % 2 == 1,
        hold,
        traction: None,
        pressure: None,
        placement: Placement::default(),
    };
    Ok(holds.into_iter().enumerate().map(build).collect())
}

/// The sets of particles, on which nothing acts yet.
fn declared_sets(
    binder: &Binder<'_>,
    path: &Path,
    words: &SceneWords,
    corners: (&[f64], &[f64]),
) -> Result<Vec<Region>, Complaint> {
    let declare = |(name, SetWords::Box(words)): &(String, SetWords)| {
        let at = path.then("sets").then(name.as_str());
        sets::refuse_face_name(binder, &at, name)?;
        let at = at.then("box");
        let (from, to) = body::corners(binder, &at, words, corners.0.len())?;
        let set = Region { name: name.clone(), from, to, force: None, velocity: None };
        sets::refuse_outside(binder, &at, &set, corners)?;
        Ok(set)
    };
    words.sets.as_slice().iter().map(declare).collect()
}

fn initial_displacement(
    binder: &Binder<'_>,
    path: &Path,
    words: &SceneWords,
    dimension: usize,
    material: &MaterialPlan,
) -> Result<Vec<Formula>, Complaint> {
    let path = path.then("initial_displacement");
    let Some(texts) = &words.initial_displacement else { return Ok(Vec::new()) };
    if law::manufactured(material).is_err() {
        let message = format!("a `{}` body cannot start deformed", material.name());
        let complaint = binder.complain_key(&path, &message);
        let help = "its stress is integrated from the start on; a `neo_hookean` one can";
        return Err(complaint.with_help(help));
    }
    binder.vector(&path, texts, dimension, &coordinates_and_time(dimension))
}

fn initial_velocity(
    binder: &Binder<'_>,
    own: &Listed<'_>,
    dimension: usize,
) -> Result<Vec<Formula>, Complaint> {
    let path = own.at.then("initial_velocity");
    let variables = coordinates_and_time(dimension);
    own.initial_velocity
        .map_or(Ok(Vec::new()), |texts| binder.vector(&path, texts, dimension, &variables))
}

/// Effects that need each other or exclude each other.
fn combined(binder: &Binder<'_>, path: &Path, loads: &[LoadWords]) -> Result<(), Complaint> {
    let listed: Vec<EffectName> = loads.iter().map(LoadWords::effect).collect();
    EffectName::combine(&listed).map_err(|(effect, message)| {
        let at = listed.iter().position(|listed| *listed == effect).unwrap_or(0);
        binder.complain_key(&path.then(at).then(effect.name()), &message)
    })
}

fn add_load(
    binder: &Binder<'_>,
    path: &Path,
    load: &LoadWords,
    scene: &mut Scene,
) -> Result<(), Complaint> {
    let d = scene.dimension();
    match load {
        LoadWords::Gravity(texts) => {
            let path = path.then("gravity");
            if scene.gravity.is_some() {
                return Err(binder.complain(&path, "gravity appears twice"));
            }
            scene.gravity = Some(binder.vector(&path, texts, d, &["t"])?);
        }
        LoadWords::Damping(text) => {
            let path = path.then("damping");
            if scene.damping.is_some() {
                return Err(binder.complain(&path, "damping appears twice"));
            }
            scene.damping = Some(binder.formula(&path, text, &["t"])?);
        }
        LoadWords::ArtificialViscosity(words) => {
            viscosity::add(binder, &path.then("artificial_viscosity"), words, scene)?;
        }
        LoadWords::LocalDamping(text) => {
            damping::add_local(binder, &path.then("local_damping"), text, scene)?;
        }
        LoadWords::BodyForce(texts) => {
            let path = path.then("body_force");
            if scene.body_force.is_some() {
                return Err(binder.complain(&path, "a body force appears twice"));
            }
            scene.body_force = Some(binder.vector(&path, texts, d, &coordinates_and_time(d))?);
        }
        LoadWords::Traction { .. } | LoadWords::Pressure { .. } => {
            surface::add(binder, path, load, &coordinates_and_time(d), scene)?;
        }
        LoadWords::Force { on, value } => {
            let path = path.then("force");
            let set = sets::free(binder, &path.then("on"), on, &mut scene.sets)?;
            set.force = Some(binder.vector(&path.then("value"), value, d, &["t"])?);
        }
        LoadWords::Heat(words) => {
            scene.heat = Some(heat(binder, &path.then("heat"), words, scene)?);
        }
        LoadWords::ThermalExpansion(words) => {
            let path = path.then("thermal_expansion");
            scene.expansion = Some(expansion(binder, &path, words, scene)?);
        }
        LoadWords::Velocity { on, value } => {
            let path = path.then("velocity");
            let set = sets::free(binder, &path.then("on"), on, &mut scene.sets)?;
            let variables = coordinates_and_time(d);
            set.velocity = Some(binder.vector(&path.then("value"), value, d, &variables)?);
        }
    }
    Ok(())
}
