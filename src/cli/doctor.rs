//! `mpm-verify doctor`: what is wrong with a solver of another program.

use super::arguments::{FormatArgs, SolverArgs};
use super::status::{BAD_INPUT, FAILED, PASSED};
use super::{output, solver};
use clap::Args;
use mpm_verify::testing::{DoctorReport, doctor as examine, page};

#[derive(Debug, Args)]
pub(super) struct DoctorArgs {
    #[command(flatten)]
    solver: SolverArgs,
    #[command(flatten)]
    format: FormatArgs,
}

/// Examines the solver that the command line names, and prints what was found.
pub(super) fn doctor(args: &DoctorArgs) -> u8 {
    let program = match solver::greeted(&args.solver) {
        Ok(Some(program)) => program,
        Ok(None) => {
            output::complain("error: expected a solver: `--solver COMMAND`");
            return BAD_INPUT;
        }
        Err(message) => {
            output::complain(&message);
            return BAD_INPUT;
        }
    };
    let report = examine(&program, &|name| output::complain(&format!("examining: {name}")));
    output::print(&if args.format.is_json() { json(&report) } else { page(&report) });
    match report.silent {
        Some(_) => BAD_INPUT,
        None if report.defects() > 0 => FAILED,
        None => PASSED,
    }
}

fn json(report: &DoctorReport) -> String {
    // Names and numbers only: there is nothing that JSON has no word for.
    serde_json::to_string_pretty(report).unwrap_or_default() + "\n"
}
