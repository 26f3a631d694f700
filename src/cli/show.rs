//! `mpm-verify list` and `check`.

use super::status::{BAD_INPUT, PASSED};
use super::{output, select};
use mpm_verify::suite::Suite;
use std::path::PathBuf;

/// Prints every suite with its cases.
pub(super) fn list(targets: &[PathBuf]) -> u8 {
    each(targets, |suite| {
        let cases = suite.case_names().join("\n  ");
        format!("{}: {}\n  {cases}\n", suite.name, suite.title)
    })
}

/// Says of every suite that it is sound, or what is wrong with it.
pub(super) fn check(targets: &[PathBuf]) -> u8 {
    each(targets, |suite| {
        let cases = suite.case_names().len();
        let noun = if cases == 1 { "case" } else { "cases" };
        let gate = if suite.explores() { "; nothing is expected, it is no gate" } else { "" };
        format!("{}: sound, {cases} {noun}{gate}\n", suite.name)
    })
}

/// Prints a page of each suite that can be loaded, and the complaints about others.
pub(super) fn each(targets: &[PathBuf], page: impl Fn(&Suite) -> String) -> u8 {
    let mut code = PASSED;
    for suite in select::suites(targets) {
        match suite {
            Ok(suite) => output::print(&page(&suite)),
            Err(diagnostic) => {
                output::complain(&diagnostic.to_string());
                code = BAD_INPUT;
            }
        }
    }
    code
}
