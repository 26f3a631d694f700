//! Compiles the material of a body and its initial state.

use super::bodies::Listed;
use crate::exact::InitialStress;
use crate::exact::formula::Formula;
use crate::mpm::{Contradiction, MaterialParameter, MaterialPlan, MaterialSpec, Range};
use crate::suite::evaluator::{COORDINATES, Evaluator, coordinates_and_time, shown};
use crate::suite::yaml::{Diagnostic, NumberText, Path};

pub(crate) fn material(
    evaluator: &Evaluator<'_>,
    path: &Path,
    spec: &MaterialSpec<NumberText>,
) -> Result<MaterialPlan, Diagnostic> {
    let path = path.then(spec.name());
    let material = spec.numbers(|key, parameter, text| {
        let value = number_in_range(evaluator, &path.then(key), text, parameter);
        value.map_err(|diagnostic| {
            if !evaluator.depends_on_coordinate(text) {
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
        return Err(evaluator.diagnostic(&path.then(key), reason).with_label(explanation));
    }
    Ok(material)
}

/// Evaluates a parameter of a material, which must be in its range.
fn number_in_range(
    evaluator: &Evaluator<'_>,
    path: &Path,
    text: &NumberText,
    parameter: &MaterialParameter,
) -> Result<f64, Diagnostic> {
    let (what, value) = (parameter.what, evaluator.number(path, text)?);
    let (is_valid, reason, expected) = match parameter.range {
        Range::Positive => return evaluator.positive(path, text, what),
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
    let message = format!("{what} is {}{reason}", shown(value));
    Err(evaluator.unusable(path, text, &message, expected))
}

const COMPONENTS: [(&str, usize, usize); 6] =
    [("xx", 0, 0), ("yy", 1, 1), ("zz", 2, 2), ("xy", 0, 1), ("yz", 1, 2), ("xz", 0, 2)];

/// Compiles the initial displacement (m); empty if not stated.
pub(crate) fn displacement(
    evaluator: &Evaluator<'_>,
    own: &Listed<'_>,
    dimension: usize,
    material: &MaterialPlan,
) -> Result<Vec<Formula>, Diagnostic> {
    let path = own.at.then("initial_displacement");
    let Some(texts) = own.initial_displacement else { return Ok(Vec::new()) };
    let admitted = material.properties().starts_deformed();
    admit(evaluator, &path, material, admitted, "cannot start deformed")?;
    evaluator.vector(&path, texts, dimension, &coordinates_and_time(dimension))
}

/// Compiles the initial velocity (m/s); empty if not stated.
pub(crate) fn velocity(
    evaluator: &Evaluator<'_>,
    own: &Listed<'_>,
    dimension: usize,
) -> Result<Vec<Formula>, Diagnostic> {
    let path = own.at.then("initial_velocity");
    let variables = coordinates_and_time(dimension);
    own.initial_velocity
        .map_or(Ok(Vec::new()), |texts| evaluator.vector(&path, texts, dimension, &variables))
}

pub(crate) fn stress(
    evaluator: &Evaluator<'_>,
    own: &Listed<'_>,
    dimension: usize,
    material: &MaterialPlan,
) -> Result<InitialStress, Diagnostic> {
    let path = own.at.then("initial_stress");
    let Some(spec) = own.initial_stress else { return Ok(InitialStress::default()) };
    let admitted = material.properties().starts_stressed();
    admit(evaluator, &path, material, admitted, "does not support an initial stress")?;
    let texts = [&spec.xx, &spec.yy, &spec.zz, &spec.xy, &spec.yz, &spec.xz];
    let mut components = Vec::new();
    for ((name, i, j), text) in COMPONENTS.into_iter().zip(texts) {
        let Some(text) = text else { continue };
        let at = path.then(name);
        if i.max(j) >= dimension {
            let message = format!("`{name}` is not a stress component in {dimension}-D");
            return Err(evaluator.diagnostic_at_key(&at, &message).with_help(&known(dimension)));
        }
        components.push((i, j, evaluator.formula(&at, text, &COORDINATES[..dimension])?));
    }
    if components.is_empty() {
        let diagnostic = evaluator.diagnostic(&path, "`initial_stress` states no component");
        return Err(diagnostic.with_help(&known(dimension)));
    }
    Ok(InitialStress::new(components))
}

/// Lists the names of the stress components in this number of dimensions.
fn known(dimension: usize) -> String {
    let inside = COMPONENTS.iter().filter(|(_, i, j)| *i.max(j) < dimension);
    let names: Vec<String> = inside.map(|(name, ..)| format!("`{name}`")).collect();
    format!("components: {}", names.join(", "))
}

/// Refuses a feature that the law of `material` does not support. In the message, `lacks` follows
/// the name of the law.
fn admit(
    evaluator: &Evaluator<'_>,
    path: &Path,
    material: &MaterialPlan,
    admitted: Result<(), &'static str>,
    lacks: &str,
) -> Result<(), Diagnostic> {
    admitted.map_err(|reason| {
        let message = format!("a `{}` body {lacks}", material.name());
        evaluator.diagnostic_at_key(path, &message).with_help(reason)
    })
}
