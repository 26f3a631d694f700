//! Results of a trial: verdict, figures, and the scales of the measurements.

use crate::named::named;
use crate::subject::EnergyBalance;
use serde::{Deserialize, Serialize};

named! {
    /// End of a run.
    pub enum Stability {
        /// The energy stayed within the range of exchange between its kinds.
        Stable = "stable",
        /// It grew beyond that, and not out of all bounds in the steps of the run.
        BoundedGrowth = "bounded_growth",
        /// It grew out of all bounds.
        Unstable = "unstable",
        /// The subject failed, or a figure is not finite.
        Failed = "failed",
    }
}

impl Stability {
    /// Text in reports.
    pub fn words(self) -> &'static str {
        match self {
            Self::BoundedGrowth => "bounded growth",
            other => other.name(),
        }
    }
}

/// Scales of the measurements of a trial.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scales {
    /// Wave speed (m/s).
    pub speed: f64,
    /// Stiffness against uniaxial strain (Pa).
    pub modulus: f64,
    /// Largest energy, over that at the start, of a run that is stable.
    pub stable_below: f64,
    /// Energy, over that at the start, beyond which a run is unstable and ends.
    pub unstable_above: f64,
    /// Whether the kinetic energy excludes that of the centre of mass: in a free body, the common
    /// velocity is no measure of the motion.
    pub centred: bool,
    /// Whether the part of the velocities in the null space of the map to the grid is measured at
    /// every check.
    pub null_space: bool,
}

/// Results of a run. Figures of a failed run are those up to its last step.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Trial {
    /// End of the run.
    pub verdict: Stability,
    /// Reason if the run did not reach its end: the failure, the particle and the step.
    pub why: Option<String>,
    /// Number of steps.
    pub steps: u64,
    /// The largest energy over that at the start.
    pub energy: f64,
    /// The energy at the end over that at the start.
    pub energy_kept: f64,
    /// Kinetic energy at the end over that at the start; NaN if the latter is zero.
    pub kinetic_kept: f64,
    /// The largest relative change of the momentum.
    pub momentum: f64,
    /// The largest relative change of the angular momentum.
    pub angular_momentum: f64,
    /// The smallest J met.
    pub least_j: f64,
    /// The largest speed met, over the wave speed.
    pub speed: f64,
    /// Kinetic energy in the null space of the map to the grid, at the end, over the largest
    /// kinetic energy of the run; NaN if it is not measured.
    pub null_share: f64,
    /// The largest kinetic energy met in the null space over the largest kinetic energy met.
    pub largest_null_share: f64,
    /// The largest minus the smallest mean normal stress over the largest in magnitude, at the end.
    pub stress_spread: f64,
    /// Changes of the pressure from particle to particle over its size, at the end.
    pub checkerboard: f64,
    /// The largest stress over the modulus, at the end.
    pub stress: f64,
    /// The largest displacement (m), at the end.
    pub displacement: f64,
    /// Changes of the energy by each stage of a step, summed over the run; `None` if no ledger is
    /// kept.
    pub ledger: Option<EnergyBalance>,
}
