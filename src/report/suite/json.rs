//! Reports as JSON, an interface for programs.
//!
//! One document:
//!
//! ```json
//! {"suites": [{"suite": "...", "passed": true, "cases": [{
//!     "case": "...", "subject": "mpm", "axis": "space", "formal_order": 2.0,
//!     "judge": {"of": "displacement", "norm": "rms", "scale": null, "within": null},
//!     "observed_order": {"value": 2.0, "low": 1.9, "high": 2.1},
//!     "verdict": "converging", "expected": "...", "result": "pass", "passed": true,
//!     "reason": "...", "unmet": [], "lacks": [],
//!     "profile": {"effects": ["gravity"], "particles": 20, "nodes": 26,
//!         "passes": ["P2G(mass, momentum)", "G2P(stress)"],
//!         "visits": [{"part": "p2g mass", "particles": 20}],
//!         "columns": [{"name": "v", "of": "particle", "entries": 20, "bytes": 8}]},
//!     "floor": {"cause": "time", "error": 1e-4,
//!         "probes": [{"axis": "time", "error": 5e-5, "failure": null}]},
//!     "levels": [{"cells": 5, "h": 5.0, "spacing": 5.0, "dt": 0.001, "ppc": 4,
//!         "particles": 20, "steps": 500, "transfers": 300000, "crossings": 0, "left_domain": 0,
//!         "min_j": 0.99,
//!         "errors": {"rms": 1e-4, "l1": 1e-4, "l2": 1e-4, "linf": 1e-4, "max_rms": 1e-4},
//!         "judged": 1e-4, "drift": {"mass": 0.0, "momentum": 1e-16, "angular_momentum": 0.0,
//!             "kinetic_energy": 1e-4, "kinetic_energy_gain": 0.0, "energy": 1e-6},
//!         "energy_rate": [-1e-8, -2e-8, 0.0], "residual_speed": null,
//!         "stable_time_step": null, "order": null, "spread": null,
//!         "counts": true, "excluded_by": null, "rounding_bound": null, "failure": null}],
//!     "forces": null, "stability": null}],
//!   "cost": [{"problem": "until t = 0.5 s, compared with the exact solution", "size": 0.05,
//!     "work": "transfers", "targets": [0.01, 0.001, 0.0001], "methods": [{"case": "...",
//!       "reached": [{"work": 130000.0, "at_most": false, "times": 1.0}, null, null],
//!       "best": 5e-3, "not_reached": "floor", "pareto_front": [0, 1],
//!       "exponent": {"value": -1.0, "low": -1.1, "high": -0.9, "theory": -1.0,
//!         "agrees": true}}]}]}]}
//! ```
//!
//! `cost` ranks the methods of each problem of the suite, the cheapest first. Errors are divided by
//! `size`. `reached` contains the work for each of the `targets`; `times` is the ratio of this work
//! to that of the cheapest method. `pareto_front` lists the levels that no other level dominates.
//! `exponent` is k in work ~ error^k.
//!
//! `null` marks a missing value. Numbers that are not finite are the strings `"nan"`, `"inf"`,
//! `"-inf"`.
//!
//! Internal-force studies have no levels; their `forces` are a list of
//! `{"position", "n_left", "n_right", "force", "predicted"}`. Stability studies have no levels
//! either; their `stability` is `{"swept", "sought", "rows"}`. Each row contains the `value` of the
//! swept parameter. It also contains either the `run`, with its verdict and measured values, or the
//! stability limit of the parameter named in `sought`: `predicted`, `observed` (each with `at`, or
//! `above` or `below` the range) and the runs that `confirmed` it.
//!
//! `axis` is the refined axis (`space`, `time`, `particles`) and `spacing` the spacing on this
//! axis. There is no formal order for `particles`. `energy_rate` is d ln E/dt (1/s), followed by
//! both ends of its 95 % interval. For a law without an energy the drift of `energy` is `"nan"`.
//! `stable_time_step` (s) is present if the time step is automatic, or if a given time step is
//! longer than the stable one. `profile` is the cost of one step on the coarsest level, if the
//! solver reports it (MPM). It contains the `passes` in order, the number of particles that each
//! part of the passes `visits`, and the `columns` of memory with the `bytes` of one entry. `floor`
//! contains the error of the finest level with another spacing halved, if such a run exists. Its
//! `cause` is one of the axes, or `none`, or null if the cause could not be determined.
//!
//! Keys may be added, but are renamed or removed only in a new major version. `docs/columns.md`
//! lists the keys of rows.

use crate::report::json::rankings;
use crate::report::study::{KINDS, members};
use crate::subject::{ColumnSize, Holder, Profile};
use crate::verify::{CaseOutcome, Exemption, SuiteOutcome};
use serde_json::{Value, json};

/// Creates the document for `outcomes`, indented and with a final newline.
pub fn json(outcomes: &[SuiteOutcome]) -> String {
    let suites: Vec<Value> = outcomes.iter().map(suite).collect();
    let version = env!("CARGO_PKG_VERSION");
    format!("{:#}\n", json!({ "version": version, "commit": commit(), "suites": suites }))
}

/// Returns the tested commit, if a CI service sets it as an environment variable.
pub(crate) fn commit() -> Option<String> {
    let said = |name: &&str| std::env::var(name).ok().filter(|commit| !commit.is_empty());
    ["GITHUB_SHA", "CI_COMMIT_SHA"].iter().find_map(said)
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
    let mut members = members(json!({
        "case": outcome.case,
        "subject": outcome.subject,
        "settings": outcome.settings,
        "because": outcome.because,
        "verdict": outcome.verdict,
        "expected": outcome.expected,
        "result": outcome.result(),
        "passed": outcome.passed()
            && outcome.lacks.is_empty()
            && outcome.exemption != Some(Exemption::Excepted),
        "lacks": outcome.lacks,
        "reason": outcome.reason,
        "unmet": outcome.unmet,
        "profile": outcome.profile.as_ref().map(profile),
    }));
    members.extend(KINDS.iter().flat_map(|kind| kind.json(outcome)));
    members.into()
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
