//! Particles visited for each part of a kernel's passes: what reports list as `particle visits`.

use std::sync::OnceLock;
use std::sync::atomic::AtomicU64;
use std::sync::atomic::Ordering::Relaxed;

/// Particles visited for each part of the passes. Counted from the first call of `take` on: runs
/// that nobody asks do not count.
#[derive(Debug, Default)]
pub struct Tally(OnceLock<[AtomicU64; NAMES.len()]>);

const NAMES: [&str; 18] = [
    "p2g mass",
    "p2g momentum",
    "p2g internal force",
    "p2g force by fit",
    "p2g point force",
    "p2g point moment",
    "g2p velocity",
    "g2p gradient",
    "g2p moment",
    "weight moments",
    "mass matrix",
    "g2p position",
    "p2g mass gradient",
    "p2g scalar",
    "p2g scalar flux",
    "p2g scalar source",
    "g2p scalar",
    "g2p scalar gradient",
];

impl Tally {
    pub(super) fn add(&self, name: &str, particles: usize) {
        let Some(counts) = self.0.get() else { return };
        if let Some(part) = NAMES.iter().position(|known| *known == name) {
            counts[part].fetch_add(particles as u64, Relaxed);
        }
    }

    /// Parts of passes since the last call, with the particles visited by all of `tallies`.
    pub(in crate::mpm) fn take(tallies: &[&Self]) -> Vec<(&'static str, u64)> {
        let taken = |part: usize| {
            let counts = tallies.iter().map(|tally| tally.0.get_or_init(Default::default));
            counts.map(|counts| counts[part].swap(0, Relaxed)).sum()
        };
        let sums = NAMES.iter().enumerate().map(|(part, name)| (*name, taken(part)));
        sums.filter(|(_, visited)| *visited > 0).collect()
    }
}
