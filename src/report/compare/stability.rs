//! Compares the stability studies of two runs, row by row.

use super::changes::ratio_moved;
use super::document::{JsonNumber, LimitDocument, StabilityDocument, StabilityRowDocument};

#[derive(Debug, Default)]
pub(super) struct StabilityMove {
    /// Descriptions of rows with a changed verdict.
    pub(super) verdicts: Vec<String>,
    /// Whether any verdict is worse, and whether any verdict is better.
    pub(super) verdict: [bool; 2],
    /// Descriptions of rows with a changed limit.
    pub(super) limits: Vec<String>,
    /// Whether any limit is lower, and whether any limit is higher.
    pub(super) limit: [bool; 2],
    /// Largest `|ln(new limit/old limit)|` of all rows.
    pub(super) weight: f64,
    /// Number of rows that are in only one run.
    pub(super) lone: usize,
}

/// Compares rows with the same value of the swept parameter.
pub(super) fn compare(
    old: &StabilityDocument,
    new: &StabilityDocument,
    tolerance: f64,
) -> StabilityMove {
    let mut found = StabilityMove::default();
    if (&old.swept, &old.sought) != (&new.swept, &new.sought) {
        found.lone = old.rows.len() + new.rows.len();
        return found;
    }
    let bits = |row: &StabilityRowDocument| row.value.0.to_bits();
    let pairs: Vec<_> = old
        .rows
        .iter()
        .filter_map(|a| Some((a, new.rows.iter().find(|b| bits(a) == bits(b))?)))
        .collect();
    found.lone = (old.rows.len() - pairs.len()) + new.rows.len().saturating_sub(pairs.len());
    for (a, b) in pairs {
        let place = format!("{} = {}", old.swept, a.value.0);
        found.trial(&place, a, b);
        found.limit(&place, limit(a), limit(b), tolerance);
    }
    found
}

fn limit(row: &StabilityRowDocument) -> Option<LimitDocument> {
    row.predicted.or(row.observed)
}

impl StabilityMove {
    fn trial(&mut self, place: &str, old: &StabilityRowDocument, new: &StabilityRowDocument) {
        let word = |row: &StabilityRowDocument| row.run.as_ref().map(|run| run.verdict.clone());
        let (a, b) = (word(old), word(new));
        if a == b {
            return;
        }
        let [a, b] = [a, b].map(|word| word.unwrap_or_else(|| "refused".to_owned()));
        self.verdict[0] |= severity(&b) > severity(&a);
        self.verdict[1] |= severity(&b) < severity(&a);
        self.verdicts.push(format!("{place}: {a} -> {b}").replace('_', " "));
    }

    fn limit(
        &mut self,
        place: &str,
        old: Option<LimitDocument>,
        new: Option<LimitDocument>,
        tolerance: f64,
    ) {
        let (a, b) = (bound(old), bound(new));
        let same_side = side(old) == side(new);
        if same_side && (a.to_bits() == b.to_bits() || !ratio_moved(b / a, tolerance)) {
            return;
        }
        self.limit[0] |= !(b >= a);
        self.limit[1] |= b > a;
        let weight = libm::log(b / a).abs();
        self.weight = self.weight.max(if weight.is_nan() { f64::INFINITY } else { weight });
        self.limits.push(format!("{place}: limit {} -> {}", shown(old), shown(new)));
    }
}

/// Returns the severity of a verdict; larger is worse.
fn severity(word: &str) -> usize {
    let known = ["stable", "bounded_growth", "unstable", "failed", "refused"];
    known.iter().position(|known| *known == word).unwrap_or(known.len())
}

/// Returns the sort key of a limit. `None` is the worst limit.
fn bound(limit: Option<LimitDocument>) -> f64 {
    match limit {
        None => 0.0,
        Some(
            LimitDocument::At(JsonNumber(x))
            | LimitDocument::Above(JsonNumber(x))
            | LimitDocument::Below(JsonNumber(x)),
        ) => x,
    }
}

fn side(limit: Option<LimitDocument>) -> u8 {
    match limit {
        None => 0,
        Some(LimitDocument::Below(_)) => 1,
        Some(LimitDocument::At(_)) => 2,
        Some(LimitDocument::Above(_)) => 3,
    }
}

fn shown(limit: Option<LimitDocument>) -> String {
    match limit {
        None => "none".to_owned(),
        Some(LimitDocument::At(JsonNumber(x))) => format!("{x:.4}"),
        Some(LimitDocument::Above(JsonNumber(x))) => format!("> {x}"),
        Some(LimitDocument::Below(JsonNumber(x))) => format!("< {x}"),
    }
}
