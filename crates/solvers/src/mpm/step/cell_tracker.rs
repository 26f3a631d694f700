//! The cell of each particle, and counters of crossings and of particles that leave the grid.

use crate::mpm::foundation::algebra::{Vector, array};
use crate::mpm::foundation::finite_check::is_finite;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::foundation::simd::{BATCH, vectorized};
use crate::mpm::foundation::threads::{FEW, join};
use mpm_subject::{Column, Failure, RunCounters, Site};

/// Cells of all particles, with counters of crossings and departures.
#[derive(Debug)]
pub(in crate::mpm) struct CellTracker<const D: usize> {
    /// Index of the cell along each axis, as a floating-point number for comparison with positions.
    /// On a periodic axis the index is not wrapped.
    cells: Vec<[f64; D]>,
    /// Number of cell changes so far.
    pub(in crate::mpm) crossings: u64,
    /// Number of particles that are now outside the grid.
    pub(in crate::mpm) left_domain: u64,
}

impl<const D: usize> CellTracker<D> {
    /// Finds the initial cells of the particles. The error names the first particle outside all
    /// cells.
    pub(in crate::mpm) fn new(grid: &Grid<D>, particles: &Particles<D>) -> Result<Self, Failure> {
        let find = |(p, x): (usize, &Vector<D>)| cell(grid, x).ok_or_else(|| nowhere(p, x));
        let mut cells = particles.x.iter().enumerate().map(find).collect::<Result<Vec<_>, _>>()?;
        cells.shrink_to_fit();
        Ok(Self { cells, crossings: 0, left_domain: 0 })
    }

    /// Returns `counters` with the numbers of particles, crossings and departures of this tracker.
    pub(in crate::mpm) fn counters(&self, counters: RunCounters) -> RunCounters {
        RunCounters {
            particles: Some(self.cells.len() as u64),
            crossings: Some(self.crossings),
            left_domain: Some(self.left_domain),
            ..counters
        }
    }

    pub(in crate::mpm) fn columns(&self) -> Column<'_> {
        Column::of_particles("cell", &self.cells)
    }

    /// Counts cell changes and departures. In the total-Lagrangian frame a particle remains in the
    /// cell of its reference position, and only a non-finite position is an error. The error names
    /// the first particle outside all cells.
    pub(in crate::mpm) fn track(
        &mut self,
        grid: &Grid<D>,
        particles: &Particles<D>,
    ) -> Result<(), Failure> {
        let x = particles.positions();
        let found = if particles.current_position.is_empty() {
            enter_all(grid, &mut self.cells, x, 0)
        } else {
            let lost = x.iter().position(|x| !is_finite(x));
            CellChanges { lost, ..CellChanges::default() }
        };
        self.crossings += found.crossings;
        self.left_domain += found.left_domain;
        found.lost.map_or(Ok(()), |p| Err(nowhere(p, &x[p])))
    }
}

#[derive(Debug, Default, Clone, Copy, PartialEq, Eq)]
struct CellChanges {
    crossings: u64,
    left_domain: u64,
    /// Index of the first particle outside all cells.
    lost: Option<usize>,
}

/// Updates the cells of particles from their positions, on all threads. `first` is the index of the
/// first particle.
fn enter_all<const D: usize>(
    grid: &Grid<D>,
    cells: &mut [[f64; D]],
    x: &[Vector<D>],
    first: usize,
) -> CellChanges {
    let mut found = CellChanges::default();
    if x.len() > FEW {
        let middle = (x.len() / 2).next_multiple_of(BATCH);
        let ((low, high), (x_of_low, x_of_high)) = (cells.split_at_mut(middle), x.split_at(middle));
        let mut of_high = found;
        join(
            || found = enter_all(grid, low, x_of_low, first),
            || of_high = enter_all(grid, high, x_of_high, first + middle),
        );
        return CellChanges {
            crossings: found.crossings + of_high.crossings,
            left_domain: found.left_domain + of_high.left_domain,
            lost: found.lost.or(of_high.lost),
        };
    }
    vectorized(
        #[inline(always)]
        || {
            let batches = cells.chunks_mut(BATCH).zip(x.chunks(BATCH));
            for (batch, (cells, x)) in batches.enumerate() {
                if !stay(grid, cells, x) {
                    enter_each(grid, cells, x, first + batch * BATCH, &mut found);
                }
            }
        },
    );
    found
}

/// Whether every particle of a batch is still in its previous cell, the usual case.
#[inline(always)]
#[allow(clippy::needless_bitwise_bool, reason = "a lazy operator is a branch")]
fn stay<const D: usize>(grid: &Grid<D>, cells: &[[f64; D]], x: &[Vector<D>]) -> bool {
    let (mut stay, x) = (true, &x[..cells.len()]);
    for p in 0..cells.len() {
        for axis in 0..D {
            let (s, cell) = (grid.local(&x[p], axis), cells[p][axis]);
            stay &= (s >= cell) & (s < cell + 1.0);
        }
    }
    stay
}

