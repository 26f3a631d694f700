//! The figures of a suite.

use super::cost;
use super::drawing::Figure;
use crate::report::study::KINDS;
use crate::report::text::cost::by_transfers;
use crate::verify::SuiteOutcome;

/// Every figure of a suite: those of its kind of study, and error against work.
pub fn svg(outcome: &SuiteOutcome) -> Vec<Figure> {
    let mut figures: Vec<Figure> = KINDS.iter().flat_map(|kind| kind.figures(outcome)).collect();
    let (rankings, work) = (by_transfers(outcome), "particle-node transfers");
    figures.extend(cost::cost_figures(outcome, &rankings, work, "transfers"));
    figures
}
