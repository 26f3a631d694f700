//! Changes of conserved sums during a run without external forces.
//!
//! A drift is the largest change of a sum since t = 0, relative to a scale: the largest value of a
//! mass or an energy during the run, or the largest sum of the magnitudes of the particle momenta
//! for a momentum, which may be zero. The energy is NaN for a law without stored energy.

use super::error::norm::larger;
use mpm_subject::Totals;
use mpm_subject::named;
use serde::{Deserialize, Serialize};

named! {
    /// A conserved sum over the body.
    pub enum Conserved {
        /// Total mass.
        Mass = "mass",
        /// Linear momentum.
        Momentum = "momentum",
        /// Angular momentum about the origin; undefined in 1-D.
        AngularMomentum = "angular_momentum",
        /// Kinetic energy. It is conserved only in a motion without stress.
        KineticEnergy = "kinetic_energy",
        /// Gain of kinetic energy since the start. The gain must be zero if the body only stores
        /// energy in stress and releases it.
        KineticEnergyGain = "kinetic_energy_gain",
        /// Kinetic energy plus stored energy, if the law stores energy.
        Energy = "energy",
    }
}

impl Conserved {
    /// Returns the name as written in running text.
    pub fn words(self) -> String {
        self.name().replace('_', " ")
    }

    /// Returns the value of the sum, and the scale of its changes.
    fn of(self, totals: &Totals) -> ([f64; 3], f64) {
        match self {
            Self::Mass => ([totals.mass, 0.0, 0.0], totals.mass.abs()),
            Self::Momentum => (totals.momentum, totals.momentum_size),
            Self::AngularMomentum => (totals.angular_momentum, totals.angular_momentum_size),
            Self::KineticEnergy | Self::KineticEnergyGain => {
                ([totals.kinetic_energy, 0.0, 0.0], totals.kinetic_energy)
            }
            Self::Energy => {
                let energy = totals.energy().unwrap_or(f64::NAN);
                ([energy, 0.0, 0.0], energy.abs())
            }
        }
    }
}

/// Relative drift of each sum; NaN if a value became NaN or the run failed.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ConservationError([f64; Conserved::ALL.len()]);

impl ConservationError {
    /// Drifts of a failed run: all NaN.
    pub const NONE: Self = Self([f64::NAN; Conserved::ALL.len()]);

    /// Returns the drift of `sum`.
    pub fn of(&self, sum: Conserved) -> f64 {
        self.0[sum as usize]
    }

    /// For each sum, returns the larger of the two drifts; NaN if either is NaN.
    #[must_use]
    pub fn larger(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| larger(self.0[i], other.0[i])))
    }
}

#[derive(Debug, Clone)]
pub(super) struct Balance {
    start: Totals,
    change: [f64; Conserved::ALL.len()],
    size: [f64; Conserved::ALL.len()],
}

impl Balance {
    pub(super) fn start(start: Totals) -> Self {
        let zero = [0.0; Conserved::ALL.len()];
        let mut balance = Self { start, change: zero, size: zero };
        balance.look(Some(&start));
        balance
    }

    /// Includes the totals of an instant. All drifts become NaN if the solver reports none.
    pub(super) fn look(&mut self, now: Option<&Totals>) {
        for (i, sum) in Conserved::ALL.iter().enumerate() {
            let (before, _) = sum.of(&self.start);
            let (after, size) = now.map_or(([f64::NAN; 3], f64::NAN), |now| sum.of(now));
            let change = match sum {
                Conserved::KineticEnergyGain => larger(0.0, after[0] - before[0]),
                _ => (0..3).fold(0.0, |all, k| libm::hypot(all, after[k] - before[k])),
            };
            self.change[i] = larger(self.change[i], change);
            self.size[i] = larger(self.size[i], size);
        }
    }

