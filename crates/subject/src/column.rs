//! Columns of a solver's state, with their numbers and memory size, and the cost profile of a step.

/// Kind of object to which the entries of a column belong: particles or nodes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Holder {
    /// Each entry belongs to a particle.
    Particle,
    /// Each entry belongs to a node of the grid.
    Node,
}

/// Entry of a column: a number, a vector, a tensor, or a value without numbers.
pub trait Entry {
    /// Appends the numbers of the entry; a tensor is written row by row.
    fn write(&self, _numbers: &mut Vec<f64>) {}
}

impl Entry for f64 {
    fn write(&self, numbers: &mut Vec<f64>) {
        numbers.push(*self);
    }
}

/// Writes numbers row by row; a vector is a matrix with one column.
impl<const R: usize, const C: usize> Entry for nalgebra::SMatrix<f64, R, C> {
    fn write(&self, numbers: &mut Vec<f64>) {
        numbers.extend(self.row_iter().flat_map(|row| row.iter().copied().collect::<Vec<_>>()));
    }
}

impl Entry for usize {}
impl<T> Entry for (usize, T) {}
impl<T, const N: usize> Entry for [T; N] {}

/// Size of a column. A column has an entry for each particle or node, or for some of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ColumnSize {
    /// Name of the column.
    pub name: &'static str,
    /// Owner of the entries.
    pub holder: Holder,
    /// Number of entries.
    pub entries: usize,
    /// Bytes of one entry.
    pub bytes: usize,
}

/// A column of a solver's state.
pub struct Column<'a> {
    /// Name, owner and size.
    pub size: ColumnSize,
    write: WriteNumbers<'a>,
}

type WriteNumbers<'a> = Box<dyn Fn(&mut Vec<f64>) + 'a>;

impl<'a> Column<'a> {
    /// Creates a column with entries for particles.
    pub fn of_particles<T: Entry>(name: &'static str, entries: &'a [T]) -> Self {
        Self::with_holder(name, Holder::Particle, entries)
    }

    /// Creates a column with entries for nodes.
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

    /// Returns the numbers of the column; `None` if its entries have no numbers.
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
    /// Name of the field.
    pub name: String,
    /// Numbers per entry: 1 for a scalar, D for a vector, `D * D` for a tensor, row by row.
    pub components: usize,
    /// All numbers.
    pub numbers: Vec<f64>,
}

/// Particle and node fields of one body.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct BodyFields {
    /// Number of particles.
    pub particles: usize,
    /// Fields with an entry for each particle.
    pub of_particles: Vec<StateField>,
    /// Lowest node of the grid, D numbers (m).
    pub origin: Vec<f64>,
    /// Cell size (m).
    pub h: f64,
    /// Number of nodes along each axis. In node indices, the first axis varies fastest.
    pub counts: Vec<usize>,
    /// Fields with an entry for each node.
    pub of_nodes: Vec<StateField>,
}

/// Cost of one step of a solver: active effects, passes and memory.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Profile {
    /// Active effects, in the order in which they are applied.
    pub effects: Vec<&'static str>,
    /// Number of particles.
    pub particles: usize,
    /// Number of grid nodes.
    pub nodes: usize,
    /// Non-empty columns in memory.
    pub columns: Vec<ColumnSize>,
    /// Passes of one step in order, from [`Subject::passes`](super::Subject::passes).
    pub passes: Vec<String>,
    /// Quantities that the passes of one step compute, each with the number of visited particles. A
    /// quantity that is computed twice counts twice.
    pub visits: Vec<(&'static str, u64)>,
}

impl Profile {
    /// Returns the number of particles or nodes.
    pub fn holders(&self, holder: Holder) -> usize {
        match holder {
            Holder::Particle => self.particles,
            Holder::Node => self.nodes,
        }
    }
}
