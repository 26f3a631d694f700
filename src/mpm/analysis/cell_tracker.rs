//! Cell of each particle, and counters of cell crossings and departures.

use crate::mpm::algebra::Vector;
use crate::mpm::grid::{Grid, floor};
use crate::mpm::particles::Particles;
use crate::mpm::simd::{BATCH, vectorized};
use crate::subject::{Checkpoint, Column, Failure, Memory, Site};

/// The cells of all particles, with counters.
#[derive(Debug)]
pub(in crate::mpm) struct CellTracker<const D: usize> {
    /// Index of the cell along each axis: whole numbers, as which they are compared fastest.
    cells: Vec<[f64; D]>,
    /// Changes of cell so far.
    pub(in crate::mpm) crossings: u64,
    /// Particles outside the grid now.
    pub(in crate::mpm) left_domain: u64,
}

impl<const D: usize> CellTracker<D> {
    /// Finds the cells of particles that have not moved yet.
    ///
    /// # Errors
    /// [`Failure::LeftDomain`] for the first particle that has none.
    pub(in crate::mpm) fn new(grid: &Grid<D>, particles: &Particles<D>) -> Result<Self, Failure> {
        let find = |(p, x): (usize, &Vector<D>)| cell(grid, x).ok_or_else(|| nowhere(p, x));
        let mut cells = particles.x.iter().enumerate().map(find).collect::<Result<Vec<_>, _>>()?;
        cells.shrink_to_fit();
        Ok(Self { cells, crossings: 0, left_domain: 0 })
    }

    /// Columns for particles.
    pub(in crate::mpm) fn columns(&self) -> Column<'_> {
        Column::of_particles("cell", &self.cells)
    }

    /// Counts changes of cell and departures. In the total-Lagrangian frame a particle keeps the
    /// cell of its reference position, and its position must be a number.
    ///
    /// # Errors
    /// The failure of the first particle that is in no cell.
    pub(in crate::mpm) fn track(
        &mut self,
        grid: &Grid<D>,
        particles: &Particles<D>,
    ) -> Result<(), Failure> {
        let Self { cells, crossings, left_domain } = self;
        let mut found = Ok(());
        let mut miss = |p: usize, x: &Vector<D>| {
            *left_domain += u64::from(is_finite(x));
            if found.is_ok() {
                found = Err(nowhere(p, x));
            }
        };
        if !particles.current_position.is_empty() {
            let moved = particles.current_position.iter().enumerate();
            moved.filter(|(_, x)| !is_finite(x)).for_each(|(p, x)| miss(p, x));
            return found;
        }
        let is_periodic = grid.periodic.contains(&true);
        vectorized(
            #[inline(always)]
            || {
                let batches = cells.chunks_mut(BATCH).zip(particles.x.chunks(BATCH));
                for (batch, (cells, x)) in batches.enumerate() {
                    // Known in each branch, so that one has no division.
                    let now = if is_periodic {
                        all_inside::<D, true>(grid, x)
                    } else {
                        all_inside::<D, false>(grid, x)
                    };
                    match now {
                        Some(now) => *crossings += enter(cells, &now),
                        None => enter_each(grid, cells, x, crossings, &mut |lane, x| {
                            miss(batch * BATCH + lane, x);
                        }),
                    }
                }
            },
        );
        found
    }
}

impl<const D: usize> Memory for CellTracker<D> {
    fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        let Self { cells, crossings, left_domain } = self;
        checkpoint.visit(&mut cells[..]);
        checkpoint.visit(crossings);
        checkpoint.visit(left_domain);
    }
}

/// The cells of a batch of particles, if all have one.
#[inline(always)]
#[allow(clippy::needless_bitwise_bool, reason = "a lazy operator is a branch")]
fn all_inside<const D: usize, const IS_PERIODIC: bool>(
    grid: &Grid<D>,
    x: &[Vector<D>],
) -> Option<[[f64; D]; BATCH]> {
    let (mut cells, mut are_inside) = ([[0.0; D]; BATCH], true);
    for (cell, x) in cells.iter_mut().zip(x) {
        for axis in 0..D {
            let s = if IS_PERIODIC { grid.wrapped_near(x, axis) } else { grid.local(x, axis) };
            let end = grid.cells[axis] as f64;
            are_inside &= (s >= 0.0) & (s <= end);
            let low = floor(s);
            cell[axis] = if low > end - 1.0 { end - 1.0 } else { low };
        }
    }
    are_inside.then_some(cells)
}

/// Puts particles into the cells where they are `now`; how many have changed theirs.
#[inline(always)]
fn enter<const D: usize>(cells: &mut [[f64; D]], now: &[[f64; D]; BATCH]) -> u64 {
    let mut crossings = 0;
    for (cell, now) in cells.iter_mut().zip(now) {
        let mut crosses = false;
        for axis in 0..D {
            crosses |= now[axis] != cell[axis];
            cell[axis] = now[axis];
        }
        crossings += u64::from(crosses);
    }
    crossings
}

/// The same one by one, where some are in no cell, which `miss` is told, with their numbers.
#[inline(never)]
fn enter_each<const D: usize>(
    grid: &Grid<D>,
    cells: &mut [[f64; D]],
    x: &[Vector<D>],
    crossings: &mut u64,
    miss: &mut dyn FnMut(usize, &Vector<D>),
) {
    for (lane, (at, x)) in cells.iter_mut().zip(x).enumerate() {
        let Some(now) = cell(grid, x) else {
            miss(lane, x);
            continue;
        };
        *crossings += u64::from(now != *at);
        *at = now;
    }
}

/// The cell that holds `x`, if one does.
fn cell<const D: usize>(grid: &Grid<D>, x: &Vector<D>) -> Option<[f64; D]> {
    grid.cell(x).map(|cell| cell.map(|index| index as f64))
}

fn is_finite<const D: usize>(x: &Vector<D>) -> bool {
    x.iter().all(|c| c.is_finite())
}

fn nowhere<const D: usize>(p: usize, x: &Vector<D>) -> Failure {
    let site = Site::Particle(p);
    if is_finite(x) {
        Failure::LeftDomain { site, position: x.iter().copied().collect() }
    } else {
        Failure::NonFinite { quantity: "position", site }
    }
}
