//! Energy balance of a run: the energy changes that each stage of a step causes.

use crate::named;
use serde::{Deserialize, Serialize};

named! {
    /// Stages of a step that change the energy.
    pub enum LedgerStage {
        /// Particle velocities are mapped to nodes.
        ParticleToGrid = "particle_to_grid",
        /// Nodal velocities differ from momentum divided by lumped mass.
        NodalVelocity = "nodal_velocity",
        /// Work of the internal forces on the grid.
        InternalForce = "internal_force",
        /// Work of the external forces on the grid.
        ExternalForce = "external_force",
        /// Accelerations differ from force divided by lumped mass.
        Constraints = "constraints",
        /// Nodal velocities are mapped to particles.
        GridToParticle = "grid_to_particle",
        /// Particles retain velocities that differ from the mapped ones.
        ParticleVelocity = "particle_velocity",
        /// Effects change velocities of particles.
        Effects = "effects",
        /// Particles move, and the inertia of their affine fields changes.
        Motion = "motion",
        /// Stored energy of the material.
        Stored = "stored_energy",
    }
}

impl LedgerStage {
    /// Stages of the transfer: the maps between particles and grid, the mass matrix and walls.
    pub const TRANSFER: [Self; 5] = [
        Self::ParticleToGrid,
        Self::NodalVelocity,
        Self::Constraints,
        Self::GridToParticle,
        Self::ParticleVelocity,
    ];
}

/// Energy changes of a body by stage, summed over steps, with the initial and the current energy.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct EnergyBalance {
    entries: [f64; LedgerStage::ALL.len()],
    start: f64,
    now: f64,
}

impl EnergyBalance {
    /// Creates a balance without entries for a body with this energy (J).
    pub fn new(energy: f64) -> Self {
        Self { entries: [0.0; LedgerStage::ALL.len()], start: energy, now: energy }
    }

    /// Adds the entries (J) of a step, one for each stage. `energy` (J) is the energy of the body
    /// after the step.
    pub fn add(&mut self, entries: &[f64; LedgerStage::ALL.len()], energy: f64) {
        for (sum, entry) in self.entries.iter_mut().zip(entries) {
            *sum += entry;
        }
        self.now = energy;
    }

    /// Returns the sum of the entries (J) of one stage.
    pub fn entry(&self, stage: LedgerStage) -> f64 {
        self.entries[stage as usize]
    }

    /// Returns the energy (J) after the last step.
    pub fn energy(&self) -> f64 {
        self.now
    }

    /// Returns the sum of all entries (J).
    pub fn change(&self) -> f64 {
        self.entries.iter().sum()
    }

    /// Returns the sum of the magnitudes of all entries (J).
    pub fn size(&self) -> f64 {
        self.entries.iter().map(|entry| entry.abs()).sum()
    }

    /// Returns the difference between the sum of the entries and the change of the energy, relative
    /// to the sum of the magnitudes of the entries.
    pub fn gap(&self) -> f64 {
        let difference = (self.change() - (self.now - self.start)).abs();
        if difference == 0.0 { 0.0 } else { difference / self.size() }
    }

    /// Returns the energy (J) gained by the maps between particles and grid, the mass matrix and
    /// walls.
    pub fn transfer_gain(&self) -> f64 {
        LedgerStage::TRANSFER.iter().map(|stage| self.entry(*stage)).sum()
    }

    /// Returns the change of the stored energy (J) that the work of the internal forces does not
    /// balance.
    pub fn stress_work_error(&self) -> f64 {
        self.entry(LedgerStage::InternalForce) + self.entry(LedgerStage::Stored)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Creates a balance with the entries 1, 2, 4, ... J, so each sum identifies its terms.
    fn balance() -> EnergyBalance {
        let mut balance = EnergyBalance::new(7.0);
        let entries = std::array::from_fn(|i| f64::from(1_u16 << i));
        balance.add(&entries, 7.0 + 1023.0);
        balance
    }

    #[test]
    fn sums_contain_their_stages() {
        let balance = balance();
        assert_eq!(balance.change(), 1023.0);
        assert_eq!(balance.transfer_gain(), f64::from(1 + 2 + 16 + 32 + 64));
        assert_eq!(balance.stress_work_error(), f64::from(4 + 512));
    }

    #[test]
    fn gap_is_relative_to_the_magnitudes() {
        let mut balance = balance();
        assert_eq!(balance.gap(), 0.0);
        let mut entries = [0.0; LedgerStage::ALL.len()];
        entries[0] = -1.0;
        balance.add(&entries, 7.0 + 1023.0);
        assert_eq!(balance.gap(), 1.0 / 1022.0);
        assert_eq!(EnergyBalance::new(3.0).gap(), 0.0);
        balance.add(&entries, f64::NAN);
        assert!(balance.gap().is_nan());
    }
}
