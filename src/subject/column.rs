//! Columns of the state of a subject: their size in memory and their numbers, and the cost of a
//! step: its passes, the particles that they visit, and its columns.

/// Owner of an entry of a column.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Holder {
    /// Particles.
    Particle,
    /// Nodes of the grid.
    Node,
}

/// Entry of a column: a number, a vector, a tensor, or an entry without numbers.
pub trait Entry {
    /// Appends its numbers; a tensor row after row.
    fn write(&self, _numbers: &mut Vec<f64>) {}
}

impl Entry for f64 {
    fn write(&self, numbers: &mut Vec<f64>) {
        numbers.push(*self);
    }
}

impl Entry for usize {}
impl<T> Entry for (usize, T) {}
impl<T, const N: usize> Entry for [T; N] {}

/// Size of a column: memory for each particle or node, or for some of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ColumnSize {
    /// Name of the field in the column.
    pub name: &'static str,
    /// Owner of an entry.
    pub holder: Holder,
    /// Entries.
    pub entries: usize,
    /// Bytes of one entry.
    pub bytes: usize,
}

/// A column of a subject's state.
pub struct Column<'a> {
    /// Name, owner and size.
    pub size: ColumnSize,
    write: WriteNumbers<'a>,
}

/// Appends the numbers of all entries.
type WriteNumbers<'a> = Box<dyn Fn(&mut Vec<f64>) + 'a>;

impl<'a> Column<'a> {
    /// A column with entries for particles.
    pub fn of_particles<T: Entry>(name: &'static str, entries: &'a [T]) -> Self {
        Self::with_holder(name, Holder::Particle, entries)
    }

    /// A column with entries for nodes.
    pub fn of_nodes<T: Entry>(name: &'static str, entries: &'a [T]) -> Self {
        Self::with_holder(name, Holder::Node, entries)
    }

    fn with_holder<T: Entry>(name: &'static str, holder: Holder, entries: &'a [T]) -> Self {
        let bytes = std::mem::size_of::<T>();
        Self {
            size: ColumnSize { name, holder, entries: entries.len(), bytes },
            write: Box::new(|numbers| entries.iter().for_each(|entry| entry.write(numbers))),
        }
    }

    /// The numbers of the column; `None` for a column without numbers.
    pub fn field(&self) -> Option<StateField> {
        let mut numbers = Vec::new();
        (self.write)(&mut numbers);
        let name = self.size.name.to_owned();
        let components = numbers.len().checked_div(self.size.entries).filter(|n| *n > 0)?;
        Some(StateField { name, components, numbers })
    }
}

/// Numbers at particles or nodes, one entry after the other.
#[derive(Debug, Clone, PartialEq)]
pub struct StateField {
    /// Name.
    pub name: String,
    /// Numbers of one entry: 1 of a scalar, D of a vector, `D * D` of a tensor, row after row.
    pub components: usize,
    /// All numbers.
    pub numbers: Vec<f64>,
}

/// Fields of one body.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BodyFields {
    /// Number of its particles.
    pub particles: usize,
    /// Fields with an entry for each particle.
    pub of_particles: Vec<StateField>,
    /// Lowest node of the grid, D numbers (m).
    pub origin: Vec<f64>,
    /// Cell size (m).
    pub h: f64,
    /// Nodes along each axis; they are counted along the first axis first.
    pub counts: Vec<usize>,
    /// Fields with an entry for each node.
    pub of_nodes: Vec<StateField>,
}

/// Cost of one step of a subject: its passes and its memory.
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
    /// Number of holders of entries.
    pub fn holders(&self, holder: Holder) -> usize {
        match holder {
            Holder::Particle => self.particles,
            Holder::Node => self.nodes,
        }
    }
}
