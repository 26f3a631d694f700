//! The interface of results of a kind of study, and the results of an internal-force study.

use std::any::Any;
use std::fmt::Debug;

/// Results of one kind of study. What shows them is listed in `report::study`.
pub trait StudyResults: Any + Debug + Send + Sync {
    /// Whether the method fails at the problem, be that expected of it or not.
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

/// One position of the moving particle in an internal-force study.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ForceRow {
    /// Position of the moving particle, in cells from the node.
    pub position: f64,
    /// Particles in the cell on the left.
    pub left: u64,
    /// Particles in the cell on the right.
    pub right: u64,
    /// Internal force on the node (N).
    pub force: f64,
    /// Force by the formula of the suite (N).
    pub predicted: f64,
}
