//! `run --gate`: which suites the solver is held to, and whether it passes.

use super::config::SolverConfig;
use crate::cli::args::JudgedSolverArgs;
use crate::cli::{output, solver};
use mpm_verify::external::SolverProgram;
use mpm_verify::suite::Suite;
use mpm_verify::suite::yaml::Diagnostic;
use mpm_verify::verify::{CaseOutcome, Exemption, SuiteOutcome};
use std::collections::BTreeSet;

/// The gate of a run.
pub(super) struct SolverGate {
    /// Suites that the command line names one by one.
    named: BTreeSet<String>,
    /// Whether these may be not applicable.
    allows_not_applicable: bool,
    /// Suites that no external solver can take.
    left_out: Vec<String>,
}

/// The suites with the solver in place of their methods, and the gate if there is one.
///
/// # Errors
/// The first mistake in the configuration file.
pub(super) fn prepare(
    suites: Vec<Suite>,
    program: &SolverProgram,
    args: &JudgedSolverArgs,
    named: impl FnOnce(&[Suite]) -> BTreeSet<String>,
) -> Result<(Vec<Suite>, Option<SolverGate>), Diagnostic> {
    let config = args.solver_config.as_deref().map(|file| SolverConfig::read(file, &suites));
    let config = config.transpose()?.unwrap_or_default();
    let named = if args.gate { named(&suites) } else { BTreeSet::new() };
    let terms = |suite: &Suite| args.gate.then(|| config.terms(suite));
    let (judged, left_out) = solver::suites_of_solver(suites, program, terms);
    let allows_not_applicable = args.allow_not_applicable;
    let gate = args.gate.then_some(SolverGate { named, allows_not_applicable, left_out });
    Ok((judged, gate))
}

impl SolverGate {
    /// Prints the exceptions, and what keeps the solver from passing besides cases that fail;
    /// returns whether nothing does.
    pub(super) fn passes(&self, outcomes: &[SuiteOutcome]) -> bool {
        for (suite, case) in cases(outcomes) {
            if case.exemption == Some(Exemption::Excepted) {
                output::complain(&format!("note: {suite} is excepted: {}", case.reason));
            }
        }
        let is_excepted = |case: &CaseOutcome| case.exemption == Some(Exemption::Excepted);
        if !cases(outcomes).any(|(_, case)| case.is_tested() || is_excepted(case)) {
            output::complain("error: --gate: nothing is required of the solver in any case");
            return false;
        }
        let untested = cases(outcomes).filter(|(_, case)| {
            !case.lacks.is_empty() || case.exemption == Some(Exemption::NotGated)
        });
        let untested = untested.map(|(suite, _)| suite);
        let untested: BTreeSet<&str> =
            untested.chain(self.left_out.iter().map(String::as_str)).collect();
        let untested: Vec<&str> =
            untested.into_iter().filter(|suite| self.named.contains(*suite)).collect();
        if untested.is_empty() || self.allows_not_applicable {
            return true;
        }
        output::complain(&format!(
            "error: --gate: not applicable or not gated: {}; `--allow-not-applicable` accepts this",
            untested.join(", ")
        ));
        false
    }
}

fn cases(outcomes: &[SuiteOutcome]) -> impl Iterator<Item = (&str, &CaseOutcome)> {
    outcomes.iter().flat_map(|suite| suite.cases.iter().map(|case| (suite.suite.as_str(), case)))
}
