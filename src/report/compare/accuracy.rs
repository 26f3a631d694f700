//! Compares errors and work of two series of levels, level by level.

use super::changes::{ErrorMove, ratio_moved};
use super::document::{CaseDocument, JsonNumber, JudgeDocument, LevelDocument};
use super::snapshots::FINEST;
use crate::verify::Quantity;

/// Maximum relative difference between spacings that count as equal.
const SAME_SPACING: f64 = 1e-6;

/// Maximum error that counts as rounding for a case without an order, relative to the size of the
/// judged quantity. Changes of such errors are not compared.
const ROUNDING: f64 = 1e-11;

/// Verdict of `run --gate` on errors that are due to rounding.
const AT_ROUNDING: &str = "at rounding";

/// A level of the old run and the corresponding level of the new run.
pub(super) type LevelPair<'a> = (&'a LevelDocument, &'a LevelDocument);

/// Returns the levels that both runs have, from coarse to fine.
pub(super) fn common<'a>(old: &'a CaseDocument, new: &'a CaseDocument) -> Vec<LevelPair<'a>> {
    // A plan may contain a spacing twice; each level is still paired only once.
    let mut left: Vec<&LevelDocument> = old.levels.iter().collect();
    let counterpart = |level: &'a LevelDocument| {
        let at = left.iter().position(|old| same(old, level))?;
        Some((left.remove(at), level))
    };
    new.levels.iter().filter_map(counterpart).collect()
}

fn same(a: &LevelDocument, b: &LevelDocument) -> bool {
    let (JsonNumber(x), JsonNumber(y)) = (a.spacing, b.spacing);
    let spacing = x.to_bits() == y.to_bits() || (x / y - 1.0).abs() <= SAME_SPACING;
    a.cells == b.cells && a.ppc == b.ppc && spacing
}

/// Whether the errors of both runs are due to rounding and therefore count as equal.
pub(super) fn is_rounding(old: &CaseDocument, new: &CaseDocument) -> bool {
    let tiny = |case: &CaseDocument| {
        let small = |level: &LevelDocument| relative(case.judge.as_ref(), level) < ROUNDING;
        // Rounding errors may have an order by chance. `run --gate` then reports `AT_ROUNDING`.
        let has_no_order = case.observed_order.is_none() || case.verdict == AT_ROUNDING;
        has_no_order && case.levels.iter().all(small)
    };
    tiny(old) && tiny(new)
}

/// Divides the error by the natural size of the judged quantity; NaN if the size is unknown.
fn relative(judge: Option<&JudgeDocument>, level: &LevelDocument) -> f64 {
    let Some(error) = level.error() else { return f64::NAN };
    let (JsonNumber(h), length) = (level.h, level.cells as f64);
    match judge {
        Some(JudgeDocument { scale: Some(_), .. }) => error,
        Some(judge) => {
            let of = Quantity::named(&judge.of);
            error / of.map_or(f64::NAN, |of| of.rounding_size(h * length))
        }
        None => error / Quantity::default().rounding_size(h * length),
    }
}

/// Returns the error change to report: of a level that newly fails or no longer fails, or else of
/// the finest level, or else the largest change. `None` without a change.
pub(super) fn error(
    pairs: &[LevelPair<'_>],
    axis: Option<&str>,
    tolerance: f64,
) -> Option<ErrorMove> {
    let counts = |level: &LevelDocument| level.counts.unwrap_or(true);
    let counting: Vec<LevelPair<'_>> =
        pairs.iter().filter(|(old, new)| counts(old) || counts(new)).copied().collect();
    // If no level counts for the verdict, all levels are compared.
    let pairs = if counting.is_empty() { pairs } else { &counting };
    let moves: Vec<ErrorMove> =
        pairs.iter().filter_map(|pair| error_of(*pair, axis, tolerance)).collect();
    let broken = moves.iter().rfind(|found| found.old.is_none() || found.new.is_none());
    let finest = pairs.last().and_then(|pair| error_of(*pair, axis, tolerance));
    let most = || moves.iter().max_by(|a, b| a.weight().total_cmp(&b.weight())).cloned();
    broken.cloned().or(finest).or_else(most)
}

fn error_of((old, new): LevelPair<'_>, axis: Option<&str>, tolerance: f64) -> Option<ErrorMove> {
    let level = name(new, axis);
    match (old.is_broken(), new.is_broken()) {
        (true, true) => None,
        (false, true) => Some(ErrorMove { old: old.error(), new: None, worse: true, level }),
        (true, false) => Some(ErrorMove { old: None, new: new.error(), worse: false, level }),
        (false, false) => {
            let (a, b) = (old.error()?, new.error()?);
            let moved = ratio_moved(b / a, tolerance) && a != b;
            moved.then_some(ErrorMove { old: Some(a), new: Some(b), worse: b > a, level })
        }
    }
}

/// Returns the ratio of new to old transfers on the finest level, or on the level with the largest
/// change if the finest level has none.
pub(super) fn work(pairs: &[LevelPair<'_>], tolerance: f64) -> Option<f64> {
    let ratio = |(old, new): &LevelPair<'_>| match (old.transfers, new.transfers) {
        (a, b) if a == b => 1.0,
        (a, b) => b as f64 / a as f64,
    };
    let finest = ratio(pairs.last()?);
    if ratio_moved(finest, tolerance) {
        return Some(finest);
    }
    let size = |ratio: &f64| libm::log(*ratio).abs();
    pairs.iter().map(ratio).max_by(|a, b| size(a).total_cmp(&size(b)))
}

fn name(level: &LevelDocument, axis: Option<&str>) -> String {
    let JsonNumber(spacing) = level.spacing;
    match (axis, level.ppc) {
        (Some(FINEST), _) => "the finest level".to_owned(),
        (Some("time"), _) => format!("dt = {spacing:.3e} s"),
        (Some("particles"), Some(ppc)) => format!("{ppc} particles per cell"),
        _ => format!("{} cells", level.cells),
    }
}
