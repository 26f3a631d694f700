//! Describes a problem in rows of name and value, for reports and `explain`.

use crate::exact::formula::{Expr, Formula};
use crate::mpm::{MaterialParameter, MaterialPlan, Matrix};
use crate::study::setup::dispatch;
use crate::subject::{PlaneState, Profile};
use crate::suite::EffectName;
use crate::suite::evaluator::shown;
use crate::suite::model::method::Method;
use crate::suite::model::{Case, ConvergencePlan, Scene, StudyPlan, Suite};
use crate::suite::scene::load::LoadTarget;
use crate::suite::scene::numbers::{sources, unit_after};
use crate::verify::{CaseOutcome, rounded, tuple};

pub(crate) fn head(suite: &Suite) -> Vec<(String, String)> {
    let mut rows = Vec::new();
    let varied = varied(suite);
    let parameter = |(name, text, value): &(String, String, Option<f64>)| {
        if let Some((_, Some(row))) = varied.iter().find(|(known, _)| known == name) {
            return format!("{name} (see {row})");
        }
        match value {
            Some(value) if text.parse() != Ok(*value) && !reads(text, &varied) => {
                format!("{name} = {text} = {}", shown(rounded(*value, 7)))
            }
            _ => format!("{name} = {text}"),
        }
    };
    let parameters: Vec<String> = suite.parameters.iter().map(parameter).collect();
    push(&mut rows, "parameters", &parameters.join(", "));
    for (head, body) in &suite.functions {
        push(&mut rows, "function", &format!("{head} = {body}"));
    }
    rows
}

/// Returns the parameters of a stability study that differ between runs: the swept and the sought
/// parameter, each with the name of its row, and the parameters that depend on them.
fn varied(suite: &Suite) -> Vec<(String, Option<&'static str>)> {
    let StudyPlan::Stability(plan) = &suite.study else { return Vec::new() };
    let mut varied = vec![(plan.swept.clone(), Some("sweep"))];
    varied.extend(plan.sought.iter().map(|(name, ..)| (name.clone(), Some("search"))));
    for (name, text, _) in &suite.parameters {
        if reads(text, &varied) && varied.iter().all(|(known, _)| known != name) {
            varied.push((name.clone(), None));
        }
    }
    varied
}