#[inline(never)]
fn enter_each<const D: usize>(
    grid: &Grid<D>,
    cells: &mut [[f64; D]],
    x: &[Vector<D>],
    first: usize,
    found: &mut CellChanges,
) {
    for (lane, (at, x)) in cells.iter_mut().zip(x).enumerate() {
        if let Some(now) = cell(grid, x) {
            found.crossings += u64::from(crosses(grid, at, &now));
            *at = now;
        } else {
            found.left_domain += u64::from(is_finite(x));
            found.lost = found.lost.or(Some(first + lane));
        }
    }
}

/// Returns the cell that contains `x`, if any. The cell is not wrapped on periodic axes.
fn cell<const D: usize>(grid: &Grid<D>, x: &Vector<D>) -> Option<[f64; D]> {
    let inside = grid.cell(x)?;
    Some(array(0.0, |axis| {
        let beyond = grid.periodic[axis].then(|| libm::floor(grid.local(x, axis)));
        beyond.unwrap_or(inside[axis] as f64)
    }))
}

/// Whether two cells differ by more than whole periods.
fn crosses<const D: usize>(grid: &Grid<D>, from: &[f64; D], to: &[f64; D]) -> bool {
    (0..D).any(|axis| {
        let moved = to[axis] - from[axis];
        let apart = if grid.periodic[axis] { moved % grid.cells[axis] as f64 } else { moved };
        apart != 0.0
    })
}

fn nowhere<const D: usize>(p: usize, x: &Vector<D>) -> Failure {
    let site = Site::Particle(p);
    if is_finite(x) {
        Failure::LeftDomain { site, position: x.iter().copied().collect() }
    } else {
        Failure::NonFinite { quantity: "position", site }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rayon::ThreadPoolBuilder;
    use rstest::rstest;

    /// The row has one particle per cell. Some particles move to the next cell, some leave the
    /// grid, and one has an invalid position.
    #[rstest]
    fn counts_do_not_depend_on_the_number_of_threads(#[values(1, 3)] threads: usize) {
        let total = 2 * FEW + 37;
        let mut row = Particles::cubes([total]);
        let grid = Grid::new(Vector::zeros(), 1.0, [total], [false], [total + 1]);
        let mut tracker = CellTracker::new(&grid, &row).unwrap();
        let crossing = [3, FEW - 1, FEW, 2 * FEW, total - 2];
        for p in crossing {
            row.x[p][0] += 1.0;
        }
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        assert_eq!(pool.install(|| tracker.track(&grid, &row)), Ok(()));
        assert_eq!((tracker.crossings, tracker.left_domain), (5, 0));
        for p in [FEW + 7, FEW + 9, total - 1] {
            row.x[p][0] = -1.0;
        }
        row.x[5][0] = f64::NAN;
        let lost = Failure::NonFinite { quantity: "position", site: Site::Particle(5) };
        assert_eq!(pool.install(|| tracker.track(&grid, &row)), Err(lost));
        assert_eq!((tracker.crossings, tracker.left_domain), (5, 3));
    }

    /// Tests successive moves of one particle in cells of size 1, with the number of crossings of
    /// each move.
    #[rstest]
    #[case::within_its_cell(false, &[(0.25, 0), (1.0, 1), (1.75, 0)])]
    #[case::back_and_forth(false, &[(1.0, 1), (0.5, 1)])]
    #[case::onto_the_last_face(false, &[(3.5, 1), (4.0, 0), (3.9, 0)])]
    #[case::beyond_a_periodic_face(true, &[(-0.1, 1), (-0.9, 0), (-1.1, 1), (-0.2, 1)])]
    #[case::on_beyond_the_last(true, &[(3.9, 1), (4.0, 1), (4.5, 0), (5.1, 1), (9.0, 0)])]
    #[case::by_whole_periods(true, &[(4.5, 0), (-7.5, 0), (4e15, 0)])]
    fn a_crossing_is_a_change_of_cell(#[case] periodic: bool, #[case] moves: &[(f64, u64)]) {
        let mut one = Particles::cubes([1]);
        let grid = Grid::new(Vector::zeros(), 1.0, [4], [periodic], [5]);
        let mut tracker = CellTracker::new(&grid, &one).unwrap();
        let mut crossings = 0;
        for (x, crossed) in moves {
            one.x[0][0] = *x;
            assert_eq!(tracker.track(&grid, &one), Ok(()), "{x}");
            crossings += crossed;
            assert_eq!(tracker.crossings, crossings, "{x}");
        }
    }
}
