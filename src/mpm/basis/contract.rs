//! What a basis is to the rest of the solver.

use super::{
    cell_locator::CellLocator,
    patch::{NodeWeight, Patch},
};
use crate::mpm::{
    grid::Grid,
    particles::Particles,
    simd::{LANES, Simd},
};

/// What a basis must know of a particle besides its position.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Domain {
    /// Nothing: the particle is a point.
    Point,
    /// Its domain, which keeps its reference size.
    Fixed,
    /// Its domain, which deforms with it.
    Follows,
}

/// A family of basis functions N_i on the grid. Adding one: `docs/exercises/basis.md`.
pub trait Basis: Sized + Sync + Send + 'static {
    /// Degree p of the polynomials that the basis reproduces on a smooth field.
    const DEGREE: u8;

    /// What the basis must know of a particle.
    const DOMAIN: Domain;

    /// Whether grad N_i is the derivative of N_i as the particle moves and its domain does not.
    /// Where it is not, as in CPDI, it is the average of a gradient over the domain.
    const GRADIENT_OF_WEIGHT: bool = true;

    /// Whether a particle sees all its nodes in one patch, wherever it is.
    const ONE_PATCH: bool = true;

    /// Some of the nodes that a particle sees, with the functions there: products of functions
    /// along the axes ([`Product`](super::Product)).
    type Patch<const D: usize>: Patch<D>;

    /// Functions along an axis of `cells` cells.
    fn count(cells: usize, periodic: bool) -> usize;

    /// Where function `index` along an axis of `cells` cells sits, in cells from the wall: the
    /// positions x_i for which sum N_i x_i = x (Greville abscissae).
    fn abscissa(index: usize, cells: usize, periodic: bool) -> f64;

    /// Calls `see` for every patch of nodes that particle `p` sees. A node may lie in several: its
    /// weight and its gradient are the sums. Does nothing where the particle is outside the grid: the
    /// solver reports that when it moves particles, not here. To be `#[inline(always)]`: it is part
    /// of the hot loop.
    fn patches<const D: usize>(
        grid: &Grid<D>,
        particles: &Particles<D>,
        p: usize,
        visit: impl FnMut(&Self::Patch<D>),
    );

    /// Puts the patches of the four particles from `first` on into the lanes from `lane` on, and
    /// returns in which there is one that is all that its particle sees: bit k for particle `first + k`.
    /// Others are left to [`Basis::patches`], which gives the same bits. Weights that are computed for four
    /// particles at once do not wait for one another; a basis that does not care needs no method of its own.
    #[inline(always)]
    fn patches_x4<S: Simd, const D: usize>(
        _width: S,
        (grid, locator): (&Grid<D>, &CellLocator<D>),
        particles: &Particles<D>,
        (first, lane): (usize, usize),
        patches: &mut <Self::Patch<D> as Patch<D>>::Batch,
    ) -> u32 {
        let mut seen = 0;
        if !Self::ONE_PATCH {
            return seen;
        }
        for k in 0..LANES.min(particles.len() - first) {
            Self::patches(grid, particles, first + k, |patch| {
                patch.put(lane + k, &locator.layout, patches);
                seen |= 1 << k;
            });
        }
        seen
    }

    /// Calls `visit` for every node of every patch.
    #[inline(always)]
    fn visit<const D: usize>(
        grid: &Grid<D>,
        particles: &Particles<D>,
        p: usize,
        mut visit: impl FnMut(NodeWeight<'_, D>),
    ) {
        Self::patches(grid, particles, p, |patch| patch.visit(grid, &mut visit));
    }

    /// Most visits to nodes that a particle makes in D dimensions: the unit of the work counter.
    fn support(dimension: usize) -> u64;
}
