//! Refinement levels of a study, and the finer level of a same-method reference run.

use crate::suite::scene::{Scene, nodes, per_axis};
use crate::verify::Axis;

/// The refinement levels of a study.
#[derive(Debug, Clone)]
pub struct RefinePlan {
    /// The axis whose spacing is refined.
    pub axis: Axis,
    /// All levels, strictly from coarse to fine.
    pub levels: Vec<LevelPlan>,
    /// Number of levels that run without `--full`, starting with the coarsest.
    pub usual: usize,
    /// The time steps as stated: one formula of h, or one for each level.
    pub steps: Vec<String>,
    /// Share of the stable time step, if time steps are automatic. The time steps in `levels` are
    /// then preliminary, because they are computed before the particles exist.
    pub rule: Option<f64>,
}

/// One refinement level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LevelPlan {
    /// Number of cells along the first axis of the grid, or of the body if no grid is stated.
    pub cells: u64,
    /// Cell size (m).
    pub h: f64,
    /// Requested time step (s).
    pub dt: f64,
    /// Particles per cell, the D-th power of an integer; `None` without particles.
    pub ppc: Option<u64>,
}

/// Selection of the levels that run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// The levels that run without `--full`.
    Usual,
    /// All levels.
    Full,
}

impl RefinePlan {
    /// Returns the levels for this extent.
    pub fn levels(&self, extent: Extent) -> &[LevelPlan] {
        match extent {
            Extent::Usual => &self.levels[..self.usual],
            Extent::Full => &self.levels,
        }
    }

    /// Whether the levels have particles.
    pub fn has_particles(&self) -> bool {
        self.levels.iter().all(|level| level.ppc.is_some())
    }
}

impl LevelPlan {
    /// Returns the level with half the spacing along `axis`; `None` without such a spacing.
    pub fn halved(self, axis: Axis, dimension: usize) -> Option<Self> {
        match axis {
            Axis::Space => Some(Self { cells: 2 * self.cells, h: 0.5 * self.h, ..self }),
            Axis::Time => Some(Self { dt: 0.5 * self.dt, ..self }),
            Axis::Particles => self.ppc.map(|ppc| Self { ppc: Some(ppc << dimension), ..self }),
        }
    }

    /// Returns the distance (m) between particles, or between nodes if there are none.
    pub fn particle_spacing(self, dimension: usize) -> f64 {
        let per_cell = self.ppc.unwrap_or(1) as f64;
        self.h / libm::pow(per_cell, 1.0 / dimension as f64)
    }

    pub(crate) fn particles(self, scene: &Scene) -> f64 {
        (0..scene.dimension()).map(|axis| self.particles_along(scene, axis).max(1.0)).product()
    }

    pub(crate) fn particles_along(self, scene: &Scene, axis: usize) -> f64 {
        let per_axis = self.ppc.and_then(|ppc| per_axis(ppc, scene.dimension()));
        (scene.to[axis] - scene.from[axis]) * per_axis.unwrap_or(1) as f64 / self.h
    }

    /// Returns `nodes` or `particles` and their number, if there are more than [`MOST_POINTS`].
    pub(crate) fn too_large(self, scene: &Scene) -> Option<(&'static str, f64)> {
        let amounts = [("nodes", nodes(scene, self.h)), ("particles", self.particles(scene))];
        amounts.into_iter().find(|(_, amount)| *amount > MOST_POINTS || amount.is_nan())
    }
}

/// Maximum number of particles per level, and of nodes per level.
pub(crate) const MOST_POINTS: f64 = 5e7;

/// Minimum ratio of the cells of a fine-grid reference to those of the finest level. With a method
/// of second order, the reference has 1/16 of the error.
pub(crate) const FINE_GRID: u64 = 4;

/// The spacing that a reference run of the same method reduces.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SameMethod {
    /// The time step (s), on the same grid, in a study of time steps.
    ShorterSteps(f64),
    /// The cell size, in a study of space; contains the level with the fine grid.
    FineGrid(LevelPlan),
}

impl SameMethod {
    /// Returns a noun phrase for this reference, for use in sentences.
    pub fn words(self) -> &'static str {
        match self {
            Self::ShorterSteps(_) => "the same method with shorter steps",
            Self::FineGrid(_) => "the same method on a fine grid",
        }
    }

    /// Returns the suffix of case names.
    pub fn suffix(self) -> &'static str {
        match self {
            Self::ShorterSteps(_) => "-vs-shorter-steps",
            Self::FineGrid(_) => "-vs-fine-grid",
        }
    }
}
