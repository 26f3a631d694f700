//! Prints information about suites, as one text page for each suite or as one JSON document.

use super::output::{self, CommandError, Status};
use super::select::Found;
use mpm_verify::suite::Suite;
use mpm_verify::suite::yaml::Source;
use serde_json::{Value, json};
use std::cell::RefCell;

/// Prints a page for each suite that can be loaded, and diagnostics for the others.
pub(super) fn each(suites: Vec<Found>, page: impl Fn(&Suite) -> String) -> Status {
    try_each(suites, |_, suite| Ok(page(suite)))
}

/// Prints a page for each suite, or the error if the suite cannot be loaded or `page` fails.
pub(super) fn try_each(
    suites: Vec<Found>,
    mut page: impl FnMut(&Source, &Suite) -> Result<String, CommandError>,
) -> Status {
    let mut code = Status::Passed;
    for found in suites {
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
    suites: Vec<Found>,
    value: impl Fn(&Source, &Suite) -> Result<Value, CommandError>,
) -> Status {
    let values = RefCell::new(Vec::new());
    let code = try_each(suites, |source, suite| {
        values.borrow_mut().push(value(source, suite)?);
        Ok(String::new())
    });
    output::print(&format!("{:#}\n", json!({"suites": values.into_inner()})));
    code
}
