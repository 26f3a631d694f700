//! Pairs the cases of two runs, and ranks and sorts the changes.

use super::changes::{CheapestMove, Moved, ProblemMove, Rank, ReportComparison, ratio_moved};
use super::document::{
    CaseDocument, JsonNumber, RankingDocument, ReportDocument, SuiteDocument, name,
};
use super::stability::StabilityMove;
use super::{accuracy, stability};
use crate::verify::{JudgedBox, distinct};
use std::collections::BTreeMap;

/// Compares `old` with `new`. Changes by at most the relative `tolerance` are ignored.
pub fn compare(old: &ReportDocument, new: &ReportDocument, tolerance: f64) -> ReportComparison {
    let mut before: BTreeMap<String, &CaseDocument> =
        old.cases().map(|(suite, case)| (name(suite, case), case)).collect();
    let problems = problem_moves(old, new);
    let is_of_another = |suite: &str| problems.iter().any(|problem| problem.suite == suite);
    let mut moved = Vec::new();
    let mut unchanged = 0;
    for (suite, case) in new.cases() {
        let name = name(suite, case);
        match before.remove(&name) {
            None => moved.push(lone(name, Rank::New, case)),
            Some(old) if is_of_another(&suite.name) => {
                moved.push(of_another_problem(name, old, case));
            }
            Some(old) => match pair(name, old, case, tolerance) {
                Some(found) => moved.push(found),
                None => unchanged += 1,
            },
        }
    }
    moved.extend(before.into_iter().map(|(name, case)| lone(name, Rank::Gone, case)));
    moved.sort_by(|a, b| a.rank.cmp(&b.rank).then(b.weight.total_cmp(&a.weight)));
    let cheapest = cheapest_moves(old, new, tolerance, is_of_another);
    ReportComparison { problems, moved, cheapest, unchanged, tolerance }
}

/// Returns the change of a case whose problem has changed, where only `passed` is comparable.
fn of_another_problem(name: String, old: &CaseDocument, new: &CaseDocument) -> Moved {
    let is_broken = old.passed && !new.passed;
    let (rank, notes) = if is_broken {
        (Rank::Broken, new.unmet.clone())
    } else {
        (Rank::OtherProblem, Vec::new())
    };
    Moved { notes, ..both(name, rank, old, new) }
}

/// Returns the change of a case that is in both runs, with its verdicts and orders only.
fn both(name: String, rank: Rank, old: &CaseDocument, new: &CaseDocument) -> Moved {
    Moved {
        verdict: [old, new].map(|case| Some(shown(case))),
        order: [old, new].map(|case| case.observed_order.map(|order| order.value.0)),
        ..lone(name, rank, new)
    }
}

/// Returns the change of a case that is in only one run.
fn lone(name: String, rank: Rank, case: &CaseDocument) -> Moved {
    let word = Some(shown(case));
    let order = case.observed_order.map(|order| order.value.0);
    let (verdict, order) = match rank {
        Rank::New => ([None, word], [None, order]),
        _ => ([word, None], [order, None]),
    };
    Moved { name, rank, verdict, order, error: None, work: None, notes: Vec::new(), weight: 0.0 }
}

/// Returns the verdict, with a mark if the case does not meet its expectations.
fn shown(case: &CaseDocument) -> String {
    if case.passed { case.verdict.clone() } else { format!("{} (FAIL)", case.verdict) }
}

fn pair(name: String, old: &CaseDocument, new: &CaseDocument, tolerance: f64) -> Option<Moved> {
    let comparable = old.judge == new.judge || old.judge.is_none() || new.judge.is_none();
    let common = accuracy::common(old, new);
    let pairs = if comparable { &common[..] } else { &[] };
    let axis = new.axis.as_deref();
    let error =
        accuracy::error(pairs, axis, tolerance).filter(|_| !accuracy::is_rounding(old, new));
    let work = accuracy::work(pairs, tolerance).filter(|work| ratio_moved(*work, tolerance));
    let refined = common.len() < old.levels.len().max(new.levels.len());
    let studies = old.stability.as_ref().zip(new.stability.as_ref());
    let rows = studies.map(|(old, new)| stability::compare(old, new, tolerance));
    let rows = rows.unwrap_or_default();
    let mut found = Moved { error, work, ..both(name, Rank::Otherwise, old, new) };
    let otherwise = otherwise(old, new, comparable, refined, &rows);
    (found.rank, found.weight) = verdict_rank(old, new, &rows)
        .or_else(|| figure_rank(&found, &rows))
        .or_else(|| (!otherwise.is_empty()).then_some((Rank::Otherwise, 0.0)))?;
    if found.rank == Rank::Broken {
        found.notes.extend(new.unmet.iter().cloned());
    }
    found.notes.extend(otherwise);
    found.notes.extend(rows.verdicts);
    found.notes.extend(rows.limits);
    Some(found)
}

