//! Reproducible random points: a suite is checked at the same positions on every machine.

/// The generator `SplitMix64` (Steele, Lea & Flood 2014), sufficient for scattered check points.
#[derive(Debug, Clone)]
pub struct Random(u64);

impl Random {
    /// Creates the sequence for `seed`.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Returns a uniform number in (0, 1), excluding both ends.
    pub fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        (((z ^ (z >> 31)) >> 12) as f64 + 0.5) / (1u64 << 52) as f64
    }

    /// Returns a uniform number in (low, high).
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }

    /// Returns a random point in a box.
    pub fn point(&mut self, from: &[f64], to: &[f64]) -> Vec<f64> {
        from.iter().zip(to).map(|(a, b)| self.between(*a, *b)).collect()
    }
}
