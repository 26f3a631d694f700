//! Cell of each particle, and counters of cell crossings and departures.

use crate::mpm::algebra::Vector;
use crate::mpm::grid::{Grid, floor};
use crate::mpm::particles::Particles;
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
        if !particles.current_position.is_empty() {
            let moved = particles.current_position.iter().enumerate();
            return miss(&mut self.left_domain, moved.filter(|(_, x)| !is_finite(x)));
        }
        let is_inside = |x: &Vector<D>| is_inside(grid, x);
        if grid.periodic.contains(&true) || !all(&particles.x, is_inside) {
            return self.track_each(grid, &particles.x);
        }
        // No early exit and no call in the loop, so that it compares several particles at a time.
        for (cell, x) in self.cells.iter_mut().zip(&particles.x) {
            let mut crosses = false;
            for axis in 0..D {
                let now = low(grid, x, axis);
                crosses |= now != cell[axis];
                cell[axis] = now;
            }
            self.crossings += u64::from(crosses);
        }
        Ok(())
    }

    /// The same, where a particle may be outside or beyond the end of a periodic axis.
    fn track_each(&mut self, grid: &Grid<D>, x: &[Vector<D>]) -> Result<(), Failure> {
        let Self { cells, crossings, left_domain } = self;
        let missing = cells.iter_mut().zip(x).enumerate().filter_map(|(p, (at, x))| {
            let Some(now) = cell(grid, x) else { return Some((p, x)) };
            *crossings += u64::from(now != *at);
            *at = now;
            None
        });
        miss(left_domain, missing)
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

/// Counts particles that are in no cell into `left_domain`, and names the first.
fn miss<'a, const D: usize>(
    left_domain: &mut u64,
    missing: impl Iterator<Item = (usize, &'a Vector<D>)>,
) -> Result<(), Failure> {
    let mut first = Ok(());
    for (p, x) in missing {
        *left_domain += u64::from(is_finite(x));
        first = first.and_then(|()| Err(nowhere(p, x)));
    }
    first
}

/// Whether `holds` does for all of them: with no early way out, see [`CellTracker::track`].
#[inline(always)]
fn all<const D: usize>(x: &[Vector<D>], holds: impl Fn(&Vector<D>) -> bool) -> bool {
    x.iter().fold(true, |all, x| all & holds(x))
}

#[inline(always)]
#[allow(clippy::needless_bitwise_bool, reason = "a lazy operator is a branch")]
fn is_inside<const D: usize>(grid: &Grid<D>, x: &Vector<D>) -> bool {
    (0..D).fold(true, |all, axis| {
        let s = grid.local(x, axis);
        all & (s >= 0.0) & (s <= grid.cells[axis] as f64)
    })
}

/// Index along `axis` of the cell that holds `x`, which is inside.
#[inline(always)]
fn low<const D: usize>(grid: &Grid<D>, x: &Vector<D>, axis: usize) -> f64 {
    let (low, last) = (floor(grid.local(x, axis)), grid.cells[axis] as f64 - 1.0);
    if low > last { last } else { low }
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
