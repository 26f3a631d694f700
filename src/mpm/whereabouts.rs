//! Which cell each particle is in, and how often one has changed its cell.

use super::{algebra::Vector, grid::Grid, particles::Particles};
use crate::subject::{Column, Failure, Site};

/// The cells of all particles, with counters.
#[derive(Debug)]
pub(super) struct Whereabouts<const D: usize> {
    cells: Vec<[usize; D]>,
    /// Changes of cell so far.
    pub(super) crossings: u64,
    /// Particles outside the grid now.
    pub(super) left_domain: u64,
}

impl<const D: usize> Whereabouts<D> {
    /// Finds the cells of particles that have not moved yet.
    ///
    /// # Errors
    /// [`Failure::LeftDomain`] for the first particle that has none.
    pub(super) fn new(grid: &Grid<D>, particles: &Particles<D>) -> Result<Self, Failure> {
        let find = |(p, x): (usize, &Vector<D>)| grid.cell(x).ok_or_else(|| nowhere(p, x));
        let mut cells = particles.x.iter().enumerate().map(find).collect::<Result<Vec<_>, _>>()?;
        cells.shrink_to_fit();
        Ok(Self { cells, crossings: 0, left_domain: 0 })
    }

    /// What is kept.
    pub(super) fn columns(&self) -> Column {
        Column::of_particles("cell", &self.cells)
    }

    /// Counts changes of cell and departures. In the total-Lagrangian frame a particle keeps the
    /// cell of its reference position, and its position must be a number.
    ///
    /// # Errors
    /// What became of the first particle that is in no cell.
    pub(super) fn track(
        &mut self,
        grid: &Grid<D>,
        particles: &Particles<D>,
    ) -> Result<(), Failure> {
        let Self { cells, crossings, left_domain } = self;
        let mut first = Ok(());
        let mut lost = |p, x: &Vector<D>| {
            *left_domain += u64::from(is_finite(x));
            if first.is_ok() {
                first = Err(nowhere(p, x));
            }
        };
        if !particles.moved.is_empty() {
            let moved = particles.moved.iter().enumerate();
            moved.filter(|(_, x)| !is_finite(x)).for_each(|(p, x)| lost(p, x));
            return first;
        }
        for (p, (cell, x)) in cells.iter_mut().zip(&particles.x).enumerate() {
            let Some((now, _)) = grid.locate(x) else {
                lost(p, x);
                continue;
            };
            *crossings += u64::from(now != *cell);
            *cell = now;
        }
        first
    }
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
