//! `mpm-verify doctor`: finds defects of an external solver.

use super::arguments::{FormatArgs, SolverArgs};
use super::output::{CommandError, Status};
use super::{output, solver};
use clap::Args;
use mpm_verify::testing::{brief_page, doctor as examine, page};

#[derive(Debug, Args)]
pub(super) struct DoctorArgs {
    #[command(flatten)]
    solver: SolverArgs,
    /// Print all examinations with their measured values [default: only those with findings]
    #[arg(long)]
    verbose: bool,
    #[command(flatten)]
    format: FormatArgs,
}

pub(super) fn doctor(args: &DoctorArgs) -> Result<Status, CommandError> {
    let program = solver::greeted(&args.solver)?
        .ok_or_else(|| CommandError::Message("expected a solver: `--solver COMMAND`".to_owned()))?;
    let report = examine(&program, &|name| output::complain(&format!("examining: {name}")));
    match (args.format.is_json(), args.verbose) {
        // The report contains only names and finite numbers, so the conversion cannot fail.
        (true, _) => {
            output::print(&(serde_json::to_string_pretty(&report).unwrap_or_default() + "\n"));
        }
        (false, true) => output::print(&page(&report)),
        (false, false) => output::print(&brief_page(&report)),
    }
    if !args.format.is_json() && report.silent.is_none() {
        let commands = ["doctor --verbose --solver COMMAND", "run --gate --solver COMMAND"];
        let purposes = ["every measured value", "all suites that the solver can run"];
        output::next(commands.into_iter().zip(purposes));
    }
    Ok(match report.silent {
        Some(_) => Status::BadInput,
        None if report.defects() > 0 => Status::Failed,
        None => Status::Passed,
    })
}
