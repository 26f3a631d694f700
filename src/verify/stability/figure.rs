//! Figures of a run that expectations may speak of.

use super::trial_result::Trial;
use crate::named::named;

named! {
    /// A figure of a run.
    pub enum RunFigure {
        /// The largest energy over the energy at the start.
        Energy = "energy",
        /// The energy at the end over that at the start.
        EnergyKept = "energy_kept",
        /// Kinetic energy at the end over that at the start.
        KineticKept = "kinetic_kept",
        /// The largest relative change of the momentum.
        Momentum = "momentum",
        /// The largest relative change of the angular momentum.
        AngularMomentum = "angular_momentum",
        /// The smallest J met.
        LeastJ = "least_j",
        /// The largest speed met, over the wave speed.
        Speed = "speed",
        /// At the end, the kinetic energy in the null space of the map to the grid over the largest
        /// kinetic energy of the run.
        NullShare = "null_share",
        /// The largest kinetic energy met in the null space over the largest kinetic energy of the
        /// run.
        LargestNullShare = "largest_null_share",
        /// At the end, the part of the stress that changes from particle to particle and no
        /// further, over its mean size.
        Checkerboard = "checkerboard",
        /// At the end, the largest less the smallest mean normal stress over the largest.
        StressSpread = "stress_spread",
        /// At the end, the largest stress over the modulus.
        Stress = "stress",
        /// At the end, the largest displacement (m).
        Displacement = "displacement",
        /// Steps taken.
        Steps = "steps",
    }
}

impl RunFigure {
    /// Heading in tables.
    pub fn head(self) -> &'static str {
        match self {
            Self::Energy => "largest energy",
            Self::EnergyKept => "energy kept",
            Self::KineticKept => "kinetic kept",
            Self::Momentum => "momentum",
            Self::AngularMomentum => "angular mom.",
            Self::LeastJ => "least J",
            Self::Speed => "largest speed/c",
            Self::NullShare => "null share",
            Self::LargestNullShare => "largest null share",
            Self::Checkerboard => "checkerboard",
            Self::StressSpread => "stress spread",
            Self::Stress => "stress/M",
            Self::Displacement => "displacement",
            Self::Steps => "steps",
        }
    }

    /// Whether it is measured of what the grid cannot see, which is done only where it is asked
    /// for.
    pub fn is_of_null_space(self) -> bool {
        matches!(self, Self::NullShare | Self::LargestNullShare)
    }

    /// Its value in a run.
    pub fn of(self, trial: &Trial) -> f64 {
        match self {
            Self::Energy => trial.energy,
            Self::EnergyKept => trial.energy_kept,
            Self::KineticKept => trial.kinetic_kept,
            Self::Momentum => trial.momentum,
            Self::AngularMomentum => trial.angular_momentum,
            Self::LeastJ => trial.least_j,
            Self::Speed => trial.speed,
            Self::NullShare => trial.null_share,
            Self::LargestNullShare => trial.largest_null_share,
            Self::Checkerboard => trial.checkerboard,
            Self::StressSpread => trial.stress_spread,
            Self::Stress => trial.stress,
            Self::Displacement => trial.displacement,
            Self::Steps => trial.steps as f64,
        }
    }
}
