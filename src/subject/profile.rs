//! Cost of a step: its passes, the particles that they visit, and columns of memory.

use super::column::{ColumnSize, Holder};

/// Cost of one step of a subject: the passes that it computes and the memory that it keeps.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Profile {
    /// The effects that are active, in their order.
    pub effects: Vec<&'static str>,
    /// Particles.
    pub particles: usize,
    /// Nodes of the grid.
    pub nodes: usize,
    /// Memory; no column is empty.
    pub columns: Vec<ColumnSize>,
    /// Passes of one step in their order, from [`Subject::passes`](super::Subject::passes).
    pub passes: Vec<String>,
    /// Parts of the passes of one step, and the particles that each visits. A part that is computed
    /// twice counts twice.
    pub visits: Vec<(&'static str, u64)>,
}

impl Profile {
    /// How many there are of what columns have entries for.
    pub fn holders(&self, holder: Holder) -> usize {
        match holder {
            Holder::Particle => self.particles,
            Holder::Node => self.nodes,
        }
    }
}
