//! Warnings and notes about a suite before anything runs, each with its place.
//!
//! ```text
//! subject      the study, and places in its file
//! grid         levels that can count for an order, a motion that leaves the grid, and a box whose
//!              last particles start on nodes, with linear functions
//! time_step    steps beyond the stable one, and steps that do not follow the cells
//! error_floor  errors that no refinement lowers: small strain, single precision, linearised laws
//! alignment    interfaces and loaded faces inside a cell
//! undamped     an equilibrium in which nothing removes energy
//! cost         seconds and memory
//! ```
//!
//! A rule concerns an expectation: a suite that only bounds an error gets no warning about too few
//! levels for an order. A suite acknowledges intended findings by their names, with `acknowledge`.

pub(crate) mod alignment;
pub(crate) mod cost;
pub(crate) mod error_floor;
pub(crate) mod grid;
pub(crate) mod subject;
pub(crate) mod time_step;
pub(crate) mod undamped;

pub(crate) use cost::UNKNOWN;
pub use cost::{Estimate, estimate, estimates, unit_seconds};

use self::subject::Preflight;
use crate::suite::grammar::WarningName;
use crate::suite::model::{ConvergencePlan, Suite};
use crate::suite::yaml::{Diagnostic, Severity, Source};

/// Findings of one rule.
type PreflightRule = fn(&Preflight<'_>) -> Vec<Diagnostic>;

/// Rules of suites that claim an order, with the names under which suites acknowledge them.
const RULES_OF_ORDER: [(WarningName, PreflightRule); 6] = [
    (WarningName::FewLevels, grid::few_levels),
    (WarningName::TimeStep, time_step::check),
    (WarningName::LeavesGrid, grid::leaves_grid),
    (WarningName::SmallStrain, error_floor::small_strain),
    (WarningName::SinglePrecision, error_floor::single_precision),
    (WarningName::InsideCell, alignment::check),
];

/// Rules of all suites, with their names.
const RULES: [(WarningName, PreflightRule); 3] = [
    (WarningName::LooseTolerance, error_floor::loose_tolerance),
    (WarningName::EndOnNode, grid::end_on_node),
    (WarningName::Undamped, undamped::check),
];

/// A finding. The help of a warning includes the name with which it is acknowledged.
fn with_name(finding: Diagnostic, name: WarningName) -> Diagnostic {
    if finding.severity() != Severity::Warning {
        return finding;
    }
    let acknowledged = format!("if the suite intends this, `acknowledge` `{}`", name.name());
    let help = match finding.help() {
        Some(help) => format!("{help}; {acknowledged}"),
        None => acknowledged,
    };
    finding.with_help(&help)
}

/// Warnings and notes about `suite`, read from `source`, except those that the suite acknowledges;
/// none for studies without refinement.
pub fn preflight(suite: &Suite, source: &Source) -> Vec<Diagnostic> {
    let Some(plan) = suite.plan::<ConvergencePlan>() else { return Vec::new() };
    let preflight = Preflight::new(plan, source);
    let of_order = RULES_OF_ORDER.iter().filter(|_| preflight.claims_an_order());
    let (mut findings, mut used) = (Vec::new(), Vec::new());
    for (name, rule) in of_order.chain(&RULES) {
        let found = rule(&preflight);
        if plan.acknowledged.contains(name) {
            used.extend(found.first().map(|_| *name));
        } else {
            findings.extend(found.into_iter().map(|finding| with_name(finding, *name)));
        }
    }
    findings.extend(preflight.unused_acknowledgements(&used));
    findings
}
