//! The number of steps of the finest level, as a limit of the cost.

use super::{BoundKind, FigureNeed, LevelOutcome};

case_figures! {
    /// Number of steps of the finest level.
    StepsBelow = steps_below, "steps of the finest level", Maximum, Nothing, finest_steps;
}

fn finest_steps(levels: &[LevelOutcome]) -> Option<f64> {
    levels.last().map(|level| level.run.steps as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verify::convergence::tests::study;

    #[test]
    fn steps_of_the_finest_level_are_bounded() {
        let mut levels = study(&[0.1, 0.2]).levels;
        levels[0].run.steps = 8;
        levels[1].run.steps = 16;
        let [figure] = CaseFigure::ALL;
        assert_eq!(figure.value(&levels), Some(16.0));
        assert_eq!(figure.value(&[]), None);
        assert_eq!((figure.name(), figure.text()), ("steps_below", "steps of the finest level"));
        assert_eq!((figure.bound_kind(), figure.need()), (BoundKind::Maximum, FigureNeed::Nothing));
    }
}
