//! Warnings and notes about a suite before anything runs, each with its place.
//!
//! ```text
//! subject      the study, and places in its file
//! extremes     the exact motion on a raster: strain, speed, reach
//! levels       levels that can count for an order
//! time_step    steps beyond the stable one, and steps that do not follow the cells
//! reach        a motion that leaves the grid
//! strain       a solution of small strain or of a linearised law, and where its error shows
//! precision    a solver that computes in single precision
//! floor        an error that no refinement lowers, and where it shows
//! linearised   a tolerance for a linearised solution that is larger than it needs
//! alignment    interfaces and loaded faces inside a cell
//! end_on_node  a box whose last particles start on nodes, with linear functions
//! undamped     an equilibrium in which nothing removes energy
//! cost         seconds and memory
//! ```
//!
//! A rule speaks of what its suite claims: a suite that only bounds an error is not told that its
//! levels are too few for an order.

pub(crate) mod alignment;
pub(crate) mod cost;
pub(crate) mod end_on_node;
pub(crate) mod extremes;
pub(crate) mod floor;
pub(crate) mod levels;
pub(crate) mod linearised;
pub(crate) mod precision;
pub(crate) mod reach;
pub(crate) mod strain;
pub(crate) mod subject;
pub(crate) mod time_step;
pub(crate) mod undamped;

pub(crate) use cost::UNKNOWN;
pub use cost::{Estimate, estimate, estimates, unit_seconds};

use self::subject::Preflight;
use crate::suite::model::{ConvergencePlan, Suite};
use crate::suite::yaml::{Diagnostic, Source};

/// Findings of one rule.
type PreflightRule = fn(&Preflight<'_>) -> Vec<Diagnostic>;

/// Every rule of suites that claim an order.
const RULES_OF_ORDER: [PreflightRule; 6] = [
    levels::check,
    time_step::check,
    reach::check,
    strain::check,
    precision::check,
    alignment::check,
];

/// Every rule of all suites.
const RULES: [PreflightRule; 3] = [linearised::check, end_on_node::check, undamped::check];

/// Warnings and notes about `suite`, read from `source`; none about studies that refine nothing.
pub fn preflight(suite: &Suite, source: &Source) -> Vec<Diagnostic> {
    let Some(plan) = suite.plan::<ConvergencePlan>() else { return Vec::new() };
    let preflight = Preflight::new(plan, source);
    let of_order = RULES_OF_ORDER.iter().filter(|_| preflight.claims_an_order());
    of_order.chain(&RULES).flat_map(|rule| rule(&preflight)).collect()
}
