//! Formats the cost of a step as rows for reports and `explain`, and as tables of all methods:
//! active loads and other effects, passes over particles and nodes, visited particles, and memory.

use super::prose::{hanging, paragraph_lines};
use crate::subject::{ColumnSize, Holder, Profile};
use crate::verify::{CaseOutcome, SuiteOutcome, grouped};
use std::collections::{BTreeMap, BTreeSet};

/// Describes a profile in rows of name and text.
pub fn profile(profile: &Profile) -> Vec<(&'static str, String)> {
    vec![
        ("effects", effects(profile, "none")),
        ("a step", profile.passes.join(", ")),
        ("particle visits", visits(profile)),
        ("particle memory", memory(profile, Holder::Particle)),
        ("node memory", memory(profile, Holder::Node)),
    ]
}

/// Lists the names of the active effects, or returns the text `none` if no effect is active.
pub(crate) fn effects(profile: &Profile, none: &str) -> String {
    if profile.effects.is_empty() { none.to_owned() } else { profile.effects.join(", ") }
}

/// Lists each row of the first profile that differs, followed by the row of the second.
pub fn difference(with: &Profile, without: &Profile) -> Vec<(&'static str, String)> {
    let rows = profile(with).into_iter().zip(profile(without));
    let changed = rows.filter(|((_, before), (_, after))| before != after);
    changed.flat_map(|((key, before), (_, after))| [(key, before), ("  becomes", after)]).collect()
}

/// Lists how many particles each part of a step visits:
/// `p2g mass, p2g momentum x 2, p2g point force at 4 of 20 particles`.
fn visits(profile: &Profile) -> String {
    let particles = profile.particles as u64;
    let part = |&(name, visited): &(&str, u64)| match visited.checked_div(particles) {
        Some(1) if visited % particles == 0 => name.to_owned(),
        Some(times) if visited % particles == 0 => format!("{name} x {times}"),
        _ => format!("{name} at {visited} of {particles} particles"),
    };
    profile.visits.iter().map(part).collect::<Vec<_>>().join(", ")
}

/// Lists the memory per particle or node: `168 B: X 16, x 16, ...`, shorter columns last.
fn memory(profile: &Profile, holder: Holder) -> String {
    let holders = profile.holders(holder);
    let [whole, partial] = columns_of(profile, holder);
    let mut texts = vec![format!("{} B", whole.iter().map(|column| column.bytes).sum::<usize>())];
    let listed: Vec<String> =
        whole.iter().map(|column| format!("{} {}", column.name, column.bytes)).collect();
    if !listed.is_empty() {
        texts.push(format!(": {}", listed.join(", ")));
    }
    for column in partial {
        let ColumnSize { name, entries, bytes, .. } = column;
        texts.push(format!("; {name} {bytes} at {entries} of {holders}"));
    }
    texts.concat()
}

const HOW_TO_READ: &str = "For each dimension, the rows below a method have the bytes of a particle \
    and of a node, the number of times that a step visits a particle, and the effects. The number \
    after + has the further bytes where an effect acts. The tables that follow list the columns \
    behind these bytes and the passes of a step. The report of a suite lists the effects of its \
    scene.";

/// Returns the report of the profiles of all cases.
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

/// Computes the number of dimensions from the size of positions in the profile.
fn dimension(profile: &Profile) -> usize {
    let position = profile.columns.iter().find(|column| column.name == "X");
    position.map_or(0, |column| column.bytes / size_of::<f64>())
}

fn named(case: &CaseOutcome, keys: &[&str]) -> String {
    let words: Vec<&str> = keys.iter().filter_map(|key| case.setting(key)).collect();
    if words.is_empty() { case.subject.to_owned() } else { words.join(" ") }
}

/// Returns the distinct combinations of memory, visits and effects below the methods that have
/// these combinations. Rows have fixed widths, so that a new method changes no other row.
fn rows(cases: &[&CaseOutcome]) -> Vec<String> {
    let row = |case: &&CaseOutcome| {
        let profile = case.profile.as_ref()?;
        let memory = |holder| match bytes(profile, holder) {
            [every, 0] => every.to_string(),
            [every, acting] => format!("{every}+{acting}"),
        };
        let visits: u64 = profile.visits.iter().map(|(_, visited)| visited).sum();
        let visits = visits / (profile.particles as u64).max(1);
        let (particle, node) = (memory(Holder::Particle), memory(Holder::Node));
        let text = format!("    {particle:8} {node:7} {visits:3}  {}", effects(profile, "nothing"));
        Some((named(case, &["basis", "transfer", "scheme", "mass matrix"]), text))
    };
    let mut methods: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for (method, row) in cases.iter().filter_map(row) {
        methods.entry(method).or_default().insert(row);
    }
    let mut lines = Vec::new();
    for (rows, methods) in grouped(methods.into_iter().map(|(method, rows)| (rows, method))) {
        hanging(&mut lines, "-", &methods.join("; "));
        lines.extend(rows);
    }
    lines
}

/// Returns the bytes of full columns, and the bytes of the other columns.
fn bytes(profile: &Profile, holder: Holder) -> [usize; 2] {
    columns_of(profile, holder).map(|columns| columns.iter().map(|column| column.bytes).sum())
}

/// Returns the columns with an entry for each particle or node, and the other columns.
fn columns_of(profile: &Profile, holder: Holder) -> [Vec<&ColumnSize>; 2] {
    let columns = profile.columns.iter().filter(|column| column.holder == holder);
    columns.partition::<Vec<_>, _>(|column| column.entries == profile.holders(holder)).into()
}

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

/// Lists the passes, with the visited particles, and the methods and effects that use them.
fn passes(lines: &mut Vec<String>, cases: &[&CaseOutcome]) {
    type Methods<'a> = BTreeMap<String, BTreeSet<&'a str>>;
    let mut found: BTreeMap<String, BTreeMap<String, Methods<'_>>> = BTreeMap::new();
    for case in cases {
        let Some(profile) = &case.profile else { continue };
        let visits: Vec<&str> = profile.visits.iter().map(|(name, _)| *name).collect();
        let method = named(case, &["transfer", "scheme", "mass matrix"]);
        let of_passes = found.entry(profile.passes.join(", ")).or_default();
        let of_visits = of_passes.entry(visits.join(", ")).or_default();
        of_visits.entry(method).or_default().extend(&profile.effects);
    }
    let method = |(method, effects): (&String, &BTreeSet<&str>)| {
        let effects: Vec<&str> = effects.iter().copied().collect();
        if effects.is_empty() {
            method.clone()
        } else {
            format!("{method} ({})", effects.join(", "))
        }
    };
    for (passes, by_visits) in &found {
        hanging(lines, "-", passes);
        for (visits, methods) in by_visits {
            let methods: Vec<String> = methods.iter().map(method).collect();
            hanging(lines, "", &format!("visits: {visits}. Of {}", methods.join("; ")));
        }
    }
}
