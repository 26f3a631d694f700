//! Cost of a step: its passes, the particles that they visit, and columns of memory.

/// Owner of an entry of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Holder {
    /// Particles.
    Particle,
    /// Nodes of the grid.
    Node,
}

/// Memory that a subject keeps: one entry for each particle or node, or for some of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Column {
    /// Name of the field that it holds.
    pub name: &'static str,
    /// Owner of an entry.
    pub holder: Holder,
    /// Entries.
    pub entries: usize,
    /// Bytes of one entry.
    pub bytes: usize,
}

impl Column {
    /// A column with entries for particles.
    pub fn of_particles<T>(name: &'static str, entries: &[T]) -> Self {
        let bytes = std::mem::size_of::<T>();
        Self { name, holder: Holder::Particle, entries: entries.len(), bytes }
    }

    /// A column with entries for nodes.
    pub fn of_nodes<T>(name: &'static str, entries: &[T]) -> Self {
        Self { holder: Holder::Node, ..Self::of_particles(name, entries) }
    }
}

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
    pub columns: Vec<Column>,
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
