//! Scales and bounds that a run is judged by.

use crate::suite::evaluator::{Evaluator, shown};
use crate::suite::grammar::StabilitySpec;
use crate::suite::model::Scene;
use crate::suite::yaml::{Diagnostic, NumberText, Path};
use crate::verify::{RunFigure, Scales};

/// Energy, over that at the start, up to which a run is stable: above what the exchange between
/// velocities and stresses makes of a random start just below the limit of a leapfrog.
const STABLE_BELOW: f64 = 1e3;

/// Energy beyond which a run is unstable.
const UNSTABLE_ABOVE: f64 = 1e8;

/// Scales and bounds of the runs of `scene`.
pub(crate) fn scales(
    evaluator: &Evaluator<'_>,
    spec: &StabilitySpec,
    scene: &Scene,
) -> Result<Scales, Diagnostic> {
    let modulus = scene
        .each()
        .iter()
        .map(|body| body.material.properties().wave_modulus())
        .fold(0.0, f64::max);
    let path = Path::top("run");
    let bound = |key: &str, text: &Option<NumberText>, default: f64| {
        let at = path.then(key);
        text.as_ref().map_or(Ok(default), |text| evaluator.positive(&at, text, "the bound"))
    };
    let stable_below = bound("stable_below", &spec.run.stable_below, STABLE_BELOW)?;
    let unstable_above = bound("unstable_above", &spec.run.unstable_above, UNSTABLE_ABOVE)?;
    if !(stable_below <= unstable_above) {
        let message = format!(
            "a run is stable below {} and unstable above {}",
            shown(stable_below),
            shown(unstable_above)
        );
        return Err(evaluator.diagnostic_at_key(&path, &message));
    }
    let speed = scene.fastest_wave();
    let centred = scene.faces.iter().all(|face| !face.hold.is_held());
    let null_space = of_null_space(evaluator, spec, scene)?;
    Ok(Scales { speed, modulus, stable_below, unstable_above, centred, null_space })
}

/// Whether a requested figure needs the null space of the grid, which is known of one body only.
fn of_null_space(
    evaluator: &Evaluator<'_>,
    spec: &StabilitySpec,
    scene: &Scene,
) -> Result<bool, Diagnostic> {
    let shown = spec.show.iter().enumerate();
    let shown = shown.map(|(i, figure)| (Path::top("show").then(i), *figure));
    let expected = spec.expect.iter().enumerate().flat_map(|(i, entry)| {
        let path = Path::top("expect").then(i).then("figures");
        let named = entry.figures.as_slice().iter().filter_map(|(name, _)| {
            RunFigure::ALL.iter().copied().find(|figure| figure.name() == name)
        });
        named.map(move |figure| (path.then(figure.name()), figure))
    });
    let Some((path, figure)) = shown.chain(expected).find(|(_, f)| f.is_of_null_space()) else {
        return Ok(false);
    };
    if scene.bodies.is_empty() {
        return Ok(true);
    }
    let name = figure.name();
    let message = format!("`{name}` is a figure of one body, and the scene has several");
    Err(evaluator.diagnostic(&path, &message))
}