fn otherwise(
    old: &CaseDocument,
    new: &CaseDocument,
    comparable: bool,
    refined: bool,
    rows: &StabilityMove,
) -> Vec<String> {
    let mut notes = Vec::new();
    if !comparable {
        let of = |case: &CaseDocument| {
            case.judge.as_ref().map_or_else(String::new, |judge| {
                let scale = judge.scale.map(|scale| format!(", divided by {}", scale.0));
                let within = judge.within.as_ref().map(|within| {
                    let corner = |corner: &[JsonNumber]| corner.iter().map(|x| x.0).collect();
                    let (from, to) = (corner(&within.from), corner(&within.to));
                    format!(" within {}", JudgedBox { from, to }.words())
                });
                let (scale, within) = (scale.unwrap_or_default(), within.unwrap_or_default());
                format!("{} of {}{scale}{within}", judge.norm, judge.of)
            })
        };
        notes.push(format!("judged: {} -> {}", of(old), of(new)));
    }
    if refined {
        let (a, b) = (old.levels.len(), new.levels.len());
        let common = accuracy::common(old, new).len();
        let note = format!("levels: {a} -> {b}, {common} in common");
        // Without common levels, no error is compared, so this note explains the others.
        notes.insert(if common == 0 { 0 } else { notes.len() }, note);
    }
    if rows.lone > 0 || old.stability.is_some() != new.stability.is_some() {
        notes.push("rows of one run only are not compared".to_owned());
    }
    notes
}

/// Returns the kind of change if the verdict or `passed` has changed.
fn verdict_rank(
    old: &CaseDocument,
    new: &CaseDocument,
    rows: &StabilityMove,
) -> Option<(Rank, f64)> {
    let rank = match (old.passed, new.passed) {
        (true, false) => Rank::Broken,
        (false, true) => Rank::BetterVerdict,
        _ => match rows.verdict {
            [true, _] => Rank::WorseVerdict,
            [false, true] => Rank::BetterVerdict,
            [false, false] if old.verdict == new.verdict => return None,
            [false, false] => match severity(&new.verdict).cmp(&severity(&old.verdict)) {
                std::cmp::Ordering::Greater => Rank::WorseVerdict,
                std::cmp::Ordering::Less => Rank::BetterVerdict,
                std::cmp::Ordering::Equal => Rank::OtherVerdict,
            },
        },
    };
    Some((rank, 0.0))
}

/// Returns the severity of a verdict, from 0 (good) to 3 (failed); 1 for verdicts not listed here.
fn severity(verdict: &str) -> u8 {
    match verdict {
        "converging" | "within bounds" | "agrees" | "smooth" => 0,
        "divergent" | "out of bounds" => 2,
        "failed" => 3,
        _ => 1,
    }
}

/// Whether the observed order is lower than before. Smaller errors on the compared levels are then
/// no improvement, because finer grids lose it.
fn order_falls(found: &Moved) -> bool {
    const CHANGE: f64 = 0.05;
    matches!(found.order, [Some(old), Some(new)] if old - new > CHANGE)
}

/// Returns the kind and size of a change of errors, work or stability limits.
fn figure_rank(found: &Moved, rows: &StabilityMove) -> Option<(Rank, f64)> {
    let (error, work) = (found.error.as_ref(), found.work);
    let size = work.map_or(0.0, |work| libm::log(work).abs());
    match (error, work) {
        (Some(error), _) if error.worse => Some((Rank::LessAccurate, error.weight())),
        _ if rows.limit[0] => Some((Rank::LessStable, rows.weight)),
        (_, Some(work)) if !(work < 1.0) => Some((Rank::MoreExpensive, size)),
        (Some(error), _) if order_falls(found) => Some((Rank::Otherwise, error.weight())),
        (Some(error), _) => Some((Rank::Better, error.weight())),
        (None, Some(_)) => Some((Rank::Better, size)),
        (None, None) if rows.limit[1] => Some((Rank::Better, rows.weight)),
        (None, None) => None,
    }
}

