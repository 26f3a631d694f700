//! `mpm-verify propose`: entries of `expect` that a run supports.

use super::args::ProposeArgs;
use super::show;
use mpm_verify::report;
use mpm_verify::study::{Runner, preflight};
use mpm_verify::suite::Suite;
use mpm_verify::suite::yaml::Source;
use serde_json::json;

/// Runs each suite as if it expected nothing, and prints what it could expect.
pub(super) fn propose(args: &ProposeArgs) -> u8 {
    let targets = &args.targets.targets;
    if args.format.is_json() {
        return show::json(targets, |source, suite| {
            Ok(json!({"suite": suite.name, "yaml": of_suite(source, suite)?}))
        });
    }
    show::try_each(targets, of_suite)
}

fn of_suite(source: &Source, suite: &Suite) -> Result<String, String> {
    let name = &suite.name;
    let exploring = suite.without_expectations().ok_or_else(|| {
        format!("error: {name}: expectations are proposed for convergence studies only")
    })?;
    let outcome = Runner::new(&exploring).run(&|| ());
    if let Some(refused) = outcome.cases.iter().find(|case| case.study.is_none()) {
        return Err(format!("error: {name}::{}: {}", refused.case, refused.reason));
    }
    // The amplitude, the grid and the steps, which no claim can make up for.
    let found = preflight(&exploring, source);
    let remarks = found.iter().map(|found| {
        let help = found.help().map(|help| format!("; {help}"));
        format!("{}{}", found.message(), help.unwrap_or_default())
    });
    Ok(format!("# {name}\n{}", report::proposals(&outcome, remarks)))
}
