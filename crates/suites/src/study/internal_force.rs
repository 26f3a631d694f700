//! The internal-force study: the force on a node while a particle moves past the node.

use crate::study::describe::{Rows, push};
use crate::study::kind::{CaseRunner, PlanRunner, Progress, RunContext, Study};
use crate::suite::compile::internal_force;
use crate::suite::model::{ForceCase, ForceExpectation, ForcePlan};
use crate::suite::scene::numbers::with_unit;
use crate::verify;
use crate::verify::{CaseOutcome, ForceRow, InternalForce, StudyResults, Unmet, UnmetCode};
use std::sync::Arc;

impl Study for ForcePlan {
    fn statement(&self) -> Rows {
        let mut rows = Rows::new();
        push(
            &mut rows,
            "cells",
            &format!("2 of size {} m, with {} particles in each", self.cell, self.ppc),
        );
        push(&mut rows, "particle volume", &format!("{} m", self.volume));
        push(&mut rows, "stress", &format!("{} Pa, uniform", self.stress));
        push(&mut rows, "prediction", &with_unit(self.prediction.source(), "N"));
        rows
    }

    fn runner<'a>(&'a self, context: RunContext<'a>) -> Box<dyn CaseRunner + 'a> {
        Box::new(PlanRunner { plan: self, context })
    }
}

impl CaseRunner for PlanRunner<'_, ForcePlan> {
    fn units(&self) -> u64 {
        self.plan.cases.len() as u64
    }

    fn case(&self, index: usize, progress: Progress<'_>) -> CaseOutcome {
        let outcome = internal_force(self.plan, &self.plan.cases[index]);
        progress();
        outcome
    }
}

fn internal_force(plan: &ForcePlan, case: &ForceCase) -> CaseOutcome {
    let rows = internal_force::rows(plan, case);
    let seen = [ForceExpectation::AgreesWithin(0.0), ForceExpectation::StepsBelow(0.0)];
    let (met, verdict, reason) = match case.expected {
        Some(expected) => judged_force(&rows, expected),
        None => (true, "explored", seen.map(|figure| judged_force(&rows, figure).2).join("; ")),
    };
    let expected = case.expected.map(ForceExpectation::summary);
    let said = expected.as_deref().unwrap_or_default();
    let unmet =
        (!met).then(|| Unmet::new(UnmetCode::ForceDiffers, format!("expected: {said}; {reason}")));
    let settings = vec![("basis".to_owned(), case.basis.name().to_owned())];
    CaseOutcome {
        expected,
        because: case.because.clone(),
        verdict: verdict.to_owned(),
        reason,
        unmet: unmet.into_iter().collect(),
        study: Some(StudyResults::InternalForce(Arc::new(InternalForce { rows }))),
        ..CaseOutcome::new(&case.name, "mpm", settings)
    }
}

/// Returns whether the force meets the expectation, the verdict, and the measured value.
fn judged_force(rows: &[ForceRow], expected: ForceExpectation) -> (bool, &'static str, String) {
    let largest = largest(rows.iter().map(|row| row.predicted));
    match expected {
        ForceExpectation::AgreesWithin(share) => {
            let worst = self::largest(rows.iter().map(|row| row.force - row.predicted)) / largest;
            let met = worst <= share;
            let reason = format!(
                "largest deviation from the prediction {worst:.1e} of the largest predicted \
                 force, over {} positions",
                rows.len()
            );
            (met, if met { "agrees" } else { "differs" }, reason)
        }
        ForceExpectation::StepsBelow(share) => {
            let steps = rows.windows(2).map(|pair| pair[1].force - pair[0].force);
            let worst = self::largest(steps) / largest;
            let met = worst <= share;
            let reason = format!(
                "largest change between neighbouring positions {worst:.3} of the largest \
                 predicted force, over {} positions",
                rows.len()
            );
            (met, if met { "smooth" } else { "jumps" }, reason)
        }
    }
}

/// Returns the largest magnitude; NaN if any value is NaN.
fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.map(f64::abs).fold(0.0, verify::larger)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The largest predicted force is 2e6 or 2e-6 N. A force that is NaN meets no expectation.
    #[test]
    fn deviations_and_changes_are_fractions_of_the_largest_predicted_force() {
        let judged = |unit: f64, force: f64, share: f64| {
            let row = |force, predicted| ForceRow {
                position: 0.5,
                left: 2,
                right: 2,
                force: unit * force,
                predicted: unit * predicted,
            };
            let rows = [row(1.0, 1.0), row(force, -2.0), row(-2.0, -2.0)];
            let wanted =
                [ForceExpectation::AgreesWithin(share), ForceExpectation::StepsBelow(share)];
            wanted.map(|wanted| judged_force(&rows, wanted))
        };
        for unit in [1e-6, 1e6] {
            let [deviation, step] = judged(unit, -1.9, 1.44);
            let text = "of the largest predicted force, over 3 positions";
            let reasons = [
                format!("largest deviation from the prediction 5.0e-2 {text}"),
                format!("largest change between neighbouring positions 1.450 {text}"),
            ];
            assert_eq!((deviation.0, deviation.1, &deviation.2), (true, "agrees", &reasons[0]));
            assert_eq!((step.0, step.1, &step.2), (false, "jumps", &reasons[1]));
            assert_eq!(judged(unit, -1.9, 0.0499).map(|one| one.1), ["differs", "jumps"]);
            assert_eq!(judged(unit, -1.9, 1.46).map(|one| one.1), ["agrees", "smooth"]);
            assert_eq!(judged(unit, f64::NAN, 9.0).map(|one| one.0), [false, false]);
        }
    }
}
