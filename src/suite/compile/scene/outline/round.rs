use crate::exact::{Outline, Round};
use crate::suite::evaluator::{Evaluator, shown};
use crate::suite::grammar::{AnnulusSpec, RoundSpec};
use crate::suite::scene::grid_size::{LONGEST, SHORTEST};
use crate::suite::yaml::{Diagnostic, NumberText, Path};
use std::sync::Arc;

pub(super) fn annulus(
    evaluator: &Evaluator<'_>,
    path: &Path,
    AnnulusSpec { centre, inner, outer }: &AnnulusSpec,
) -> Result<Arc<dyn Outline>, Diagnostic> {
    let centre = evaluator.point(&path.then("centre"), centre, 2)?;
    let inner = radius(evaluator, &path.then("inner"), inner)?;
    let outer = radius(evaluator, &path.then("outer"), outer)?;
    if inner < outer {
        return Ok(Arc::new(Round { centre, inner, outer }));
    }
    let message = format!("the outer radius is {}, the inner {}", shown(outer), shown(inner));
    let diagnostic = evaluator.diagnostic(&path.then("outer"), &message);
    Err(diagnostic.with_label("expected a number above `inner`"))
}

pub(super) fn filled(
    evaluator: &Evaluator<'_>,
    path: &Path,
    spec: &RoundSpec,
    dimension: usize,
) -> Result<Arc<dyn Outline>, Diagnostic> {
    let centre = evaluator.point(&path.then("centre"), &spec.centre, dimension)?;
    let outer = radius(evaluator, &path.then("radius"), &spec.radius)?;
    Ok(Arc::new(Round { centre, inner: 0.0, outer }))
}

fn radius(evaluator: &Evaluator<'_>, path: &Path, text: &NumberText) -> Result<f64, Diagnostic> {
    let radius = evaluator.positive(path, text, "the radius")?;
    if (SHORTEST..=LONGEST).contains(&radius) {
        return Ok(radius);
    }
    let message = format!("the radius is {} m", shown(radius));
    let label = format!("expected a length from {SHORTEST:e} to {LONGEST:e}");
    Err(evaluator.diagnostic(path, &message).with_label(&label))
}
