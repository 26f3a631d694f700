//! Compiles the material of a body, its density and its initial state.

use super::outline::Shape;
use crate::exact::formula::Formula;
use crate::exact::{Density, InitialStress, NoDensity};
use crate::mpm::{Contradiction, MaterialParameter, MaterialPlan, MaterialSpec, Matrix, Range};
use crate::subject::PlaneState;
use crate::suite::evaluator::{COORDINATES, SuitePath, shown};
use crate::suite::grammar::{OneBodySpec, StressSpec};
use crate::suite::scene::holds;
use crate::suite::scene::load::{EffectName, LoadSpec};
use crate::suite::yaml::{Diagnostic, NumberText};

pub(super) fn material(
    path: &SuitePath<'_>,
    spec: &MaterialSpec<NumberText>,
) -> Result<MaterialPlan, Diagnostic> {
    let path = path.then(spec.name());
    let material = spec.numbers(|key, parameter, text| {
        let value = number_in_range(&path.then(key), text, parameter);
        value.map_err(|diagnostic| {
            if !path.evaluator.depends_on_coordinate(text) {
                return diagnostic;
            }
            diagnostic.with_help(
                "only the density of a material can vary over a body: for several materials, list \
                 several `bodies` in `scene`",
            )
        })
    })?;
    if let Some(Contradiction { key, reason, explanation }) = material.properties().contradiction()
    {
        return Err(path.then(key).diagnostic(reason).with_label(explanation));
    }
    Ok(material)
}

fn number_in_range(
    path: &SuitePath<'_>,
    text: &NumberText,
    parameter: &MaterialParameter,
) -> Result<f64, Diagnostic> {
    let (what, value) = (parameter.what, path.number(text)?);
    let (is_valid, reason, expected) = match parameter.range {
        Range::Positive => return path.positive(text, what),
        Range::NotNegative => {
            (value >= 0.0, ", but must not be below zero", "expected zero or a positive number")
        }
        Range::AboveOne => (value > 1.0, ", but must be above one", "expected a number above 1"),
        Range::PoissonsRatio => {
            (value > -1.0 && value < 0.5, "", "expected a number above -1 and below 0.5")
        }
        Range::Angle => (
            (0.0..90.0).contains(&value),
            " degrees",
            "expected at least 0 and less than 90 degrees",
        ),
    };
    if is_valid {
        return Ok(value);
    }
    Err(path.unusable(text, &format!("{what} is {}{reason}", shown(value)), expected))
}

pub(super) fn refuse_plane(
    path: &SuitePath<'_>,
    material: &MaterialPlan,
    plane: PlaneState,
) -> Result<(), Diagnostic> {
    if material.supports(plane) {
        return Ok(());
    }
    let name = material.name();
    let message = format!("the law `{name}` is not supported in plane stress, where sigma_33 = 0");
    path.then(name).refuse_key(&message, "use `linear_elastic`, `neo_hookean` or `hencky`")
}

pub(super) fn density(
    path: &SuitePath<'_>,
    text: &NumberText,
    material: &MaterialPlan,
    shape: &Shape,
    loads: &[LoadSpec],
) -> Result<Density, Diagnostic> {
    if !path.evaluator.depends_on_coordinate(text) {
        return Ok(path.positive(text, "the density")?.into());
    }
    let formula = path.formula(text, &COORDINATES[..shape.from.len()])?;
    if let Some(reason) = against_varying_density(material, shape, loads) {
        let message =
            format!("a density that varies over the body is not supported here: {reason}");
        return Err(path.diagnostic(&message));
    }
    let density = Density::of_place(formula, &shape.from, &shape.to, shape.outline.as_deref())
        .map_err(|place| not_positive(path, text, &place))?;
    if density.smallest() == 0.0 && !material.properties().wave_speed(0.0).is_finite() {
        let message = format!(
            "the density is zero on the rim, where the wave speed of `{}` is unbounded",
            material.name()
        );
        let diagnostic = path.unusable(text, &message, "expected a positive density");
        return Err(diagnostic.with_help("use a `polytropic` gas, or add a constant"));
    }
    Ok(density)
}

fn not_positive(path: &SuitePath<'_>, text: &NumberText, place: &NoDensity) -> Diagnostic {
    let label: Vec<String> = place.label.iter().map(|x| shown(*x)).collect();
    let value = shown(place.value);
    let message = format!("the density is {value} kg/m3 at ({}) m", label.join(", "));
    let label = "expected a positive density inside the body, and at least zero on its rim";
    path.unusable(text, &message, label)
}

fn against_varying_density(
    material: &MaterialPlan,
    shape: &Shape,
    loads: &[LoadSpec],
) -> Option<&'static str> {
    if shape.mapped.is_some() || shape.outline.as_ref().is_some_and(|o| o.ball().is_none()) {
        return Some("masses are integrated in a box or a round body only");
    }
    if shape.plane == PlaneState::Axisymmetric {
        return Some("masses are not integrated in a body of revolution");
    }
    if material.properties().is_at_rest() {
        return Some("the body does not move: state a number");
    }
    loads.iter().find_map(|load| match load.effect() {
        EffectName::Heat => Some("`heat` needs a uniform heat capacity per volume"),
        EffectName::SetForce => Some("a `force` on a set needs a uniform density"),
        _ => None,
    })
}

