use crate::exact::{Outline, Polygon};
use crate::suite::evaluator::{Evaluator, shown};
use crate::suite::scene::grid_size::{LONGEST, SHORTEST};
use crate::suite::yaml::{Diagnostic, NumberText, Path};
use std::sync::Arc;

/// Maximum number of corners of a polygon. The limit bounds the run time, because every side is
/// intersected with every lattice cell.
const MOST: usize = 100;

pub(super) fn polygon(
    evaluator: &Evaluator<'_>,
    path: &Path,
    texts: &[Vec<NumberText>],
) -> Result<Arc<dyn Outline>, Diagnostic> {
    if texts.len() < 3 || texts.len() > MOST {
        let message = format!("a polygon of {} corners", texts.len());
        let diagnostic = evaluator.diagnostic(path, &message);
        return Err(diagnostic.with_label(&format!("expected 3 to {MOST}")));
    }
    let corners = corners(evaluator, path, texts)?;
    let polygon = Polygon::new("polygon", &corners).map_err(|(first, second)| {
        let name = |side: usize| format!("{} to {}", side + 1, (side + 1) % corners.len() + 1);
        let (one, other) = (name(first), name(second));
        let message = format!("the sides from corner {one} and from {other} cross or touch");
        let diagnostic = evaluator.diagnostic(&path.then(second), &message);
        diagnostic
            .with_label("expected a side that is apart from all others")
            .with_help("list the corners in their order around the body, either way round")
    })?;
    Ok(Arc::new(polygon))
}

/// Compiles a list of corners (m), which must be distinct.
pub(super) fn corners(
    evaluator: &Evaluator<'_>,
    path: &Path,
    texts: &[Vec<NumberText>],
) -> Result<Vec<[f64; 2]>, Diagnostic> {
    let mut corners: Vec<[f64; 2]> = Vec::with_capacity(texts.len());
    for (i, texts) in texts.iter().enumerate() {
        let at = path.then(i);
        let place = evaluator.point(&at, texts, 2)?;
        let corner = [place[0], place[1]];
        for (k, other) in corners.iter().enumerate() {
            let length = libm::hypot(corner[0] - other[0], corner[1] - other[1]);
            if !(SHORTEST..=LONGEST).contains(&length) {
                let (first, second, length) = (k + 1, i + 1, shown(length));
                let message = format!("corners {first} and {second} are {length} m apart");
                let label = format!("expected a distance from {SHORTEST:e} to {LONGEST:e}");
                return Err(evaluator.diagnostic(&at, &message).with_label(&label));
            }
        }
        corners.push(corner);
    }
    Ok(corners)
}
