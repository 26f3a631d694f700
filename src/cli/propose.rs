//! `mpm-verify propose`: proposes entries of `expect` that agree with the results of a run.

use super::arguments::{FormatArgs, SolverArgs, Targets};
use super::output::{CommandError, Status};
use super::{output, select, show, solver};
use clap::Args;
use mpm_verify::external::SolverFactory;
use mpm_verify::report;
use mpm_verify::study::{Runner, preflight, under};
use mpm_verify::suite::Suite;
use mpm_verify::suite::yaml::Source;
use serde_json::json;

#[derive(Debug, Args)]
pub(super) struct ProposeArgs {
    #[command(flatten)]
    targets: Targets,
    /// Propose only for cases whose name contains this text
    #[arg(long, value_name = "TEXT")]
    case: Option<String>,
    #[command(flatten)]
    format: FormatArgs,
    #[command(flatten)]
    solver: SolverArgs,
}

pub(super) fn propose(args: &ProposeArgs) -> Result<Status, CommandError> {
    let case = args.case.as_deref();
    let solver = solver::greeted(&args.solver)?;
    let suites = select::with_sources(&args.targets.targets);
    let solver = solver.as_ref().map(|solver| solver as &dyn SolverFactory);
    if args.format.is_json() {
        return Ok(show::json(suites, |source, suite| {
            Ok(json!({"suite": suite.name, "yaml": of_suite(source, suite, solver, case)?}))
        }));
    }
    let status = show::try_each(suites, |source, suite| of_suite(source, suite, solver, case));
    if status == Status::Passed {
        let next = "# next: copy entries into `expect` of the suite, then mpm-verify check SUITE\n";
        output::print(next);
    }
    Ok(status)
}

fn of_suite(
    source: &Source,
    suite: &Suite,
    solver: Option<&dyn SolverFactory>,
    case: Option<&str>,
) -> Result<String, CommandError> {
    let name = &suite.name;
    let looks_inside =
        || CommandError::about(name, "it examines the internals of the built-in methods");
    let suite = match solver {
        None => suite,
        Some(solver) => &under(suite, solver, false).ok_or_else(looks_inside)?,
    };
    let exploring = suite.without_expectations().ok_or_else(|| {
        CommandError::about(name, "expectations are proposed for convergence studies only")
    })?;
    let names = exploring.case_names();
    let is_chosen = |name: &str| case.is_none_or(|text| name.contains(text));
    if !names.iter().any(|name| is_chosen(name)) {
        return Err(CommandError::about(name, "no case name contains the text of `--case`"));
    }
    let exploring = exploring.only(&|index| is_chosen(names[index]));
    let runner = Runner::new(&exploring);
    let outcome = match solver {
        Some(solver) => runner.judging(solver),
        None => runner,
    }
    .run(&|| ());
    if let Some(refused) = outcome.cases.iter().find(|case| case.study.is_none()) {
        return Err(CommandError::about(format_args!("{name}::{}", refused.case), &refused.reason));
    }
    // An expectation cannot correct the wrong amplitude, grid or time step that `check` reports.
    let found = preflight(&exploring, source);
    let remarks = found.iter().map(|found| {
        let help = found.help().map(|help| format!("; {help}"));
        format!("{}{}", found.message(), help.unwrap_or_default())
    });
    let method = solver.map(|solver| {
        let entry = format!("- external: {{name: {}}}", solver.name());
        format!("for a suite that lists `{entry}` under `methods`")
    });
    let remarks = method.into_iter().chain(remarks);
    Ok(format!("# {name}\n{}", report::proposals(&outcome, remarks)))
}
