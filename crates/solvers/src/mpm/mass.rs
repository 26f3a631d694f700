//! Registry of the mass matrices. A new matrix requires its type and one registration line below.

use super::boundary::Boundary;
use super::foundation::algebra::Vector;
use super::foundation::family::objects;
use super::foundation::grid::Grid;
use super::foundation::particles::Particles;
use super::kernel::contract::Kernel;
use mpm_subject::Failure;
use nalgebra::DVector;
use nalgebra_sparse::factorization::{CholeskyError, CscCholesky, CscSymbolicCholesky};
use nalgebra_sparse::pattern::SparsityPattern;

objects! {
    /// Names of the mass matrices that suites may choose for MPM.
    pub enum MassName;
    /// Creates the mass matrix with this name.
    pub fn mass_matrix -> MassMatrix;
    "lumped" => Lumped: Lumped,
    "consistent" => Consistent: Consistent::default(),
}

/// Converts nodal momenta to velocities, and forces to accelerations.
pub trait MassMatrix<const D: usize>: Send + Sync {
    /// Assembles the matrix for new particle positions, if it does not consist of `grid.mass`,
    /// which must be up to date. Returns the number of passes over the particles.
    ///
    /// # Errors
    /// [`Failure::Solve`] if the matrix is singular.
    fn assemble(
        &mut self,
        _kernel: &dyn Kernel<D>,
        _particles: &Particles<D>,
        _grid: &Grid<D>,
        _boundary: &[Box<dyn Boundary<D>>],
    ) -> Result<u64, Failure> {
        Ok(0)
    }

    /// Solves for `field` in place: momenta (kg m/s) become velocities, and forces (N)
    /// accelerations. Values on fixed nodes are undefined.
    fn solve(&self, grid: &Grid<D>, field: &mut [Vector<D>]);
}

/// The lumped mass matrix, as in the original MPM.
#[derive(Debug, Clone, Copy)]
pub struct Lumped;

impl<const D: usize> MassMatrix<D> for Lumped {
    fn solve(&self, grid: &Grid<D>, field: &mut [Vector<D>]) {
        grid.divide_by_mass(field);
    }
}

/// The consistent mass matrix.
#[derive(Default)]
pub struct Consistent {
    /// One factor per axis. Axes with the same fixed nodes share a factor.
    factors: Vec<Factor>,
    entries: MassEntries,
}

/// Entries of the matrix before constraints are applied, one for each pair of nodes in the support
/// of a particle.
#[derive(Default)]
struct MassEntries {
    /// Row and column node of each entry.
    pairs: Vec<(usize, usize)>,
    masses: Vec<f64>,
    /// Whether any pair has changed since the previous step.
    have_moved: bool,
}

impl MassEntries {
    fn collect<const D: usize>(
        &mut self,
        kernel: &dyn Kernel<D>,
        grid: &Grid<D>,
        particles: &Particles<D>,
    ) {
        let Self { pairs, masses, have_moved } = self;
        *have_moved = false;
        masses.clear();
        kernel.mass_entries(grid, particles, &mut |i, j, mass| {
            match pairs.get_mut(masses.len()) {
                Some(pair) if *pair == (i, j) => {}
                Some(pair) => (*pair, *have_moved) = ((i, j), true),
                None => {
                    pairs.push((i, j));
                    *have_moved = true;
                }
            }
            masses.push(mass);
        });
        *have_moved |= pairs.len() > masses.len();
        pairs.truncate(masses.len());
    }
}

/// The factorised matrix of the nodes that are free along one axis.
struct Factor {
    /// Matrix row of each node; `None` for a node without a row.
    row: Vec<Option<usize>>,
    rows: usize,
    assembly: Assembly,
    /// Values of the matrix (kg) from which the factor is computed.
    values: Vec<f64>,
    cholesky: CscCholesky<f64>,
}

impl Factor {
    /// Updates the factor `last` of the previous step if the pattern is the same; otherwise
    /// computes a new factor.
    fn after(last: Option<Self>, free: &[bool], entries: &MassEntries) -> Result<Self, Failure> {
        let mut rows = 0;
        let mut number = |free: &bool| {
            rows += usize::from(*free);
            free.then(|| rows - 1)
        };
        let row: Vec<_> = free.iter().map(&mut number).collect();
        let assembled = || {
            let place = |&(i, j): &(usize, usize)| row[i].zip(row[j]);
            Assembly::new(rows, entries.pairs.iter().map(place))
        };
        let factor = match last {
            Some(last) if !entries.have_moved && last.row == row => last.refactored(entries),
            Some(last) => {
                let assembly = assembled();
                if assembly.pattern == last.assembly.pattern {
                    Self { row, rows, assembly, ..last }.refactored(entries)
                } else {
                    Self::new(assembly, row, rows, entries)
                }
            }
            None => Self::new(assembled(), row, rows, entries),
        };
        factor.map_err(|_| {
            let why = "the consistent mass matrix is singular: too few particles see some node";
            Failure::Solve(why.to_owned())
        })
    }

    fn new(
        assembly: Assembly,
        row: Vec<Option<usize>>,
        rows: usize,
        entries: &MassEntries,
    ) -> Result<Self, CholeskyError> {
        let mut values = Vec::new();
        assembly.add_up(&entries.masses, &mut values);
        let symbolic = CscSymbolicCholesky::factor(assembly.pattern.clone());
        let cholesky = CscCholesky::factor_numerical(symbolic, &values)?;
        Ok(Self { row, rows, assembly, values, cholesky })
    }

