//! Contract of a basis with the loops.

use super::cell_locator::CellLocator;
use super::patch::{NodeWeight, Patch};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::foundation::simd;
use crate::mpm::foundation::simd::{LANES, Simd, SimdPass};
use fearless_simd::Level;

/// Particle domain over which a basis averages.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Domain {
    /// None: the particle is a point.
    Point,
    /// Domain of constant size.
    Fixed,
    /// Domain that deforms with the particle.
    Follows,
}

/// Basis functions N_i on the grid. Adding one: `docs/exercises/basis.md`.
pub trait Basis: Sized + Sync + Send + 'static {
    /// Degree p of the polynomials that the basis reproduces.
    const DEGREE: u8;

    /// Particle domain that the basis needs.
    const DOMAIN: Domain;

    /// Whether grad N_i is the derivative of N_i by the position of the particle; false for CPDI,
    /// where it is the average of a gradient over the domain.
    const GRADIENT_OF_WEIGHT: bool = true;

    /// Whether one patch has all nodes of a particle, at any position.
    const ONE_PATCH: bool = true;

    /// Nodes of a particle with the functions there: products of one-dimensional functions
    /// ([`Product`](super::Product)).
    type Patch<const D: usize>: Patch<D>;

    /// Number of functions along an axis of `cells` cells.
    fn count(cells: usize, periodic: bool) -> usize;

    /// Position of function `index` along an axis of `cells` cells, in cells from the wall, such
    /// that sum N_i x_i = x (Greville abscissa).
    fn abscissa(index: usize, cells: usize, periodic: bool) -> f64;

    /// Calls `visit` for every patch of particle `p`. A node may lie in several patches: its weight
    /// and gradient are the sums. A particle outside the grid has none: the solver reports it when
    /// it moves particles. Must be `#[inline(always)]`: part of the hot loop.
    fn patches<const D: usize>(
        grid: &Grid<D>,
        particles: &Particles<D>,
        p: usize,
        visit: impl FnMut(&Self::Patch<D>),
    );

    /// Stores the patches of the four particles from `first` on in the lanes from `lane` on.
    /// Returns a mask, bit k for particle `first + k`, of those whose only patch is stored; the
    /// others are left to [`Basis::patches`], which has the same bits. A basis overrides this to
    /// compute the weights of four particles at once.
    #[inline(always)]
    fn patches_x4<S: Simd, const D: usize>(
        _width: S,
        (grid, locator): (&Grid<D>, &CellLocator<D>),
        particles: &Particles<D>,
        (first, lane): (usize, usize),
        patches: &mut <Self::Patch<D> as Patch<D>>::Batch,
    ) -> u32 {
        let mut stored = 0;
        if !Self::ONE_PATCH {
            return stored;
        }
        for k in 0..LANES.min(particles.len() - first) {
            Self::patches(grid, particles, first + k, |patch| {
                patch.put(lane + k, &locator.layout, patches);
                stored |= 1 << k;
            });
        }
        stored
    }

    /// Calls `visit` for every node of every patch of particle `p`.
    #[inline(always)]
    fn visit<const D: usize>(
        grid: &Grid<D>,
        particles: &Particles<D>,
        p: usize,
        mut visit: impl FnMut(NodeWeight<'_, D>),
    ) {
        Self::patches(grid, particles, p, |patch| patch.visit(grid, &mut visit));
    }

    /// Runs a loop over this basis. A method of the basis, so that the compiler has a unit of code
    /// for the loops of each file of bases: they take most of its time, and a change of one file
    /// leaves the loops of the others as they are.
    fn run<P: SimdPass>(level: Level, pass: P) {
        simd::run(level, pass);
    }

    /// Largest number of nodes of a particle, counted once for each patch: the unit of the work
    /// counter.
    fn support(dimension: usize) -> u64;
}
