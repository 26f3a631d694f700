//! `mpm-verify propose`: entries of `expect` that a run supports.

use super::show;
use mpm_verify::report;
use mpm_verify::study::Runner;
use mpm_verify::suite::Suite;
use std::path::PathBuf;

/// Runs each suite as if it expected nothing, and prints what it could expect.
pub(super) fn propose(targets: &[PathBuf]) -> u8 {
    show::try_each(targets, of_suite)
}

fn of_suite(suite: &Suite) -> Result<String, String> {
    let name = &suite.name;
    let exploring = suite.without_expectations().ok_or_else(|| {
        format!("error: {name}: expectations are proposed for convergence studies only")
    })?;
    let outcome = Runner::new(&exploring).run(&|| ());
    if let Some(refused) = outcome.cases.iter().find(|case| case.study.is_none()) {
        return Err(format!("error: {name}::{}: {}", refused.case, refused.reason));
    }
    Ok(format!("# {name}\n{}", report::proposals(&outcome)))
}
