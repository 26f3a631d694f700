//! The reference density of a body: a number, or a formula of the coordinates.

use super::bodies::Listed;
use crate::exact::{Density, NoDensity};
use crate::subject::PlaneState;
use crate::suite::evaluator::{COORDINATES, Evaluator, shown};
use crate::suite::model::Scene;
use crate::suite::scene::load::EffectName;
use crate::suite::yaml::{Diagnostic, NumberText, Path};

fn path(own: &Listed<'_>) -> Path {
    own.at.then("material").then(own.material.name()).then("density")
}

/// Compiles a density that is a number; returns `None` for a formula of the coordinates.
pub(crate) fn uniform(
    evaluator: &Evaluator<'_>,
    own: &Listed<'_>,
) -> Result<Option<Density>, Diagnostic> {
    let text = own.material.density();
    if evaluator.depends_on_coordinate(text) {
        return Ok(None);
    }
    Ok(Some(evaluator.positive(&path(own), text, "the density")?.into()))
}

/// Compiles the varying density of a body with the shape of `scene`.
pub(crate) fn varying(
    evaluator: &Evaluator<'_>,
    own: &Listed<'_>,
    scene: &Scene,
) -> Result<Density, Diagnostic> {
    let (path, text) = (path(own), own.material.density());
    let formula = evaluator.formula(&path, text, &COORDINATES[..scene.dimension()])?;
    if let Some(reason) = unsupported(scene) {
        let message =
            format!("a density that varies over the body is not supported here: {reason}");
        return Err(evaluator.diagnostic(&path, &message));
    }
    let density = Density::of_place(formula, &scene.from, &scene.to, scene.outline.as_deref())
        .map_err(|place| not_positive(evaluator, &path, text, &place))?;
    let properties = scene.material.properties();
    if density.smallest() == 0.0 && !properties.wave_speed(0.0).is_finite() {
        let message = format!(
            "the density is zero on the rim, where the wave speed of `{}` is unbounded",
            scene.material.name()
        );
        let diagnostic = evaluator.unusable(&path, text, &message, "expected a positive density");
        return Err(diagnostic.with_help("use a `polytropic` gas, or add a constant"));
    }
    Ok(density)
}

fn not_positive(
    evaluator: &Evaluator<'_>,
    path: &Path,
    text: &NumberText,
    place: &NoDensity,
) -> Diagnostic {
    let label: Vec<String> = place.label.iter().map(|x| shown(*x)).collect();
    let value = shown(place.value);
    let message = format!("the density is {value} kg/m3 at ({}) m", label.join(", "));
    let label = "expected a positive density inside the body, and at least zero on its rim";
    evaluator.unusable(path, text, &message, label)
}

/// Returns the reason why the scene does not support a varying density; `None` if it does.
fn unsupported(scene: &Scene) -> Option<&'static str> {
    if scene.mapped.is_some() || scene.outline.as_ref().is_some_and(|o| o.ball().is_none()) {
        return Some("masses are integrated in a box or a round body only");
    }
    if scene.plane == PlaneState::Axisymmetric {
        return Some("masses are not integrated in a body of revolution");
    }
    if scene.is_at_rest() {
        return Some("the body does not move: state a number");
    }
    None
}

/// Refuses loads that require a uniform density.
pub(crate) fn refuse_loads(
    evaluator: &Evaluator<'_>,
    own: &Listed<'_>,
    scene: &Scene,
) -> Result<(), Diagnostic> {
    let loads = [
        (EffectName::Heat, "`heat` needs a uniform heat capacity per volume"),
        (EffectName::SetForce, "a `force` on a set needs a uniform density"),
    ];
    let listed = loads.iter().find(|(effect, _)| scene.lists(*effect));
    match listed.filter(|_| scene.density.uniform().is_none()) {
        None => Ok(()),
        Some((_, reason)) => {
            let message =
                format!("a density that varies over the body is not supported here: {reason}");
            Err(evaluator.diagnostic(&path(own), &message))
        }
    }
}
