//! The consistent matrix, `M_ij = sum_p m_p N_i(x_p) N_j(x_p)` (Sulsky, Chen & Schreyer 1994, eq.
//! 2.16), solved by a sparse Cholesky factorisation.
//!
//! Order p + 1 needs it with a basis of degree p > 1. Nodes without mass have no row, held
//! nodes none in the component that is held: there, walls must be at rest. A node that too few
//! particles see makes the matrix singular, and the run fails with that reason. The sparsity
//! patterns of the matrix and of its factor are found anew only if particles have come to other
//! nodes.

use super::assembly::Assembly;
use super::contract::MassMatrix;
use crate::mpm::boundary::Boundary;
use crate::mpm::foundation::algebra::Vector;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::kernel::contract::Kernel;
use crate::subject::Failure;
use nalgebra::DVector;
use nalgebra_sparse::factorization::{CholeskyError, CscCholesky, CscSymbolicCholesky};

/// The consistent mass matrix.
#[derive(Default)]
pub struct Consistent {
    /// One for each axis, but for axes on which the same nodes are held.
    factors: Vec<Factor>,
    entries: MassEntries,
}

/// Entries of the matrix, one for each pair of nodes in the support of a particle, before
/// constraints.
#[derive(Default)]
struct MassEntries {
    /// Nodes of each.
    pairs: Vec<(usize, usize)>,
    /// Mass of each (kg).
    masses: Vec<f64>,
    /// Whether the pairs are others than those of the step before.
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

/// The matrix of the nodes that are free along an axis.
struct Factor {
    /// Row of each node; None where it has none.
    row: Vec<Option<usize>>,
    rows: usize,
    assembly: Assembly,
    /// The values of the matrix (kg).
    values: Vec<f64>,
    cholesky: CscCholesky<f64>,
}

impl Factor {
    /// The factor after `last`, that of the step before.
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

    /// The factor of other masses at the same places: the steps of the factorisation, and so its
    /// bits, are those of a new one.
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

/// Where nothing is held and there is mass: one where a component is free, zero elsewhere.
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
        // Every pair of nodes is visited.
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
