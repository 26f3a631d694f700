//! Memory and passes of a step, of all methods with all effects that suites put to them.

use super::profile::effects;
use super::prose::{hanging, paragraph_lines};
use super::table::Table;
use crate::subject::{Holder, Profile};
use crate::verify::{CaseOutcome, SuiteOutcome};
use std::collections::{BTreeMap, BTreeSet};

const HOW_TO_READ: &str = "For each dimension: a row for each method and what its scenes list, \
    with the bytes of a particle and of a node, the bytes that are kept where something acts only, \
    and how often a step visits a particle; then the columns behind the bytes, and the passes of a \
    step. A suite's report says which effects its scene lists.";

/// The profiles of all cases.
pub fn profiles(outcomes: &[SuiteOutcome]) -> String {
    let mut lines = vec!["Memory and passes of a step".to_owned(), String::new()];
    paragraph_lines(&mut lines, HOW_TO_READ);
    let cases = || outcomes.iter().flat_map(|suite| &suite.cases);
    for dimension in 1..=3 {
        let known = |case: &'_ CaseOutcome| {
            case.profile.as_ref().is_some_and(|profile| self::dimension(profile) == dimension)
        };
        let of_dimension: Vec<&CaseOutcome> = cases().filter(|case| known(case)).collect();
        if !of_dimension.is_empty() {
            lines.extend([String::new(), format!("== {dimension}-D =="), String::new()]);
            lines.extend(rows(&of_dimension));
            columns(&mut lines, &of_dimension);
        }
    }
    lines.extend([String::new(), "== passes of a step ==".to_owned(), String::new()]);
    passes(&mut lines, &cases().collect::<Vec<_>>());
    lines.join("\n") + "\n"
}

/// The dimension of the positions that a profile keeps.
fn dimension(profile: &Profile) -> usize {
    let position = profile.columns.iter().find(|column| column.name == "X");
    position.map_or(0, |column| column.bytes / size_of::<f64>())
}

fn named(case: &CaseOutcome, keys: &[&str]) -> String {
    let words: Vec<&str> = keys.iter().filter_map(|key| case.setting(key)).collect();
    if words.is_empty() { case.subject.to_owned() } else { words.join(" ") }
}

/// One row for each method and list of effects.
fn rows(cases: &[&CaseOutcome]) -> Vec<String> {
    let headings =
        ["method", "particle", "where it acts", "node", "where it acts", "visits", "effects"];
    let row = |case: &&&CaseOutcome| {
        let profile = case.profile.as_ref()?;
        let [particle, node] =
            [Holder::Particle, Holder::Node].map(|holder| bytes(profile, holder));
        let visits: u64 = profile.visits.iter().map(|(_, visited)| visited).sum();
        let particles = (profile.particles as u64).max(1);
        Some(vec![
            named(case, &["basis", "transfer", "scheme", "mass matrix"]),
            particle[0].to_string(),
            particle[1].to_string(),
            node[0].to_string(),
            node[1].to_string(),
            (visits / particles).to_string(),
            effects(profile, "nothing"),
        ])
    };
    let rows: BTreeSet<Vec<String>> = cases.iter().filter_map(|case| row(&case)).collect();
    let table = Table::of_cells(headings.map(str::to_owned).to_vec(), rows.into_iter().collect());
    table.flush_left(&["effects"]).lines()
}

/// Bytes of a holder: everywhere, and where something acts only.
fn bytes(profile: &Profile, holder: Holder) -> [usize; 2] {
    let whole = profile.holders(holder);
    let of_holder = || profile.columns.iter().filter(|column| column.holder == holder);
    let sum = |is_whole: bool| {
        of_holder()
            .filter(|column| (column.entries == whole) == is_whole)
            .map(|column| column.bytes)
            .sum()
    };
    [sum(true), sum(false)]
}

/// Columns of particles and nodes, with their bytes.
fn columns(lines: &mut Vec<String>, cases: &[&CaseOutcome]) {
    for (holder, mark) in [(Holder::Particle, "particle"), (Holder::Node, "node")] {
        let profiles = cases.iter().filter_map(|case| case.profile.as_ref());
        let columns = profiles.flat_map(|profile| &profile.columns);
        let columns: BTreeSet<(&str, usize)> = columns
            .filter(|column| column.holder == holder)
            .map(|column| (column.name, column.bytes))
            .collect();
        let columns: Vec<String> =
            columns.iter().map(|(name, bytes)| format!("{name} {bytes}")).collect();
        lines.push(String::new());
        hanging(lines, "-", &format!("{mark}: {}", columns.join(", ")));
    }
}

/// Passes, with the methods and effects that have them.
fn passes(lines: &mut Vec<String>, cases: &[&CaseOutcome]) {
    let mut found: BTreeMap<String, BTreeMap<String, BTreeSet<String>>> = BTreeMap::new();
    for case in cases {
        let Some(profile) = &case.profile else { continue };
        let visits: Vec<&str> = profile.visits.iter().map(|(name, _)| *name).collect();
        let passes = format!("{}; visits: {}", profile.passes.join(", "), visits.join(", "));
        let method = named(case, &["transfer", "scheme", "mass matrix"]);
        let of_method = found.entry(passes).or_default().entry(method).or_default();
        of_method.extend(profile.effects.iter().map(|effect| (*effect).to_owned()));
    }
    for (passes, methods) in &found {
        let method = |(method, effects): (&String, &BTreeSet<String>)| {
            let effects: Vec<&str> = effects.iter().map(String::as_str).collect();
            if effects.is_empty() {
                method.clone()
            } else {
                format!("{method} ({})", effects.join(", "))
            }
        };
        let methods: Vec<String> = methods.iter().map(method).collect();
        hanging(lines, "-", &format!("{passes}. Of {}", methods.join("; ")));
    }
}
