//! The same method with one spacing much shorter than on any level, as the truth of a study.

use super::refine_plan::LevelPlan;

/// Least ratio of the cells of the fine grid to those of the finest level: an error of second order
/// on the finest level is then known to 1/16.
pub(crate) const FINE_GRID: u64 = 4;

/// The shorter spacing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SameMethod {
    /// The time step (s), on the same grid, in a study of time steps.
    ShorterSteps(f64),
    /// The cell size, and what follows it, in a study of space: this level.
    FineGrid(LevelPlan),
}

impl SameMethod {
    /// The truth in a sentence.
    pub fn words(self) -> &'static str {
        match self {
            Self::ShorterSteps(_) => "the same method with shorter steps",
            Self::FineGrid(_) => "the same method on a fine grid",
        }
    }

    /// Its part of the name of a case.
    pub fn suffix(self) -> &'static str {
        match self {
            Self::ShorterSteps(_) => "-vs-shorter-steps",
            Self::FineGrid(_) => "-vs-fine-grid",
        }
    }
}
