//! What a basis is to the rest of the solver.

use crate::mpm::{algebra::Vector, grid::Grid, particles::Particles};

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

/// One node as a particle sees it.
#[derive(Debug, Clone, Copy)]
pub struct Seen<'a, const D: usize> {
    /// Number of the node.
    pub node: usize,
    /// N_i at the particle.
    pub weight: f64,
    /// grad N_i at the particle (1/m).
    pub gradient: &'a Vector<D>,
    /// Where the function sits ([`Basis::abscissa`]), from the particle: x_i - x_p (m).
    pub offset: Vector<D>,
}

/// A family of basis functions N_i on the grid. How one is added: [`crate::mpm::adding_a_basis`].
pub trait Basis: Sized + Sync + Send + 'static {
    /// Degree p of the polynomials that the basis reproduces on a smooth field.
    const DEGREE: u8;

    /// What the basis must know of a particle.
    const DOMAIN: Domain;

    /// Whether grad N_i is the derivative of N_i as the particle moves and its domain does not.
    /// Where it is not, as in CPDI, it is the average of a gradient over the domain.
    const GRADIENT_OF_WEIGHT: bool = true;

    /// Functions along an axis of `cells` cells.
    fn count(cells: usize, periodic: bool) -> usize;

    /// Where function `index` along an axis of `cells` cells sits, in cells from the wall: the
    /// positions x_i for which sum N_i x_i = x (Greville abscissae).
    fn abscissa(index: usize, cells: usize, periodic: bool) -> f64;

    /// Calls `visit` for every node that particle `p` sees, once or several times: its weight and
    /// its gradient are the sums over the visits. Does nothing where the particle is
    /// outside the grid: the solver reports that when it moves particles, not here.
    fn visit<const D: usize>(
        grid: &Grid<D>,
        particles: &Particles<D>,
        p: usize,
        visit: impl FnMut(Seen<'_, D>),
    );

    /// Most visits to nodes that a particle makes in D dimensions: the unit of the work counter.
    fn support(dimension: usize) -> u64;
}
