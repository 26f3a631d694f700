//! Pages about suites, one after the other, or all in one JSON document.

use super::status::{BAD_INPUT, PASSED};
use super::{output, select};
use mpm_verify::suite::Suite;
use mpm_verify::suite::yaml::Source;
use serde_json::{Value, json};
use std::cell::RefCell;
use std::path::PathBuf;

/// Prints a page of each suite that can be loaded, and the complaints about others.
pub(super) fn each(targets: &[PathBuf], page: impl Fn(&Suite) -> String) -> u8 {
    try_each(targets, |_, suite| Ok(page(suite)))
}

/// The same with pages that read the file too, and that there may be a complaint about.
pub(super) fn try_each(
    targets: &[PathBuf],
    page: impl Fn(&Source, &Suite) -> Result<String, String>,
) -> u8 {
    let mut code = PASSED;
    for found in select::with_sources(targets) {
        let found = found.map_err(|diagnostic| diagnostic.styled());
        match found.and_then(|(source, suite)| page(&source, &suite)) {
            Ok(page) => output::print(&page),
            Err(message) => {
                output::complain(&message);
                code = BAD_INPUT;
            }
        }
    }
    code
}

/// Prints one document of all suites that can be loaded, and the complaints about others.
pub(super) fn json(
    targets: &[PathBuf],
    value: impl Fn(&Source, &Suite) -> Result<Value, String>,
) -> u8 {
    let suites = RefCell::new(Vec::new());
    let code = try_each(targets, |source, suite| {
        suites.borrow_mut().push(value(source, suite)?);
        Ok(String::new())
    });
    output::print(&format!("{:#}\n", json!({"suites": suites.into_inner()})));
    code
}
