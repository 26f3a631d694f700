//! Registry of the figures that suites bound: [`CaseFigure`] for convergence studies, [`RunFigure`]
//! for stability studies.
//!
//! An entry states the key in suites and JSON, the documentation of the key, the text in reports
//! (with the unit, if any) and the value. The grammar of suites and its JSON Schema, the checks of
//! a suite, the comparison with the bound and the reports are derived from the entry. Adding a
//! figure: `docs/exercises/figure.md`.

use super::convergence::LevelOutcome;
use super::error::norm::larger;
use super::stability::Trial;
use crate::named::named;
use crate::subject::LedgerStage;

/// Calls the macro `declare` with every bounded figure of a convergence study. An entry
///
/// `RestBelow = rest_below, "residual speed over the wave speed", Maximum, StateOfRest,`
/// `residual_speed;`
///
/// gives the member of [`CaseFigure`]; its key in suites; its text in reports; the [`BoundKind`];
/// the [`FigureNeed`]; and the function that takes the levels of a case and returns the value. The
/// documentation of the entry becomes that of the key in the JSON Schema.
///
/// The grammar declares a field for each entry by this macro. `#[serde(flatten)]` over a map of
/// keys would need no macro, but it excludes `deny_unknown_fields`, and a misspelt key would lose
/// its place and suggestion.
macro_rules! each_case_figure {
    ($declare:ident) => {
        $declare! {
        /// Bounds on the judged error of every level that counts.
        ErrorBelow = error_below, "largest error", Maximum, Nothing, largest_error;
        /// Lower bound on the judged error of every level that counts.
        ErrorAbove = error_above, "smallest error", Minimum, Nothing, smallest_error;
        /// Distance (m) of the observed place from the exact one, at the end, on the finest level.
        ObservedWithin = observed_within, "error at the observed point (m)", Maximum,
            ObservedPlace, observed_error;
        /// Largest speed towards the end of every level that counts, over the wave speed.
        RestBelow = rest_below, "residual speed over the wave speed", Maximum, StateOfRest,
            residual_speed;
        }
    };
}
pub(crate) use each_case_figure;

/// Side on which a bound limits a figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BoundKind {
    /// The figure must be at most the bound.
    Maximum,
    /// The figure must be at least the bound.
    Minimum,
}

/// Part of a suite without which a figure does not exist.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FigureNeed {
    /// None: every case has the figure.
    Nothing,
    /// The key `observe`.
    ObservedPlace,
    /// An exact solution that is a state of rest.
    StateOfRest,
}

/// Declares [`CaseFigure`] from the entries of `each_case_figure`.
macro_rules! case_figures {
    ($($(#[$doc:meta])* $member:ident = $key:ident, $text:literal, $bound:ident, $need:ident,
        $value:ident;)+) => {
        /// A bounded figure of a case of a convergence study.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum CaseFigure {
            $($(#[$doc])* $member,)+
        }

        impl CaseFigure {
            /// Every figure, in the order of declaration.
            pub const ALL: [Self; [$(stringify!($key)),+].len()] = [$(Self::$member),+];

            /// Key of the bound in suites.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$member => stringify!($key),)+
                }
            }

            /// Text in reports.
            pub fn text(self) -> &'static str {
                match self {
                    $(Self::$member => $text,)+
                }
            }

            /// Side on which the bound limits the figure.
            pub fn bound_kind(self) -> BoundKind {
                match self {
                    $(Self::$member => BoundKind::$bound,)+
                }
            }

            /// Part of a suite without which the figure does not exist.
            pub fn need(self) -> FigureNeed {
                match self {
                    $(Self::$member => FigureNeed::$need,)+
                }
            }

            /// Value for the levels of a case; `None` if they do not have the figure.
            pub fn value(self, levels: &[LevelOutcome]) -> Option<f64> {
                match self {
                    $(Self::$member => $value(levels),)+
                }
            }
        }
    };
}
each_case_figure!(case_figures);

