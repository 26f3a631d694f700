//! Prints information about suites, as one text page for each suite or as one JSON document.

use super::output::{CommandError, Status};
use super::{output, select};
use mpm_verify::suite::Suite;
use mpm_verify::suite::yaml::Source;
use serde_json::{Value, json};
use std::cell::RefCell;
use std::path::PathBuf;

/// Prints a page for each suite that can be loaded, and diagnostics for the others.
pub(super) fn each(targets: &[PathBuf], page: impl Fn(&Suite) -> String) -> Status {
    try_each(targets, |_, suite| Ok(page(suite)))
}

/// Prints a page for each suite, or the error if the suite cannot be loaded or `page` fails.
pub(super) fn try_each(
    targets: &[PathBuf],
    page: impl Fn(&Source, &Suite) -> Result<String, CommandError>,
) -> Status {
    let mut code = Status::Passed;
    for found in select::with_sources(targets) {
        let found = found.map_err(CommandError::from);
        match found.and_then(|(source, suite)| page(&source, &suite)) {
            Ok(page) => output::print(&page),
            Err(error) => {
                output::complain(&error.to_string());
                code = Status::BadInput;
            }
        }
    }
    code
}

/// Prints one JSON document with all suites that can be loaded, and diagnostics for the others.
pub(super) fn json(
    targets: &[PathBuf],
    value: impl Fn(&Source, &Suite) -> Result<Value, CommandError>,
) -> Status {
    let suites = RefCell::new(Vec::new());
    let code = try_each(targets, |source, suite| {
        suites.borrow_mut().push(value(source, suite)?);
        Ok(String::new())
    });
    output::print(&format!("{:#}\n", json!({"suites": suites.into_inner()})));
    code
}