const COMPONENTS: [(&str, usize, usize); 6] =
    [("xx", 0, 0), ("yy", 1, 1), ("zz", 2, 2), ("xy", 0, 1), ("yz", 1, 2), ("xz", 0, 2)];

/// Compiles the initial displacement (m); empty if not stated.
pub(super) fn displacement(
    path: &SuitePath<'_>,
    own: &OneBodySpec,
    dimension: usize,
    material: &MaterialPlan,
) -> Result<Vec<Formula>, Diagnostic> {
    let path = path.then("initial_displacement");
    let Some(texts) = &own.initial_displacement else { return Ok(Vec::new()) };
    let admitted = material.properties().starts_deformed();
    admit(&path, material, admitted, "cannot start deformed")?;
    path.fields(texts, dimension)
}

pub(super) fn stress(
    path: &SuitePath<'_>,
    spec: Option<&StressSpec>,
    dimension: usize,
    material: &MaterialPlan,
) -> Result<InitialStress, Diagnostic> {
    let Some(spec) = spec else { return Ok(InitialStress::default()) };
    let admitted = material.properties().starts_stressed();
    admit(path, material, admitted, "does not support an initial stress")?;
    let yields = material.properties().yield_function(&Matrix::zeros()).is_some();
    let texts = [&spec.xx, &spec.yy, &spec.zz, &spec.xy, &spec.yz, &spec.xz];
    let mut components = Vec::new();
    for ((name, i, j), text) in COMPONENTS.into_iter().zip(texts) {
        let at = path.then(name);
        let is_across = i == j && i >= dimension;
        let Some(text) = text else {
            if yields && is_across {
                let message = format!("`initial_stress` does not state `{name}`");
                let help = "the yield condition depends on all three normal stresses, also on \
                            those out of the plane";
                return path.refuse_key(&message, help);
            }
            continue;
        };
        if i.max(j) >= dimension && !(yields && is_across) {
            let message = format!("`{name}` is not a stress component in {dimension}-D");
            let help = known(dimension, yields);
            return at.refuse_key(&message, &help);
        }
        components.push((i, j, at.formula(text, &COORDINATES[..dimension])?));
    }
    if components.is_empty() {
        return path.refuse("`initial_stress` states no component", &known(dimension, yields));
    }
    Ok(InitialStress::new(components))
}

/// Lists the stress components in this dimension, with all normal ones for a law that `yields`.
fn known(dimension: usize, yields: bool) -> String {
    let inside = COMPONENTS.iter().filter(|(_, i, j)| *i.max(j) < dimension || (yields && i == j));
    let names: Vec<String> = inside.map(|(name, ..)| format!("`{name}`")).collect();
    format!("components: {}", names.join(", "))
}

/// Number of positions along each axis of the yield check, in 1-D, 2-D and 3-D.
const YIELD_POSITIONS: [usize; 3] = [1025, 65, 17];

/// Refuses an initial stress outside the yield surface at the points of a regular grid.
pub(super) fn refuse_outside_yield_surface(
    path: &SuitePath<'_>,
    initial_stress: &InitialStress,
    material: &MaterialPlan,
    shape: &Shape,
) -> Result<(), Diagnostic> {
    if initial_stress.is_none() {
        return Ok(());
    }
    let (d, law) = (shape.from.len(), material.properties());
    let count = YIELD_POSITIONS[d - 1];
    let is_inside = |label: &[f64]| holds(&shape.from, &shape.to, shape.outline.as_deref(), label);
    let mut worst: Option<(f64, Vec<f64>)> = None;
    for k in 0..count.pow(d as u32) {
        let place = |axis: usize| {
            let share = (k / count.pow(axis as u32) % count) as f64 / (count - 1) as f64;
            shape.from[axis] * (1.0 - share) + shape.to[axis] * share
        };
        let label: Vec<f64> = (0..d).map(place).collect();
        let stress = initial_stress.at(&label);
        let Some(limit) = law.yield_function(&Matrix::from_fn(|i, j| stress[i][j])) else {
            return Ok(());
        };
        let is_worse = |(value, _): &(f64, Vec<f64>)| !(limit.value <= *value);
        if limit.is_exceeded() && is_inside(&label) && worst.as_ref().is_none_or(is_worse) {
            worst = Some((limit.value, label));
        }
    }
    let Some((value, label)) = worst else { return Ok(()) };
    let place: Vec<String> = label.iter().map(|x| shown(*x)).collect();
    if !value.is_finite() {
        let message = format!("the initial stress at ({}) m is not finite", place.join(", "));
        return Err(path.diagnostic_at_key(&message));
    }
    let message = format!(
        "the initial stress violates the yield condition of `{}`: f = {value:.3e} Pa at ({}) m",
        material.name(),
        place.join(", ")
    );
    path.refuse_key(&message, "f must not be positive")
}

/// Refuses a feature that the law does not support; `lacks` follows the name of the law.
fn admit(
    path: &SuitePath<'_>,
    material: &MaterialPlan,
    admitted: Result<(), &'static str>,
    lacks: &str,
) -> Result<(), Diagnostic> {
    admitted.map_err(|reason| {
        path.diagnostic_at_key(&format!("a `{}` body {lacks}", material.name())).with_help(reason)
    })
}
