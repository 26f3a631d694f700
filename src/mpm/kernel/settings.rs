//! Settings of the loops, which change their speed and not their law.

use fearless_simd::Level;

/// How the loops run.
#[derive(Debug, Clone, Copy)]
pub struct LoopSettings {
    /// Instructions that the loops may use. Results have the same bits at any level.
    pub level: Level,
    /// Fewest particles of a scene that is cut into blocks for threads: smaller ones stay in the
    /// cache as they are. The sums of blocks are rounded in another order.
    pub min_particles: usize,
    /// Fewest particles of a block: the nodes shared with its neighbours must be few in comparison.
    pub min_block: usize,
}

impl Default for LoopSettings {
    /// The best level of this processor, and blocks of a size that pays.
    fn default() -> Self {
        Self { level: Level::new(), min_particles: 1 << 17, min_block: 1 << 13 }
    }
}
