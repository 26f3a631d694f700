//! Reports of a suite as text, JSON and figures, for any kind of study.

pub(crate) mod json;
pub(crate) mod overview;
pub(crate) mod text;
pub(crate) mod verdicts;

use super::figure::{Figure, cost};
use super::study::KINDS;
use crate::verify::{self, SuiteOutcome};

/// Suite whose figure represents a run with many suites.
const PLOTTED: &str = "vibrating-bar";

/// Returns the suite whose figure represents a run: `vibrating-bar`, or the last one without it.
pub fn plotted<'a>(
    mut outcomes: impl Iterator<Item = &'a SuiteOutcome> + Clone,
) -> Option<&'a SuiteOutcome> {
    let last = outcomes.clone().last();
    outcomes.find(|outcome| outcome.suite == PLOTTED).or(last)
}

/// Draws the figures of the kind of study of a suite, and diagrams of error against work.
pub fn svg(outcome: &SuiteOutcome) -> Vec<Figure> {
    let mut figures: Vec<Figure> = KINDS.iter().flat_map(|kind| (kind.figures)(outcome)).collect();
    let rankings = verify::by_transfers(&outcome.cases);
    let work = "particle-node transfers";
    figures.extend(cost::cost_figures(outcome, &rankings, work, "transfers"));
    figures
}
