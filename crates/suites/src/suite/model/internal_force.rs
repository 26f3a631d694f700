//! An internal-force study whose suite has passed all checks.

use crate::exact::formula::Formula;
use crate::mpm::BasisName;

/// A study of the internal force on a node that a particle crosses.
#[derive(Debug, Clone)]
pub struct ForcePlan {
    /// Cell size (m).
    pub cell: f64,
    /// Particles per cell, before the moving particle changes its cell.
    pub ppc: u64,
    /// Volume of each particle (m).
    pub volume: f64,
    /// Uniform stress (Pa).
    pub stress: f64,
    /// Number of positions of the moving particle.
    pub positions: u64,
    /// Predicted force (N), a formula of n_left and n_right.
    pub prediction: Formula,
    /// The cases.
    pub cases: Vec<ForceCase>,
}

/// One case of an internal-force study.
#[derive(Debug, Clone)]
pub struct ForceCase {
    /// Case name.
    pub name: String,
    /// Basis functions.
    pub basis: BasisName,
    /// Expectation of the force; `None` if the suite states no expectations.
    pub expected: Option<ForceExpectation>,
    /// Reason for the expectation.
    pub because: String,
}

/// Expectation of the force on a node while a particle moves through it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ForceExpectation {
    /// Maximum deviation from the prediction, relative to the largest prediction.
    AgreesWithin(f64),
    /// Maximum change between neighbouring positions, relative to the largest prediction.
    StepsBelow(f64),
}

impl ForcePlan {
    pub(super) fn expectation(&self, case: usize) -> Option<(String, &str)> {
        let ForceCase { expected, because, .. } = &self.cases[case];
        Some((expected.as_ref()?.summary(), because))
    }
}

impl ForceExpectation {
    /// Returns a one-line summary for reports.
    pub fn summary(self) -> String {
        match self {
            Self::AgreesWithin(share) => format!("agrees with the prediction within {share:e}"),
            Self::StepsBelow(share) => {
                format!("no jump above {share} of the largest predicted force")
            }
        }
    }
}
