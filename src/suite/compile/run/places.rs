//! Positions that a suite states: offsets of particles from their lattice, and the observed point.

use crate::suite::evaluator::{Evaluator, shown};
use crate::suite::grammar::{ConvergenceSpec, ObserveSpec, ScatterSpec};
use crate::suite::model::Scene;
use crate::suite::scene::lattice::LatticeOffsets;
use crate::suite::scene::load::{ListedLoad, LoadTarget};
use crate::suite::yaml::{Diagnostic, NumberText, Path};

/// Maximum offset of a particle from its lattice point, as a fraction of the particle spacing. At
/// this offset, the particle is halfway to the next lattice point.
const MOST: f64 = 0.5;

/// Maximum random offset, as a share of the spacing, if a face carries a load. The particle layer
/// at the face then stays separate from the next layer.
const MOST_AT_LOADS: f64 = 0.25;

const SEED: u64 = 1;

pub(crate) fn scatter(
    evaluator: &Evaluator<'_>,
    spec: &ConvergenceSpec,
    scene: &Scene,
) -> Result<LatticeOffsets, Diagnostic> {
    let Some(ScatterSpec { shift, perturb, seed }) = &spec.particles else {
        return Ok(LatticeOffsets::default());
    };
    let path = Path::top("particles");
    if scene.each().iter().any(|body| body.outline.is_some()) {
        let message = "`particles` is supported for boxes only: it moves particles off a regular \
                       lattice";
        return Err(evaluator.diagnostic_at_key(&path, message));
    }
    let numbers =
        |texts: &[NumberText]| evaluator.point(&path.then("shift"), texts, scene.dimension());
    let shift = shift.as_deref().map(numbers).transpose()?.unwrap_or_default();
    let at = path.then("perturb");
    let number = |text: &NumberText| evaluator.positive(&at, text, "the share of the spacing");
    let perturb = perturb.as_ref().map(number).transpose()?.unwrap_or(0.0);
    let at = path.then("seed");
    let count = |text: &NumberText| evaluator.count(&at, text, "the seed");
    if seed.is_some() && perturb == 0.0 {
        let diagnostic = evaluator.diagnostic_at_key(&at, "`seed` has no effect without `perturb`");
        return Err(diagnostic.with_help("add `perturb: 0.2`, or remove the seed"));
    }
    let seed = seed.as_ref().map(count).transpose()?.unwrap_or(SEED);
    let furthest = shift.iter().fold(0.0_f64, |most, share| most.max(share.abs())) + perturb;
    if !(furthest <= MOST) {
        let message = format!("particles are moved by up to {} of their spacing", shown(furthest));
        let label = format!("expected at most {MOST}, so that they stay in the body and apart");
        return Err(evaluator.diagnostic(&path, &message).with_label(&label));
    }
    let at_face =
        |load: &ListedLoad| matches!(load.target(), LoadTarget::Face(_) | LoadTarget::Rim(_));
    if perturb > MOST_AT_LOADS && scene.loads.iter().any(at_face) {
        let message = format!("particles are moved by up to {} of their spacing", shown(perturb));
        let label = format!("expected at most {MOST_AT_LOADS} at a face or rim with a load");
        return Err(evaluator.diagnostic(&path.then("perturb"), &message).with_label(&label));
    }
    let scatter = LatticeOffsets { shift, perturb, seed };
    if scatter.is_none() {
        let diagnostic = evaluator.diagnostic_at_key(&path, "`particles` moves no particle");
        return Err(diagnostic.with_help("add `shift: [0.25]` or `perturb: 0.2`, or remove it"));
    }
    Ok(scatter)
}

/// Compiles the observed point, which must be in the body.
pub(crate) fn observed(
    evaluator: &Evaluator<'_>,
    spec: &ObserveSpec,
    scene: &Scene,
) -> Result<Vec<f64>, Diagnostic> {
    let path = Path::top("observe").then("at");
    let place = evaluator.point(&path, &spec.at, scene.dimension())?;
    for (axis, x) in place.iter().enumerate() {
        let (from, to) = (scene.from[axis], scene.to[axis]);
        if !(from..=to).contains(x) {
            let message = format!("{} is outside the body", shown(*x));
            let label = format!("expected a number from {} to {}", shown(from), shown(to));
            return Err(evaluator.diagnostic(&path.then(axis), &message).with_label(&label));
        }
    }
    let outside = scene.outline.as_ref().filter(|outline| !outline.holds(&place));
    if let Some(kind) = outside.map(|outline| outline.kind()) {
        let diagnostic = evaluator.diagnostic(&path, "this point is outside the body");
        return Err(diagnostic.with_label(&format!("expected a point in the {kind}")));
    }
    Ok(place)
}
