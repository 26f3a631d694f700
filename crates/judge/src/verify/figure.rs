//! Registry of the measured values that suites can bound: [`CaseFigure`] for convergence studies
//! and [`RunFigure`] for stability studies.
//!
//! An entry contains the key in suites and JSON, the documentation of the key, the text in reports
//! (with the unit, if any) and the function that computes the value. The suite grammar, its JSON
//! Schema, the checks of a suite, the comparison with the bound, and the reports are derived from
//! the entry. How to add a measured value: `docs/exercises/figure.md`.

use crate::verify::{LevelOutcome, Trial, larger};
use mpm_subject::named;

/// Calls the macro `declare` with every measured value that a convergence study can bound. The
/// entry
///
/// `RestBelow = rest_below, "residual speed divided by the wave speed", Maximum, StateOfRest,`
/// `residual_speed;`
///
/// defines a member of [`CaseFigure`], its key in suites, its text in reports, its [`BoundKind`],
/// its [`FigureNeed`], and the function that computes the value from the levels of a case. The
/// documentation of the entry becomes the documentation of the key in the JSON Schema.
///
/// The grammar uses this macro to declare a field for each entry, because `#[serde(flatten)]` over
/// a map of keys cannot be combined with `deny_unknown_fields`.
#[macro_export]
macro_rules! each_case_figure {
    ($declare:ident) => {
        $declare! {
        /// Upper bound on the judged error of every level that counts.
        ErrorBelow = error_below, "largest error", Maximum, Nothing, largest_error;
        /// Lower bound on the judged error of every level that counts.
        ErrorAbove = error_above, "smallest error", Minimum, Nothing, smallest_error;
        /// Distance (m) of the observed point from its exact position, at the end, on the finest
        /// level.
        ObservedWithin = observed_within, "error at the observed point (m)", Maximum,
            ObservedPlace, observed_error;
        /// Largest speed near the end on every level that counts, divided by the wave speed.
        RestBelow = rest_below, "residual speed divided by the wave speed", Maximum, StateOfRest,
            residual_speed;
        }
    };
}

/// Side on which a bound limits a measured value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BoundKind {
    /// The value must be at most the bound.
    Maximum,
    /// The value must be at least the bound.
    Minimum,
}

/// Part of a suite that a measured value requires.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FigureNeed {
    /// No part: every case has the value.
    Nothing,
    /// The key `observe`.
    ObservedPlace,
    /// An exact solution that is a state of rest.
    StateOfRest,
}

macro_rules! case_figures {
    ($($(#[$doc:meta])* $member:ident = $key:ident, $text:literal, $bound:ident, $need:ident,
        $value:ident;)+) => {
        /// A measured value that a convergence study can bound.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum CaseFigure {
            $($(#[$doc])* $member,)+
        }

        impl CaseFigure {
            /// All measured values, in the order of declaration.
            pub const ALL: [Self; [$(stringify!($key)),+].len()] = [$(Self::$member),+];

            /// Returns the key of the bound in suites.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$member => stringify!($key),)+
                }
            }

            /// Returns the description for reports.
            pub fn text(self) -> &'static str {
                match self {
                    $(Self::$member => $text,)+
                }
            }

            /// Returns the side on which the bound limits the value.
            pub fn bound_kind(self) -> BoundKind {
                match self {
                    $(Self::$member => BoundKind::$bound,)+
                }
            }

            /// Returns the part of a suite that the value requires.
            pub fn need(self) -> FigureNeed {
                match self {
                    $(Self::$member => FigureNeed::$need,)+
                }
            }

            /// Computes the value from the levels of a case; `None` if they do not have it.
            pub fn value(self, levels: &[LevelOutcome]) -> Option<f64> {
                match self {
                    $(Self::$member => $value(levels),)+
                }
            }
        }
    };
}
each_case_figure!(case_figures);

/// Returns the largest judged error of the levels that count; NaN if one of these is NaN.
fn largest_error(levels: &[LevelOutcome]) -> Option<f64> {
    counted(levels).map(|level| level.error).reduce(larger)
}

/// Returns the smallest judged error of the levels that count; NaN if one of these is NaN.
fn smallest_error(levels: &[LevelOutcome]) -> Option<f64> {
    counted(levels).map(|level| level.error).reduce(|a, b| -larger(-a, -b))
}