    /// Refactors the matrix for other masses with the same pattern. The result is bit-identical to
    /// a new factorisation.
    fn refactored(mut self, entries: &MassEntries) -> Result<Self, CholeskyError> {
        self.assembly.add_up(&entries.masses, &mut self.values);
        self.cholesky.refactor(&self.values).map(|()| self)
    }

    fn solve<const D: usize>(&self, axis: usize, field: &mut [Vector<D>]) {
        let mut side = DVector::zeros(self.rows);
        for (value, row) in field.iter().zip(&self.row) {
            if let Some(row) = row {
                side[*row] = value[axis];
            }
        }
        self.cholesky.solve_mut(&mut side);
        for (value, row) in field.iter_mut().zip(&self.row) {
            value[axis] = row.map_or(0.0, |row| side[row]);
        }
    }
}

/// Returns one for each free component of a node with mass, and zero for the other components.
fn free<const D: usize>(grid: &Grid<D>, boundary: &[Box<dyn Boundary<D>>]) -> Vec<Vector<D>> {
    let has_mass = |m: &f64| Vector::from_element(f64::from(u8::from(*m > 0.0)));
    let mut free: Vec<Vector<D>> = grid.mass.iter().map(has_mass).collect();
    for condition in boundary {
        condition.clear(&mut free);
    }
    free
}

impl<const D: usize> MassMatrix<D> for Consistent {
    fn assemble(
        &mut self,
        kernel: &dyn Kernel<D>,
        particles: &Particles<D>,
        grid: &Grid<D>,
        boundary: &[Box<dyn Boundary<D>>],
    ) -> Result<u64, Failure> {
        self.entries.collect(kernel, grid, particles);
        let free = free(grid, boundary);
        let along = |axis: usize| free.iter().map(|f| f[axis] > 0.0).collect::<Vec<bool>>();
        let mut last = std::mem::take(&mut self.factors).into_iter();
        let same = (1..D).all(|axis| along(axis) == along(0));
        for axis in 0..if same { 1 } else { D } {
            self.factors.push(Factor::after(last.next(), &along(axis), &self.entries)?);
        }
        // For each particle, all pairs of nodes in its support are visited. This counts as
        // `support` passes.
        Ok(1 + kernel.support())
    }

    fn solve(&self, _: &Grid<D>, field: &mut [Vector<D>]) {
        for axis in 0..D {
            if let Some(factor) = self.factors.get(axis).or(self.factors.first()) {
                factor.solve(axis, field);
            }
        }
    }
}

/// Maps the entries of particles to positions in a matrix.
struct Assembly {
    pattern: SparsityPattern,
    /// Indices of the entries, grouped by matrix position.
    order: Vec<usize>,
    /// For each matrix position, the end of its entries in `order`.
    ends: Vec<usize>,
}

impl Assembly {
    /// Prepares the assembly of a matrix with `size` rows and entries at `places` (row and column).
    /// Entries whose place is `None` are ignored.
    ///
    /// The entries at one place are added in the same order as in a `CooMatrix` of
    /// `nalgebra_sparse`, so the sums are bit-identical.
    fn new(size: usize, places: impl Iterator<Item = Option<(usize, usize)>>) -> Self {
        let mut columns = vec![Vec::new(); size];
        let mut row = Vec::new();
        for (entry, place) in places.enumerate() {
            row.push(place.map_or(0, |(i, _)| i));
            if let Some((_, j)) = place {
                columns[j].push(entry);
            }
        }
        let (mut order, mut ends) = (Vec::with_capacity(row.len()), Vec::new());
        let (mut offsets, mut rows) = (vec![0], Vec::new());
        for mut column in columns {
            column.sort_unstable_by_key(|entry| row[*entry]);
            for same in column.chunk_by(|a, b| row[*a] == row[*b]) {
                rows.push(row[same[0]]);
                order.extend_from_slice(same);
                ends.push(order.len());
            }
            offsets.push(rows.len());
        }
        let pattern = SparsityPattern::try_from_offsets_and_indices(size, size, offsets, rows)
            .expect("rows are sorted, and each occurs once in a column");
        Self { pattern, order, ends }
    }

    /// Computes the matrix values, column by column, from the values of all entries.
    fn add_up(&self, entries: &[f64], values: &mut Vec<f64>) {
        values.clear();
        let mut start = 0;
        for end in &self.ends {
            let sum = self.order[start..*end].iter().map(|entry| entries[*entry]);
            values.push(sum.reduce(|sum, entry| sum + entry).unwrap_or_default());
            start = *end;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra_sparse::{CooMatrix, CscMatrix};
    use proptest::prelude::*;

    proptest! {
        /// Tests columns with few and with many entries, which are sorted by different algorithms.
        #[test]
        fn sums_are_bit_identical_to_those_of_the_library(
            entries in proptest::collection::vec((0..6_usize, 0..6_usize, 1e-3..1.0_f64), 0..900),
        ) {
            // Row and column 5 belong to fixed nodes.
            let free = |i: usize, j: usize| (i < 5 && j < 5).then_some((i, j));
            let mut matrix = CooMatrix::new(5, 5);
            for &(i, j, value) in &entries {
                if let Some((i, j)) = free(i, j) {
                    matrix.push(i, j, value);
                }
            }
            let expected = CscMatrix::from(&matrix);
            let found = Assembly::new(5, entries.iter().map(|&(i, j, _)| free(i, j)));
            prop_assert_eq!(&found.pattern, expected.pattern());
            let mut values = Vec::new();
            let masses: Vec<f64> = entries.iter().map(|entry| entry.2).collect();
            found.add_up(&masses, &mut values);
            prop_assert_eq!(values, expected.values());
        }
    }
}
