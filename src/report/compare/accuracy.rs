//! Compares errors and work of two series of levels, level by level.

use super::changes::{ErrorMove, ratio_moved};
use super::document::JsonNumber;
use super::document::{CaseDocument, JudgeDocument, LevelDocument};
use super::equal_error::ErrorAndWork;
use super::snapshots::FINEST;
use crate::verify::Quantity;

/// Maximum relative difference between spacings that count as equal.
const SAME_SPACING: f64 = 1e-6;

/// Maximum error that counts as rounding for a case without an order, as a share of the size of the
/// judged quantity. Changes of such errors are not compared.
const ROUNDING: f64 = 1e-11;

/// Verdict of the gate on errors that are due to rounding.
const AT_ROUNDING: &str = "at rounding";

/// A level of the old run with the corresponding level of the new run.
pub(super) type LevelPair<'a> = (&'a LevelDocument, &'a LevelDocument);

/// Levels that both runs have, coarse to fine.
pub(super) fn common<'a>(old: &'a CaseDocument, new: &'a CaseDocument) -> Vec<LevelPair<'a>> {
    // Each level has at most one counterpart, even if a plan contains a spacing twice.
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

/// Whether the errors of both runs are due to rounding, so that they count as equal.
pub(super) fn is_rounding(old: &CaseDocument, new: &CaseDocument) -> bool {
    let tiny = |case: &CaseDocument| {
        let small = |level: &LevelDocument| relative(case.judge.as_ref(), level) < ROUNDING;
        // Rounding errors may have an order by chance, which the gate does not accept.
        let has_no_order = case.observed_order.is_none() || case.verdict == AT_ROUNDING;
        has_no_order && case.levels.iter().all(small)
    };
    tiny(old) && tiny(new)
}

/// Error relative to the natural size of the judged quantity; NaN if the size is unknown.
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

/// Change of the error on the finest level that newly fails or no longer fails. Otherwise the
/// change on the finest level, or else the change on the level with the largest change. `None`
/// without a change.
pub(super) fn error(
    pairs: &[LevelPair<'_>],
    axis: Option<&str>,
    tolerance: f64,
) -> Option<ErrorMove> {
    let counts = |level: &LevelDocument| level.counts.unwrap_or(true);
    let counting: Vec<LevelPair<'_>> =
        pairs.iter().filter(|(old, new)| counts(old) || counts(new)).copied().collect();
    // If no level counts, as for a floor, all levels are compared.
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

/// Ratio of the transfers of the new run to those of the old run, on the finest level, or on the
/// level with the largest change if the finest one has none.
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

/// Error and transfers of every level, in the order of the plan.
pub(super) fn points(case: &CaseDocument) -> Vec<ErrorAndWork> {
    let point = |level: &LevelDocument| (level.error().unwrap_or(f64::NAN), level.transfers as f64);
    case.levels.iter().map(point).collect()
}

/// Name of a level in its study.
fn name(level: &LevelDocument, axis: Option<&str>) -> String {
    let JsonNumber(spacing) = level.spacing;
    match (axis, level.ppc) {
        (Some(FINEST), _) => "the finest level".to_owned(),
        (Some("time"), _) => format!("dt = {spacing:.3e} s"),
        (Some("particles"), Some(ppc)) => format!("{ppc} particles per cell"),
        _ => format!("{} cells", level.cells),
    }
}
