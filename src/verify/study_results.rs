//! The interface for the results of a study, and the results of an internal-force study.

use std::any::Any;
use std::fmt::Debug;

/// Results of one kind of study. The functions that report them are listed in `report::study`.
pub trait StudyResults: Any + Debug + Send + Sync {
    /// Whether the method fails at the problem. Such a failure may be expected.
    fn fails(&self) -> bool {
        false
    }
}

impl StudyResults for InternalForce {}

/// Results of an internal-force study.
#[derive(Debug, Clone)]
pub struct InternalForce {
    /// Internal force on the node for every position of the moving particle.
    pub rows: Vec<ForceRow>,
}

/// Results for one position of the moving particle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ForceRow {
    /// Position of the moving particle, in cells from the node.
    pub position: f64,
    /// Number of particles in the cell on the left.
    pub left: u64,
    /// Number of particles in the cell on the right.
    pub right: u64,
    /// Internal force on the node (N).
    pub force: f64,
    /// Internal force by the formula of the suite (N).
    pub predicted: f64,
}
