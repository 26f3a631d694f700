//! `mpm-verify list`.

use super::args::ListArgs;
use super::show;
use mpm_verify::study::{Estimate, estimates};
use mpm_verify::suite::yaml::Source;
use mpm_verify::suite::{Extent, Suite};
use serde_json::{Value, json};

/// Prints every suite with its cases.
pub(super) fn list(args: &ListArgs) -> u8 {
    let targets = &args.targets.targets;
    if args.format.is_json() {
        return show::json(targets, |source, suite| Ok(listed(source, suite)));
    }
    show::each(targets, |suite| {
        let cases = suite.case_names().join("\n  ");
        format!("{}: {}\n  {cases}\n", suite.name, suite.title)
    })
}

fn listed(source: &Source, suite: &Suite) -> Value {
    let names = suite.case_names().into_iter();
    let cases = names.zip(estimates(suite, Extent::Usual)).map(|(name, cost)| {
        let figure = |of: fn(Estimate) -> f64| cost.map(of);
        json!({
            "case": name,
            "seconds": figure(|cost| cost.seconds),
            "particle_steps": figure(|cost| cost.particle_steps),
            "bytes": figure(|cost| cost.bytes),
        })
    });
    let cases: Vec<Value> = cases.collect();
    json!({"suite": suite.name, "title": suite.title, "file": source.name(), "cases": cases})
}
