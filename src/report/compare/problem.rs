//! Suites whose problem is another one than before.

use super::changes::ProblemMove;
use super::document::{ReportDocument, SuiteDocument};
use crate::report::grouping::distinct;

/// Rows of a statement that choose levels and figures, which are compared one by one.
const OF_LEVELS: [&str; 7] =
    ["cells", "dt", "instants", "particles", "--full adds", "judged", "crossing levels"];

/// The suites of both runs whose statements differ.
pub(super) fn compare(old: &ReportDocument, new: &ReportDocument) -> Vec<ProblemMove> {
    let moved = |suite: &SuiteDocument| {
        let before = old.suites.iter().find(|known| known.name == suite.name)?;
        let rows = differing(&before.statement, &suite.statement);
        (!rows.is_empty()).then(|| ProblemMove { suite: suite.name.clone(), rows })
    };
    new.suites.iter().filter_map(moved).collect()
}

/// Rows that differ, of two statements; none where one of the two was not kept.
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

/// The values that differ, of two lists of `name = value`.
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