fn observed_error(levels: &[LevelOutcome]) -> Option<f64> {
    levels.last().and_then(|level| level.run.observed_error)
}

/// Returns the largest speed near the end on the levels that count, relative to the wave speed.
/// `None` if a level has no such speed, because the exact solution is not a state of rest.
fn residual_speed(levels: &[LevelOutcome]) -> Option<f64> {
    let speeds: Option<Vec<f64>> = counted(levels).map(|level| level.run.residual_speed).collect();
    speeds.and_then(|speeds| speeds.into_iter().reduce(larger))
}

pub(super) fn counted(levels: &[LevelOutcome]) -> impl Iterator<Item = &LevelOutcome> {
    levels.iter().filter(|level| level.usable)
}

/// Declares [`RunFigure`]. An entry contains the documentation of the member, the key in suites and
/// JSON, the heading in tables, and the function that computes the value from a run.
macro_rules! run_figures {
    ($($(#[$doc:meta])* $member:ident = $name:literal, $head:literal, $value:expr;)+) => {
        named! {
            /// A measured value of a run that a stability study can bound.
            pub enum RunFigure {
                $($(#[$doc])* $member = $name,)+
            }
        }

        impl RunFigure {
            /// Returns the heading for tables.
            pub fn head(self) -> &'static str {
                match self {
                    $(Self::$member => $head,)+
                }
            }

            /// Computes the value from the result of a run.
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
    /// Largest energy, divided by the energy at the start.
    Energy = "energy", "largest/initial energy", |trial| trial.energy;
    /// Energy at the end, divided by the energy at the start.
    EnergyKept = "energy_kept", "final/initial energy", |trial| trial.energy_kept;
    /// Kinetic energy at the end, divided by the kinetic energy at the start.
    KineticKept = "kinetic_kept", "final/initial kinetic energy", |trial| trial.kinetic_kept;
    /// Largest relative change of the momentum.
    Momentum = "momentum", "momentum drift", |trial| trial.momentum;
    /// Largest relative change of the angular momentum.
    AngularMomentum = "angular_momentum", "angular momentum drift", |trial| trial.angular_momentum;
    /// Smallest determinant J of the deformation gradient during the run.
    LeastJ = "least_j", "min J", |trial| trial.least_j;
    /// Largest speed during the run, divided by the wave speed.
    Speed = "speed", "largest speed/c", |trial| trial.speed;
    /// Kinetic energy at the end in the null space of the map to the grid, divided by the largest
    /// kinetic energy of the run.
    NullShare = "null_share", "null share", |trial| trial.null_share;
    /// Largest kinetic energy in the null space during the run, divided by the largest kinetic
    /// energy of the run.
    LargestNullShare = "largest_null_share", "largest null share", |trial| trial.largest_null_share;
    /// Part of the stress at the end that alternates between neighbouring particles, divided by the
    /// mean magnitude of the stress.
    Checkerboard = "checkerboard", "checkerboard", |trial| trial.checkerboard;
    /// Largest minus smallest mean normal stress at the end, divided by the largest magnitude.
    StressSpread = "stress_spread", "stress spread", |trial| trial.stress_spread;
    /// Largest stress at the end, divided by the modulus.
    Stress = "stress", "largest stress magnitude/M at the end", |trial| trial.stress;
    /// Largest displacement (m) at the end.
    Displacement = "displacement", "largest displacement (m)", |trial| trial.displacement;
    /// Number of steps.
    Steps = "steps", "steps", |trial| trial.steps as f64;
}

impl RunFigure {
    /// Returns the measured value whose key in suites is `name`.
    pub fn by_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|figure| figure.name() == name)
    }

    /// Whether the value concerns the null space of the map to the grid, computed on request only.
    pub fn is_of_null_space(self) -> bool {
        matches!(self, Self::NullShare | Self::LargestNullShare)
    }
}

/// The measured value that readers of `docs/exercises/figure.md` add.
#[cfg(test)]
#[path = "../../../../tests/exercises/steps_below.rs"]
#[expect(unreachable_pub, reason = "the macro declares public items")]
mod steps_below;
