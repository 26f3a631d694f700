//! Results of a trial: verdict and measured values, and the scales of these values.

use mpm_subject::named;
use serde::{Deserialize, Serialize};

named! {
    /// Verdict on a run.
    pub enum Stability {
        /// The energy stayed within the bound for stable runs.
        Stable = "stable",
        /// The energy exceeded the bound for stable runs, but not the bound for unstable runs.
        BoundedGrowth = "bounded_growth",
        /// The energy exceeded the bound for unstable runs.
        Unstable = "unstable",
        /// The solver failed, or a measured value is not finite.
        Failed = "failed",
    }
}

impl Stability {
    /// Returns the name for reports.
    pub fn words(self) -> &'static str {
        match self {
            Self::BoundedGrowth => "bounded growth",
            other => other.name(),
        }
    }
}

/// Scales that make the results of a trial dimensionless, and the bounds on the energy.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scales {
    /// Wave speed (m/s).
    pub speed: f64,
    /// Stiffness against uniaxial strain (Pa).
    pub modulus: f64,
    /// Largest energy of a stable run, relative to its initial value.
    pub stable_below: f64,
    /// Energy, relative to its initial value, above which a run is unstable and ends.
    pub unstable_above: f64,
    /// Whether the kinetic energy excludes the energy of the centre of mass, because the common
    /// velocity of a free body does not indicate growth.
    pub centred: bool,
    /// Whether every check measures the part of the particle velocities that gives no momentum to
    /// any node (the null space of the map to the grid).
    pub null_space: bool,
}

/// Results of a run. If the run failed, the results are those of the steps before the failure.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Trial {
    /// Verdict on the run.
    pub verdict: Stability,
    /// Reason why the run ended early, with the failure, the particle and the step.
    pub why: Option<String>,
    /// Number of steps.
    pub steps: u64,
    /// Largest energy, relative to its initial value.
    pub energy: f64,
    /// Energy at the end, relative to its initial value.
    pub energy_kept: f64,
    /// Kinetic energy at the end, relative to its initial value; NaN if the initial value is zero.
    pub kinetic_kept: f64,
    /// Largest relative change of the momentum.
    pub momentum: f64,
    /// Largest relative change of the angular momentum.
    pub angular_momentum: f64,
    /// Smallest determinant J of the deformation gradient during the run.
    pub least_j: f64,
    /// Largest speed during the run, relative to the wave speed.
    pub speed: f64,
    /// Kinetic energy at the end in the null space of the map to the grid, relative to the largest
    /// kinetic energy of the run. NaN if it was not measured.
    pub null_share: f64,
    /// Largest kinetic energy in the null space, relative to the largest kinetic energy of the run.
    pub largest_null_share: f64,
    /// Largest minus smallest mean normal stress at the end, relative to the largest magnitude.
    pub stress_spread: f64,
    /// RMS of the pressure differences between neighbouring particles at the end, relative to the
    /// mean size of the pressure.
    pub checkerboard: f64,
    /// Largest stress at the end, divided by the modulus.
    pub stress: f64,
    /// Largest displacement (m) at the end.
    pub displacement: f64,
}
