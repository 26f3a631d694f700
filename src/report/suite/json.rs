//! Reports as JSON, an interface for programs.
//!
//! `docs/json.md` has an example of the document, and `docs/columns.md` lists the keys of rows.
//! [`report_schema`](crate::report::report_schema) describes every key. `null` marks a missing
//! value, and numbers that are not finite are the strings `"nan"`, `"inf"` and `"-inf"`. Keys may
//! be added, but are renamed or removed only in a new major version.

use crate::report::json::rankings;
use crate::report::study::KINDS;
use crate::subject::{ColumnSize, Holder, Profile};
use crate::verify::{CaseOutcome, Exemption, SuiteOutcome};
use serde_json::{Value, json};
use std::process::Command;

/// Creates the document for `outcomes`, indented and with a final newline.
pub fn json(outcomes: &[SuiteOutcome]) -> String {
    let suites: Vec<Value> = outcomes.iter().map(suite).collect();
    let version = env!("CARGO_PKG_VERSION");
    format!("{:#}\n", json!({ "version": version, "commit": commit(), "suites": suites }))
}

/// Returns the tested commit from a CI service or git. Uncommitted changes add `-dirty`.
pub(crate) fn commit() -> Option<String> {
    let variable = |name: &&str| std::env::var(name).ok().filter(|commit| !commit.is_empty());
    let from_git = || {
        let arguments = ["describe", "--always", "--dirty", "--abbrev=40", "--exclude=*"];
        let output = Command::new("git").args(arguments).output().ok()?;
        let text = String::from_utf8(output.stdout).ok()?;
        output.status.success().then(|| text.trim().to_owned())
    };
    ["GITHUB_SHA", "CI_COMMIT_SHA"].iter().find_map(variable).or_else(from_git)
}

fn suite(outcome: &SuiteOutcome) -> Value {
    json!({
        "suite": outcome.suite,
        "group": outcome.group,
        "title": outcome.title,
        "source": outcome.source,
        "problem": format!("{:016x}", outcome.meaning),
        "statement": outcome.statement,
        "passed": outcome.passed(),
        "cases": outcome.cases.iter().map(case).collect::<Vec<_>>(),
        "cost": rankings(&crate::verify::by_transfers(&outcome.cases), "transfers"),
    })
}

pub(crate) fn case(outcome: &CaseOutcome) -> Value {
    let mut case = json!({
        "case": outcome.case,
        "subject": outcome.subject,
        "settings": outcome.settings,
        "because": outcome.because,
        "verdict": outcome.verdict,
        "expected": outcome.expected,
        "result": outcome.result().name(),
        "passed": outcome.passed()
            && outcome.lacks.is_empty()
            && outcome.exemption != Some(Exemption::Excepted),
        "lacks": outcome.lacks,
        "reason": outcome.reason,
        "unmet": outcome.unmet.iter().map(|unmet| unmet.text.as_str()).collect::<Vec<_>>(),
        "codes": outcome.unmet.iter().map(|unmet| unmet.code.name()).collect::<Vec<_>>(),
        "profile": outcome.profile.as_ref().map(profile),
    });
    for kind in KINDS {
        if let Value::Object(members) = (kind.json)(outcome) {
            members.into_iter().for_each(|(key, value)| case[key] = value);
        }
    }
    case
}

/// Converts the cost of a step to JSON.
pub fn profile(profile: &Profile) -> Value {
    let visit = |(part, particles): &(&str, u64)| json!({"part": part, "particles": particles});
    let column = |column: &ColumnSize| {
        let of = match column.holder {
            Holder::Particle => "particle",
            Holder::Node => "node",
        };
        let ColumnSize { name, entries, bytes, .. } = column;
        json!({"name": name, "of": of, "entries": entries, "bytes": bytes})
    };
    json!({
        "effects": profile.effects,
        "particles": profile.particles,
        "nodes": profile.nodes,
        "passes": profile.passes,
        "visits": profile.visits.iter().map(visit).collect::<Vec<_>>(),
        "columns": profile.columns.iter().map(column).collect::<Vec<_>>(),
    })
}
