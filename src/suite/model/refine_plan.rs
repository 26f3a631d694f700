//! Levels of a study, and the finer level of a reference run by the same method.

use crate::verify::Axis;

/// The levels of a study.
#[derive(Debug, Clone)]
pub struct RefinePlan {
    /// Axis whose spacing is refined and judged.
    pub axis: Axis,
    /// Every level, strictly from coarse to fine.
    pub levels: Vec<LevelPlan>,
    /// Number of levels, from the coarsest on, that run without `--full`.
    pub usual: usize,
    /// The time steps as the suite states them: one formula of h, or one for each level.
    pub steps: Vec<String>,
    /// Share of the stable time step for an automatic step. The steps of the levels are then
    /// computed without the state of the particles.
    pub rule: Option<f64>,
}

/// One level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LevelPlan {
    /// Cells along the first axis of the grid, or of the body.
    pub cells: u64,
    /// Cell size (m).
    pub h: f64,
    /// Wanted time step (s).
    pub dt: f64,
    /// Particles per cell, the D-th power of a whole number; `None` without particles.
    pub ppc: Option<u64>,
}

/// Extent of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// The levels of the gate.
    Usual,
    /// All levels.
    Full,
}

impl RefinePlan {
    /// The levels that run.
    pub fn levels(&self, extent: Extent) -> &[LevelPlan] {
        match extent {
            Extent::Usual => &self.levels[..self.usual],
            Extent::Full => &self.levels,
        }
    }

    /// Whether there are particles.
    pub fn has_particles(&self) -> bool {
        self.levels.iter().all(|level| level.ppc.is_some())
    }
}

impl LevelPlan {
    /// The level with the spacing of `axis` halved, and nothing else changed; `None` if it has no
    /// such spacing.
    pub fn halved(self, axis: Axis, dimension: usize) -> Option<Self> {
        match axis {
            Axis::Space => Some(Self { cells: 2 * self.cells, h: 0.5 * self.h, ..self }),
            Axis::Time => Some(Self { dt: 0.5 * self.dt, ..self }),
            Axis::Particles => self.ppc.map(|ppc| Self { ppc: Some(ppc << dimension), ..self }),
        }
    }

    /// Distance of neighbouring particles (m), or of nodes where there are no particles.
    pub fn particle_spacing(self, dimension: usize) -> f64 {
        let per_cell = self.ppc.unwrap_or(1) as f64;
        self.h / libm::pow(per_cell, 1.0 / dimension as f64)
    }
}

/// Minimum ratio of the cells of the fine grid to those of the finest level: an error of second
/// order on the finest level is then known to 1/16.
pub(crate) const FINE_GRID: u64 = 4;

/// Shorter spacing of a reference run by the same method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SameMethod {
    /// The time step (s), on the same grid, in a study of time steps.
    ShorterSteps(f64),
    /// The cell size, in a study of space: this level.
    FineGrid(LevelPlan),
}

impl SameMethod {
    /// Phrase for this reference in a sentence.
    pub fn words(self) -> &'static str {
        match self {
            Self::ShorterSteps(_) => "the same method with shorter steps",
            Self::FineGrid(_) => "the same method on a fine grid",
        }
    }

    /// Suffix of the names of cases.
    pub fn suffix(self) -> &'static str {
        match self {
            Self::ShorterSteps(_) => "-vs-shorter-steps",
            Self::FineGrid(_) => "-vs-fine-grid",
        }
    }
}
