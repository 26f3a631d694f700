//! Least work of a suite for each target error, in two runs.
//!
//! Documents list under `cost` what each method takes for each target of its problem; those without
//! that key are not compared in this respect.

use super::changes::{CheapestMove, ratio_moved};
use super::document::{RankingDocument, ReportDocument};
use super::number::JsonNumber;

/// Targets whose least work moved, the more expensive first; a target that no method reaches any
/// more before all. Suites of another problem are left out.
pub(super) fn compare(
    old: &ReportDocument,
    new: &ReportDocument,
    tolerance: f64,
    is_of_another: impl Fn(&str) -> bool,
) -> Vec<CheapestMove> {
    let mut moves = Vec::new();
    for before in old.suites.iter().filter(|suite| !is_of_another(&suite.name)) {
        let Some(after) = new.suites.iter().find(|suite| suite.name == before.name) else {
            continue;
        };
        for a in &before.cost {
            let b = after.cost.iter().find(|b| (&b.problem, &b.work) == (&a.problem, &a.work));
            moves.extend(b.into_iter().flat_map(|b| problem(&before.name, a, b, tolerance)));
        }
    }
    moves.sort_by(|a, b| b.ratio().total_cmp(&a.ratio()));
    moves
}

fn problem(
    suite: &str,
    old: &RankingDocument,
    new: &RankingDocument,
    tolerance: f64,
) -> Vec<CheapestMove> {
    let place =
        if old.problem.is_empty() { suite.to_owned() } else { format!("{suite}, {}", old.problem) };
    let same = |target: &JsonNumber| new.targets.iter().position(|other| other == target);
    let targets = old.targets.iter().enumerate();
    let pairs = targets.filter_map(|(k, target)| Some((target.0, k, same(target)?)));
    let moves = pairs.map(|(target, k, m)| CheapestMove {
        place: place.clone(),
        target,
        old: cheapest(old, k),
        new: cheapest(new, m),
    });
    moves
        .filter(|found| match (&found.old, &found.new) {
            (None, None) => false,
            (Some(_), Some(_)) => ratio_moved(found.ratio(), tolerance),
            _ => true,
        })
        .collect()
}

/// The least work for the target with this index, and the method that needs no more.
fn cheapest(ranking: &RankingDocument, target: usize) -> Option<(f64, String)> {
    let reached = ranking.methods.iter().filter_map(|method| {
        let reached = method.reached.get(target)?.as_ref()?;
        Some((reached.work.0, method.name.clone()))
    });
    let finite = reached.filter(|(work, _)| work.is_finite());
    finite.reduce(|least, one| if one.0 < least.0 { one } else { least })
}