fn reads(text: &str, parameters: &[(String, Option<&'static str>)]) -> bool {
    let is_parameter = |name: &str| parameters.iter().any(|(parameter, _)| parameter == name);
    Expr::parse(text).is_ok_and(|expr| expr.names().iter().any(|(name, _)| is_parameter(name)))
}

pub(crate) type Rows = Vec<(String, String)>;

pub(crate) fn push(rows: &mut Rows, key: &str, value: &str) {
    if !value.is_empty() {
        rows.push((key.to_owned(), value.to_owned()));
    }
}

/// Creates the part of an outcome that is known before the case runs.
pub(crate) fn described(
    case: &str,
    method: Method,
    settings: Rows,
    expected: Option<(String, &str)>,
) -> CaseOutcome {
    let (expected, because) = expected.unzip();
    let because = because.unwrap_or_default().to_owned();
    CaseOutcome { expected, because, ..CaseOutcome::new(case, method.subject(), settings) }
}

/// Formats a position, such as `0.5` in one dimension or `(0, 0.5)`.
fn corner(c: &[f64]) -> String {
    tuple(&c.iter().map(|x| stated(*x)).collect::<Vec<_>>())
}

/// Formats a number with at most six significant digits.
pub(crate) fn stated(x: f64) -> String {
    shown(rounded(x, 6))
}

fn body(scene: &Scene) -> String {
    let (from, to) = (corner(&scene.from), corner(&scene.to));
    let body = match (&scene.outline, &scene.mapped) {
        (None, _) => format!("{from} to {to} m"),
        (Some(outline), Some(_)) => outline.row(),
        (Some(outline), None) => outline.row() + rims(scene, outline.rims().len()),
    };
    let density = match scene.density.formula() {
        None => stated(scene.density.largest()),
        Some(formula) => formula.source().to_owned(),
    };
    format!("{body}, density {density}")
}

fn rims(scene: &Scene, count: usize) -> &'static str {
    let is_loaded = scene.loads.iter().any(|load| matches!(load.target(), LoadTarget::Rim(_)));
    match count {
        _ if is_loaded => "",
        1 => ", free rim",
        _ => ", free rims",
    }
}

fn bodies(scene: &Scene, rows: &mut Rows) {
    for (i, one) in scene.bodies.iter().enumerate() {
        push(rows, &format!("body {}", i + 1), &body(one));
        push(rows, "  material", &material(&one.material));
        push(rows, "  stress", &initial_stress(one));
        push(rows, "  displacement", &sources(&one.initial_displacement));
        push(rows, "  velocity", &sources(&one.initial_velocity));
    }
    match (scene.contact, scene.bodies.len()) {
        (Some(mu), _) => push(rows, "contact", &format!("coefficient of friction {mu}")),
        (None, 0 | 1) => {}
        (None, _) => push(rows, "contact", "none, the bodies share one velocity field"),
    }
}

pub(crate) fn scene(scene: &Scene, rows: &mut Rows) {
    let one = scene.bodies.is_empty();
    if one {
        push(rows, "body", &body(scene));
    }
    bodies(scene, rows);
    if let Some((from, to)) = &scene.grid {
        push(rows, "grid", &format!("{} to {} m", corner(from), corner(to)));
    }
    if one {
        push(rows, "material", &material(&scene.material));
    }
    match scene.plane {
        PlaneState::Strain => {}
        PlaneState::Stress => push(rows, "plane stress", "sigma_33 = 0"),
        PlaneState::Axisymmetric => {
            push(rows, "axisymmetry", "X is the radius, and sums over the body are per radian");
        }
    }
    for (number, face) in scene.faces.iter().enumerate() {
        rows.extend(scene.loads_on(LoadTarget::Face(number)).flat_map(|load| load.rows()));
        let is_loaded = scene.loads_on(LoadTarget::Face(number)).next().is_some();
        push(rows, face.name, &if is_loaded { String::new() } else { face.hold.row() });
    }
    let (on_body, on_parts): (Vec<_>, Vec<_>) =
        scene.loads.iter().partition(|load| load.target() == LoadTarget::Body);
    let on_others = on_parts.into_iter().filter(|load| load.target().face().is_none());
    rows.extend(on_others.chain(on_body).flat_map(|load| load.rows()));
    if one {
        push(rows, "initial stress", &initial_stress(scene));
        push(rows, "initial displacement", &sources(&scene.initial_displacement));
        push(rows, "initial velocity", &sources(&scene.initial_velocity));
    }
}

fn initial_stress(scene: &Scene) -> String {
    const AXES: [&str; 3] = ["x", "y", "z"];
    let written = |(i, j, formula): &(usize, usize, Formula)| {
        format!("{}{} = {}", AXES[*i], AXES[*j], formula.source())
    };
    let given = scene.initial_stress.components();
    if given.is_empty() {
        return String::new();
    }
    let components = given.iter().map(written).collect::<Vec<_>>().join(", ");
    let formulas: Vec<&str> = given.iter().map(|(.., formula)| formula.source()).collect();
    let unit = unit_after(&formulas.join(", "), "Pa");
    if scene.material.properties().yield_function(&Matrix::zeros()).is_some() {
        let meaning = "the stress of the elastic strain at the start";
        return format!("S0 with {components}{unit}, {meaning}");
    }
    let is_finite = scene.material.properties().depends_on_deformation_alone().is_ok();
    let term = if is_finite { "F S0" } else { "S0" };
    format!("S0 with {components}{unit}, and P includes the term {term}")
}

/// Describes name and parameters of the material, such as `linear elastic, E = 100 Pa, nu = 0`.
fn material(plan: &MaterialPlan) -> String {
    let written = |(parameter, value): (MaterialParameter, f64)| {
        let MaterialParameter { what, symbol, unit, .. } = parameter;
        // The symbols of these coefficients are not generally known.
        let name = what.strip_prefix("the coefficient of ");
        let name = name.map_or(String::new(), |name| format!("({name})"));
        format!(", {symbol} = {} {unit}{name}", stated(value)).trim_end().to_owned()
    };
    let parameters: String = plan.parameters().into_iter().map(written).collect();
    plan.name().replace('_', " ") + &parameters
}

/// A part that can be removed from a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dispensable {
    /// An effect.
    Effect(EffectName),
    /// Contact between bodies. Without contact they share one velocity field.
    Contact,
}

impl Dispensable {
    /// Returns all removable parts.
    pub fn all() -> impl Iterator<Item = Self> {
        EffectName::ALL.iter().map(|effect| Self::Effect(*effect)).chain([Self::Contact])
    }

    /// Returns the name that suites and reports use.
    pub fn name(self) -> &'static str {
        match self {
            Self::Effect(effect) => effect.name(),
            Self::Contact => "contact",
        }
    }
}

pub(crate) fn step_profile(plan: &ConvergencePlan, case: &Case) -> Option<Profile> {
    dispatch::profile(plan, case.method, *plan.refine.levels.first()?)
}

pub(crate) fn without_effect(plan: &ConvergencePlan, without: Dispensable) -> ConvergencePlan {
    let mut plan = plan.clone();
    let Dispensable::Effect(effect) = without else {
        plan.scene.contact = None;
        return plan;
    };
    if let (EffectName::BodyForce, Some(problem)) = (effect, &mut plan.exact) {
        problem.manufactured = false;
    }
    remove(&mut plan.scene, effect);
    plan
}

fn remove(scene: &mut Scene, effect: EffectName) {
    let goes = |other: &EffectName| *other == effect || other.needs().contains(&effect);
    scene.loads.retain(|load| !goes(&load.effect));
    scene.bodies.iter_mut().for_each(|body| remove(body, effect));
}
