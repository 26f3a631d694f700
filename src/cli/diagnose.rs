//! `mpm-verify diagnose`: why cases do not have the order of theory.

use super::args::DiagnoseArgs;
use super::status::{BAD_INPUT, PASSED};
use super::{output, select};
use mpm_verify::report;
use mpm_verify::study;
use serde_json::json;

/// Prints the finding on each case that is named.
pub(super) fn diagnose(args: &DiagnoseArgs) -> u8 {
    let (mut code, mut cases) = (PASSED, Vec::new());
    for found in select::with_sources(&args.targets.targets) {
        let (source, suite) = match found {
            Ok(found) => found,
            Err(diagnostic) => {
                output::diagnose(&diagnostic);
                code = BAD_INPUT;
                continue;
            }
        };
        for (index, case) in suite.case_names().into_iter().enumerate() {
            if !case.contains(args.case.as_str()) {
                continue;
            }
            let name = format!("{}::{case}", suite.name);
            match study::diagnose(&suite, &source, index, args.budget) {
                Ok(Some(found)) if args.format.is_json() => {
                    let mut case = report::diagnosis_json(&found);
                    case["suite"] = suite.name.clone().into();
                    cases.push(case);
                }
                Ok(Some(found)) => {
                    output::print(&format!("{}\n{}\n", suite.name, report::diagnosis(&found)));
                }
                Ok(None) => output::complain(&format!("note: {name} has no order to explain")),
                Err(reason) => {
                    output::complain(&format!("error: {name}: {reason}"));
                    code = BAD_INPUT;
                }
            }
        }
    }
    if args.format.is_json() {
        output::print(&format!("{:#}\n", json!({"cases": cases})));
    }
    code
}