/// Names of the rows about levels and outputs in the description of a problem. Differences in these
/// rows are not changes of the problem. Older documents have `--full adds` instead of
/// `further levels`. Names read from snapshots have only one word.
const OF_LEVELS: [&str; 11] = [
    "cells",
    "dt",
    "instants",
    "particles",
    "further levels",
    "further",
    "--full adds",
    "--full",
    "judged",
    "crossing levels",
    "crossing",
];

fn problem_moves(old: &ReportDocument, new: &ReportDocument) -> Vec<ProblemMove> {
    let moved = |suite: &SuiteDocument| {
        let before = old.suites.iter().find(|known| known.name == suite.name)?;
        let rows = differing(&before.statement, &suite.statement);
        (!rows.is_empty()).then(|| ProblemMove { suite: suite.name.clone(), rows })
    };
    new.suites.iter().filter_map(moved).collect()
}

/// Returns the rows that differ between two descriptions; none if one was not stored.
fn differing(old: &[(String, String)], new: &[(String, String)]) -> Vec<[String; 3]> {
    if old.is_empty() || new.is_empty() {
        return Vec::new();
    }
    let keys = distinct(old.iter().chain(new).map(|(key, _)| key));
    let keys = keys.into_iter().filter(|key| !OF_LEVELS.contains(&key.as_str()));
    let of = |rows: &[(String, String)], key: &String| {
        let values = rows.iter().filter(|(known, _)| known == key).map(|(_, value)| value.as_str());
        let values: Vec<&str> = values.collect();
        if values.is_empty() { "nothing".to_owned() } else { values.join("; ") }
    };
    let rows = keys.map(|key| (key.clone(), of(old, key), of(new, key)));
    let moved = rows.filter(|(_, old, new)| old != new);
    let row = |(key, old, new): (String, String, String)| {
        let [old, new] = shortened(&old, &new).unwrap_or([old, new]);
        [key, old, new]
    };
    moved.map(row).collect()
}

/// Reduces two lists of `name = value` to the values that differ.
fn shortened(old: &str, new: &str) -> Option<[String; 2]> {
    let [old, new] = [old, new].map(|list| list.split(", ").collect::<Vec<&str>>());
    if old.len() != new.len() {
        return None;
    }
    let pairs = old.into_iter().zip(new).filter(|(old, new)| old != new);
    let (old, new): (Vec<&str>, Vec<&str>) = pairs.unzip();
    let is_list = old.iter().chain(&new).all(|part| part.contains(" = "));
    is_list.then(|| [old.join(", "), new.join(", ")])
}

/// Returns the target errors whose minimum work has changed, sorted by decreasing ratio. Targets
/// that are no longer reached come first. Suites with a changed problem are excluded.
///
/// Documents without the key `cost` (work of each method for each target) are not compared.
fn cheapest_moves(
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
            moves.extend(b.into_iter().flat_map(|b| target_moves(&before.name, a, b, tolerance)));
        }
    }
    moves.sort_by(|a, b| b.ratio().total_cmp(&a.ratio()));
    moves
}

fn target_moves(
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
        old: least_work(old, k),
        new: least_work(new, m),
    });
    moves
        .filter(|found| match (&found.old, &found.new) {
            (None, None) => false,
            (Some(_), Some(_)) => ratio_moved(found.ratio(), tolerance),
            _ => true,
        })
        .collect()
}

/// Returns the minimum work for the target with this index, and the first method with this work.
fn least_work(ranking: &RankingDocument, target: usize) -> Option<(f64, String)> {
    let reached = ranking.methods.iter().filter_map(|method| {
        let reached = method.reached.get(target)?.as_ref()?;
        Some((reached.work.0, method.name.clone()))
    });
    let finite = reached.filter(|(work, _)| work.is_finite());
    finite.reduce(|least, one| if one.0 < least.0 { one } else { least })
}
