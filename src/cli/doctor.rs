//! `mpm-verify doctor`: finds defects of an external solver.

use super::arguments::{FormatArgs, SolverArgs};
use super::output::{CommandError, Status};
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

pub(super) fn doctor(args: &DoctorArgs) -> Result<Status, CommandError> {
    let program = solver::greeted(&args.solver)?
        .ok_or_else(|| CommandError::Message("expected a solver: `--solver COMMAND`".to_owned()))?;
    let report = examine(&program, &|name| output::complain(&format!("examining: {name}")));
    output::print(&if args.format.is_json() { json(&report) } else { page(&report) });
    Ok(match report.silent {
        Some(_) => Status::BadInput,
        None if report.defects() > 0 => Status::Failed,
        None => Status::Passed,
    })
}

fn json(report: &DoctorReport) -> String {
    // The report contains only names and finite numbers, so the conversion to JSON cannot fail.
    serde_json::to_string_pretty(report).unwrap_or_default() + "\n"
}
