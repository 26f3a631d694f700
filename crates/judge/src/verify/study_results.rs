//! The results of a study of any kind, and the results of an internal-force study.

use crate::verify::{Convergence, GradientStudy, SpectrumStudy, StabilityStudy};
use std::sync::Arc;

/// Results of a study, by its kind. The functions that report them are listed in `report::study`.
#[derive(Debug, Clone)]
pub enum StudyResults {
    /// Errors on several levels of refinement.
    Convergence(Arc<Convergence>),
    /// The internal force on a node while a particle moves.
    InternalForce(Arc<InternalForce>),
    /// Growth of energy in runs.
    Stability(Arc<StabilityStudy>),
    /// Derivatives that a solver reports.
    Gradient(Arc<GradientStudy>),
    /// Phase speed and damping of waves.
    Spectrum(Arc<SpectrumStudy>),
}

impl StudyResults {
    /// Whether the method fails at the problem. Such a failure may be expected.
    pub fn fails(&self) -> bool {
        match self {
            Self::Convergence(study) => study.fails(),
            Self::InternalForce(_) => false,
            Self::Stability(study) => study.fails(),
            Self::Gradient(study) => study.fails(),
            Self::Spectrum(study) => study.fails(),
        }
    }
}

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