/// Largest judged error of the levels that count; NaN if one is.
fn largest_error(levels: &[LevelOutcome]) -> Option<f64> {
    counted(levels).map(|level| level.error).reduce(larger)
}

/// Smallest judged error of the levels that count; NaN if one is.
fn smallest_error(levels: &[LevelOutcome]) -> Option<f64> {
    counted(levels).map(|level| level.error).reduce(|a, b| -larger(-a, -b))
}

/// Distance (m) of the observed place from the exact one on the finest level.
fn observed_error(levels: &[LevelOutcome]) -> Option<f64> {
    levels.last().and_then(|level| level.run.observed_error)
}

/// Largest speed towards the end of the levels that count, over the wave speed; `None` if one level
/// has none, because the exact solution is not a state of rest.
fn residual_speed(levels: &[LevelOutcome]) -> Option<f64> {
    let speeds: Option<Vec<f64>> = counted(levels).map(|level| level.run.residual_speed).collect();
    speeds.and_then(|speeds| speeds.into_iter().reduce(larger))
}

/// The levels that count.
pub(super) fn counted(levels: &[LevelOutcome]) -> impl Iterator<Item = &LevelOutcome> {
    levels.iter().filter(|level| level.usable)
}

/// Declares [`RunFigure`]: for each member its documentation, its name in suites and JSON, its
/// heading in tables and its value in a run.
macro_rules! run_figures {
    ($($(#[$doc:meta])* $member:ident = $name:literal, $head:literal, $value:expr;)+) => {
        named! {
            /// A figure of a run.
            pub enum RunFigure {
                $($(#[$doc])* $member = $name,)+
            }
        }

        impl RunFigure {
            /// Heading in tables.
            pub fn head(self) -> &'static str {
                match self {
                    $(Self::$member => $head,)+
                }
            }

            /// Value in a run.
            pub fn of(self, trial: &Trial) -> f64 {
                let value: fn(&Trial) -> f64 = match self {
                    $(Self::$member => $value,)+
                };
                value(trial)
            }
        }
    };
}

run_figures! {
    /// The largest energy over the energy at the start.
    Energy = "energy", "largest energy", |trial| trial.energy;
    /// The energy at the end over that at the start.
    EnergyKept = "energy_kept", "energy kept", |trial| trial.energy_kept;
    /// Kinetic energy at the end over that at the start.
    KineticKept = "kinetic_kept", "kinetic kept", |trial| trial.kinetic_kept;
    /// The largest relative change of the momentum.
    Momentum = "momentum", "momentum", |trial| trial.momentum;
    /// The largest relative change of the angular momentum.
    AngularMomentum = "angular_momentum", "angular mom.", |trial| trial.angular_momentum;
    /// The smallest J met.
    LeastJ = "least_j", "least J", |trial| trial.least_j;
    /// The largest speed met, over the wave speed.
    Speed = "speed", "largest speed/c", |trial| trial.speed;
    /// At the end, the kinetic energy in the null space of the map to the grid over the largest
    /// kinetic energy of the run.
    NullShare = "null_share", "null share", |trial| trial.null_share;
    /// The largest kinetic energy met in the null space over the largest kinetic energy of the
    /// run.
    LargestNullShare = "largest_null_share", "largest null share", |trial| trial.largest_null_share;
    /// The part of the stress at the end that alternates between neighbouring particles, over its
    /// mean size.
    Checkerboard = "checkerboard", "checkerboard", |trial| trial.checkerboard;
    /// The largest minus the smallest mean normal stress at the end, over the largest.
    StressSpread = "stress_spread", "stress spread", |trial| trial.stress_spread;
    /// At the end, the largest stress over the modulus.
    Stress = "stress", "stress/M", |trial| trial.stress;
    /// At the end, the largest displacement (m).
    Displacement = "displacement", "displacement", |trial| trial.displacement;
    /// Number of steps.
    Steps = "steps", "steps", |trial| trial.steps as f64;
    /// Difference between the sum of the entries of the energy ledger and the change of the energy,
    /// over the sum of the magnitudes of the entries.
    LedgerGap = "ledger_gap", "ledger gap", |trial| trial.ledger.map_or(f64::NAN, |ledger| ledger.gap());
    /// Energy (J) gained by the maps between particles and grid, the mass matrix and walls.
    TransferGain = "transfer_gain", "transfer gain (J)",
        |trial| trial.ledger.map_or(f64::NAN, |ledger| ledger.transfer_gain());
    /// Work of the stress on the particles minus the work of the internal forces on the grid (J).
    StressWorkError = "stress_work_error", "stress work error (J)",
        |trial| trial.ledger.map_or(f64::NAN, |ledger| ledger.stress_work_error());
    /// Energy (J) gained as particle velocities are mapped to the grid.
    ParticleToGrid = "particle_to_grid", "particle to grid (J)",
        |trial| ledger_entry(trial, LedgerStage::ParticleToGrid);
    /// Energy (J) gained because nodal velocities differ from momentum over lumped mass.
    NodalVelocity = "nodal_velocity", "nodal velocity (J)",
        |trial| ledger_entry(trial, LedgerStage::NodalVelocity);
    /// Work of the internal forces on the grid (J).
    InternalForce = "internal_force", "internal force (J)",
        |trial| ledger_entry(trial, LedgerStage::InternalForce);
    /// Work of the external forces on the grid (J).
    ExternalForce = "external_force", "external force (J)",
        |trial| ledger_entry(trial, LedgerStage::ExternalForce);
    /// Energy (J) gained because accelerations differ from force over lumped mass.
    Constraints = "constraints", "constraints (J)",
        |trial| ledger_entry(trial, LedgerStage::Constraints);
    /// Energy (J) gained as nodal velocities are mapped to particles.
    GridToParticle = "grid_to_particle", "grid to particle (J)",
        |trial| ledger_entry(trial, LedgerStage::GridToParticle);
    /// Energy (J) gained because particles keep velocities that differ from the mapped ones.
    ParticleVelocity = "particle_velocity", "particle velocity (J)",
        |trial| ledger_entry(trial, LedgerStage::ParticleVelocity);
    /// Energy (J) gained by effects on the velocities of particles.
    EffectsOnVelocity = "effects", "effects (J)",
        |trial| ledger_entry(trial, LedgerStage::Effects);
    /// Energy (J) gained as particles move and the inertia of their affine fields changes.
    Motion = "motion", "motion (J)", |trial| ledger_entry(trial, LedgerStage::Motion);
    /// Energy (J) gained by the stored energy of the material.
    StoredEnergy = "stored_energy", "stored energy (J)",
        |trial| ledger_entry(trial, LedgerStage::Stored);
}

/// Sum of the entries (J) of a stage in the ledger of a run; NaN without a ledger.
fn ledger_entry(trial: &Trial, stage: LedgerStage) -> f64 {
    trial.ledger.map_or(f64::NAN, |ledger| ledger.entry(stage))
}

impl RunFigure {
    /// The figure called `name` in suites.
    pub(crate) fn by_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|figure| figure.name() == name)
    }

    /// Whether the figure is measured in the null space of the map to the grid, which is computed
    /// only on request.
    pub fn is_of_null_space(self) -> bool {
        matches!(self, Self::NullShare | Self::LargestNullShare)
    }

    /// Whether the figure is part of the energy ledger, which is kept only on request.
    pub fn is_of_ledger(self) -> bool {
        self as usize >= Self::LedgerGap as usize
    }
}

/// The figure that `docs/exercises/figure.md` adds.
#[cfg(test)]
#[path = "../../tests/exercises/steps_below.rs"]
#[expect(unreachable_pub, reason = "the macro declares public items")]
mod steps_below;
