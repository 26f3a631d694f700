//! `mpm-verify diagnose`: determines why a case does not have the theoretical order.

use super::arguments::{FormatArgs, SolverArgs, Targets, seconds};
use super::output::{CommandError, Status};
use super::{output, select, solver};
use clap::Args;
use mpm_verify::external::SolverFactory;
use mpm_verify::suite::Suite;
use mpm_verify::suite::yaml::Source;
use mpm_verify::{report, study};
use serde_json::{Value, json};

#[derive(Debug, Args)]
pub(super) struct DiagnoseArgs {
    #[command(flatten)]
    targets: Targets,
    /// Diagnose only cases whose name contains this text
    #[arg(long, value_name = "TEXT", default_value = "")]
    case: String,
    /// Budget for the runs of each case, in predicted time: `30s`, `2min`
    #[arg(long, value_name = "TIME", value_parser = seconds, allow_hyphen_values = true, default_value = "60s")]
    budget: f64,
    #[command(flatten)]
    format: FormatArgs,
    #[command(flatten)]
    solver: SolverArgs,
}

pub(super) fn diagnose(args: &DiagnoseArgs) -> Result<Status, CommandError> {
    if args.targets.targets.is_empty() {
        let message = "expected a suite, because to diagnose all suites takes more than ten minutes\n\
                       help: `mpm-verify diagnose vibrating-bar`; `mpm-verify list` lists all suites";
        return Err(CommandError::Message(message.to_owned()));
    }
    let solver = solver::greeted(&args.solver)?;
    let solver = solver.as_ref().map(|solver| solver as &dyn SolverFactory);
    let mut all = Diagnoses { args, solver, code: Status::Passed, diagnosed: 0, json: Vec::new() };
    for found in select::with_sources(&args.targets.targets) {
        match found.map(|(source, suite)| (source, solver::in_place_of_methods(suite, solver))) {
            Ok((source, Some(suite))) => all.suite(&source, &suite),
            Ok((_, None)) => {}
            Err(diagnostic) => {
                output::diagnose(&diagnostic);
                all.code = Status::BadInput;
            }
        }
    }
    if args.format.is_json() {
        output::print(&format!("{:#}\n", json!({"cases": all.json})));
    } else if all.diagnosed > 0 {
        output::print(&format!("{} diagnosed\n", report::counted(all.diagnosed, "case")));
    }
    if solver.is_some() && all.diagnosed == 0 && all.code == Status::Passed {
        let message = "no case is applicable to the solver";
        return Err(CommandError::Message(message.to_owned()));
    }
    Ok(all.code)
}

struct Diagnoses<'a> {
    args: &'a DiagnoseArgs,
    solver: Option<&'a dyn SolverFactory>,
    code: Status,
    diagnosed: usize,
    json: Vec<Value>,
}

impl Diagnoses<'_> {
    fn suite(&mut self, source: &Source, suite: &Suite) {
        let names = suite.case_names().into_iter().enumerate();
        for (index, case) in names.filter(|(_, case)| case.contains(self.args.case.as_str())) {
            let name = format!("{}::{case}", suite.name);
            let lacks = self.solver.map_or(Vec::new(), |solver| study::lacking(suite, solver));
            if !lacks.is_empty() {
                let lacks = lacks.join(", ");
                output::complain(&format!(
                    "note: {name} is not applicable: the solver lacks {lacks}"
                ));
                continue;
            }
            match study::diagnose(suite, source, index, self.args.budget, self.solver) {
                Ok(Some(found)) => {
                    self.diagnosed += 1;
                    if self.args.format.is_json() {
                        let mut case = report::diagnosis_json(&found);
                        case["suite"] = suite.name.clone().into();
                        self.json.push(case);
                    } else {
                        let page = report::diagnosis(&found);
                        output::print(&format!("{}\n{page}\n", suite.name));
                    }
                }
                Ok(None) => {
                    self.diagnosed += 1;
                    output::complain(&format!("note: {name} has no observed order to explain"));
                }
                Err(reason) => {
                    output::complain(&format!("error: {name}: {reason}"));
                    self.code = Status::BadInput;
                }
            }
        }
    }
}
