//! `mpm-verify list`.

use super::args::{Format, ListArgs};
use super::status::{BAD_INPUT, PASSED};
use super::{output, select, show};
use mpm_verify::study::{Estimate, estimates};
use mpm_verify::suite::yaml::Source;
use mpm_verify::suite::{Extent, Suite};
use serde_json::{Value, json};
use std::path::PathBuf;

/// Prints every suite with its cases.
pub(super) fn list(args: &ListArgs) -> u8 {
    let targets = &args.targets.targets;
    if args.format == Format::Json {
        return as_json(targets);
    }
    show::each(targets, |suite| {
        let cases = suite.case_names().join("\n  ");
        format!("{}: {}\n  {cases}\n", suite.name, suite.title)
    })
}

/// Prints one document of all suites that can be loaded, and the complaints about others.
fn as_json(targets: &[PathBuf]) -> u8 {
    let (mut suites, mut code) = (Vec::new(), PASSED);
    for found in select::with_sources(targets) {
        match found {
            Ok((source, suite)) => suites.push(listed(&source, &suite)),
            Err(diagnostic) => {
                output::diagnose(&diagnostic);
                code = BAD_INPUT;
            }
        }
    }
    output::print(&format!("{:#}\n", json!({"suites": suites})));
    code
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