    /// Returns the largest changes relative to their scales; zero if both are zero.
    pub(super) fn drift(&self) -> ConservationError {
        let relative = |change: f64, size: f64| if change == 0.0 { 0.0 } else { change / size };
        ConservationError(std::array::from_fn(|i| relative(self.change[i], self.size[i])))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use rstest::rstest;

    const START: Totals = Totals {
        mass: 2.0,
        momentum: [1.0, -1.0, 0.0],
        momentum_size: 4.0,
        angular_momentum: [0.0, 0.0, 3.0],
        angular_momentum_size: 6.0,
        kinetic_energy: 8.0,
        strain_energy: Some(2.0),
        second_moment: [0.0; 3],
        reference_second_moment: [0.0; 3],
    };

    fn drift(later: &[Option<Totals>]) -> ConservationError {
        let mut balance = Balance::start(START);
        for totals in later {
            balance.look(totals.as_ref());
        }
        balance.drift()
    }

    #[rstest]
    #[case::mass(Totals { mass: 1.0, ..START }, Conserved::Mass, 0.5)]
    #[case::momentum(Totals { momentum: [4.0, 3.0, 0.0], ..START }, Conserved::Momentum, 1.25)]
    #[case::spin(
        Totals { angular_momentum: [0.0; 3], ..START },
        Conserved::AngularMomentum,
        0.5
    )]
    #[case::energy_that_is_stored(
        Totals { kinetic_energy: 6.0, strain_energy: Some(4.0), ..START },
        Conserved::KineticEnergy,
        0.25
    )]
    #[case::stored_energy(Totals { strain_energy: Some(1.0), ..START }, Conserved::Energy, 0.1)]
    #[case::a_size_that_grew(
        Totals { momentum: [1.0, 4.0, 0.0], momentum_size: 50.0, ..START },
        Conserved::Momentum,
        0.1
    )]
    fn a_drift_is_the_largest_change_over_the_size(
        #[case] later: Totals,
        #[case] sum: Conserved,
        #[case] expected: f64,
    ) {
        let found = drift(&[Some(later), Some(START)]);
        for &other in Conserved::ALL {
            let expected = if other == sum { expected } else { 0.0 };
            assert_relative_eq!(found.of(other), expected, max_relative = 1e-15);
        }
    }

    #[rstest]
    #[case::lost(6.0, 0.25, 0.0)]
    #[case::gained(10.0, 0.2, 0.2)]
    fn only_a_gain_of_energy_is_a_gain(#[case] later: f64, #[case] change: f64, #[case] gain: f64) {
        let found = drift(&[Some(Totals { kinetic_energy: later, ..START }), Some(START)]);
        assert_relative_eq!(found.of(Conserved::KineticEnergy), change, max_relative = 1e-15);
        assert_eq!(found.of(Conserved::KineticEnergyGain), gain);
        let torn = drift(&[Some(Totals { kinetic_energy: f64::NAN, ..START }), Some(START)]);
        assert!(torn.of(Conserved::KineticEnergyGain).is_nan());
    }

    #[rstest]
    #[case::then_a_number(&[Some(Totals { momentum: [f64::NAN, 0.0, 0.0], ..START }), Some(START)])]
    #[case::a_size(&[Some(Totals { momentum: [0.0; 3], momentum_size: f64::NAN, ..START })])]
    #[case::of_a_subject_that_falls_silent(&[None, Some(START)])]
    fn nan_remains_nan(#[case] later: &[Option<Totals>]) {
        assert!(drift(later).of(Conserved::Momentum).is_nan());
    }

    #[test]
    fn only_momentum_from_rest_is_a_drift() {
        let rest = Totals { strain_energy: Some(0.0), ..Totals::default() };
        let mut balance = Balance::start(rest);
        balance.look(Some(&rest));
        assert_eq!(balance.drift(), ConservationError([0.0; Conserved::ALL.len()]));
        balance.look(Some(&Totals { momentum: [1.0, 0.0, 0.0], ..rest }));
        assert_eq!(balance.drift().of(Conserved::Momentum), f64::INFINITY);
    }

    #[test]
    fn law_without_energy_has_a_nan_drift() {
        let start = Totals { strain_energy: None, ..START };
        let mut balance = Balance::start(start);
        balance.look(Some(&start));
        assert!(balance.drift().of(Conserved::Energy).is_nan());
        assert_eq!(balance.drift().of(Conserved::KineticEnergy), 0.0);
    }
}
