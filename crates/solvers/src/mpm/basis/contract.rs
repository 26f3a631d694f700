//! Interface between a basis and the loops over particles: the basis, the patch of nodes of a
//! particle, and a batch of patches.

use super::cell_locator::CellLocator;
use super::product_batch::ProductBatch;
use super::shape::PatchShape;
use crate::mpm::foundation::algebra::Vector;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::moments::WeightMoments;
use crate::mpm::foundation::packed_grid::Layout;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::foundation::simd;
use crate::mpm::foundation::simd::{LANES, Simd, SimdPass};
use fearless_simd::Level;

/// Particle domain over which a basis averages its functions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Domain {
    /// No domain: the particle is a point.
    Point,
    /// Domain of constant size.
    Fixed,
    /// Domain that deforms with the particle.
    Follows,
}

/// Four consecutive particles, and the batch lanes of their patches.
#[derive(Debug, Clone, Copy)]
pub struct FourLanes {
    /// Index of the first particle.
    pub particle: usize,
    /// Lane of the first particle.
    pub lane: usize,
}

/// Basis functions N_i on the grid. `docs/exercises/basis.md` describes how to add a basis.
pub trait Basis: Sized + Sync + Send + 'static {
    /// Degree p of the polynomials that the basis reproduces.
    const DEGREE: u8;

    /// Particle domain that the basis needs.
    const DOMAIN: Domain;

    /// Whether grad N_i is the derivative of N_i with respect to the particle position. False for
    /// CPDI, whose grad N_i is a gradient averaged over the domain.
    const GRADIENT_OF_WEIGHT: bool = true;

    /// Whether a single patch contains all nodes of a particle at any position.
    const ONE_PATCH: bool = true;

    /// Nodes of a particle with the basis functions at these nodes, as products of one-dimensional
    /// functions ([`Product`](super::Product)).
    type Patch<const D: usize>: Patch<D>;

    /// Returns the number of functions along an axis with `cells` cells; one per node by default.
    fn count(cells: usize, periodic: bool) -> usize {
        cells + usize::from(!periodic)
    }

    /// Returns the position of function `index` along an axis with `cells` cells (in cells from the
    /// wall), such that sum N_i x_i = x (Greville abscissa); the position of the node by default.
    fn abscissa(index: usize, _cells: usize, _periodic: bool) -> f64 {
        index as f64
    }

    /// Calls `visit` for every patch of particle `p`. If a node is in several patches, its weight
    /// and gradient are the sums over these patches. A particle outside the grid has no patch. The
    /// solver reports such particles when it moves particles. Implementations must be
    /// `#[inline(always)]`, because this function is part of the hot loop.
    fn patches<const D: usize>(
        grid: &Grid<D>,
        particles: &Particles<D>,
        p: usize,
        visit: impl FnMut(&Self::Patch<D>),
    );

    /// Stores the patches of the four particles of `lanes`. Returns a mask, in which bit k belongs
    /// to particle `lanes.particle + k` and is set if this particle has a single patch. Only single
    /// patches are stored. For other particles, use [`Basis::patches`]. Both methods give
    /// bit-identical results. A basis overrides this method to compute the weights of four
    /// particles at once.
    #[inline(always)]
    fn patches_x4<S: Simd, W: PatchShape, const D: usize>(
        _width: S,
        grid: &Grid<D>,
        locator: &CellLocator<D>,
        particles: &Particles<D>,
        lanes: FourLanes,
        patches: &mut ProductBatch<D, W>,
    ) -> u32 {
        let FourLanes { particle: first, lane } = lanes;
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

    /// Calls `visit` for every node of particle `p` with the average of N_i over the end of the
    /// particle domain along `axis`, in the direction `outwards` (1 or -1), minus the value
    /// extrapolated linearly from the particle to this end. This difference is zero, and `visit` is
    /// not called, unless the domain contains a kink of the functions.
    fn visit_domain_end<const D: usize>(
        _grid: &Grid<D>,
        _particles: &Particles<D>,
        _p: usize,
        (_axis, _outwards): (usize, f64),
        _visit: impl FnMut(NodeWeight<'_, D>),
    ) {
    }

    /// Runs a loop over this basis. A trait method puts the loops of each basis file in a separate
    /// code-generation unit, so a change of one file does not recompile the loops of other bases.
    fn run<P: SimdPass>(level: Level, pass: P) {
        simd::run(level, pass);
    }

    /// Calls `user` with the basis whose compiled loops serve this basis, by default this basis.
    fn with_loops<U: LoopsUser>(user: U) -> U::Output {
        user.call::<Self>()
    }

    /// Returns the maximum number of nodes of a particle, where a node counts once for each patch.
    /// The work counter uses this number.
    fn support(dimension: usize) -> u64;
}

/// Function with a basis as its type parameter ([`Basis::with_loops`]).
pub trait LoopsUser {
    /// Result of the function.
    type Output;

    /// Calls the function with basis `B`.
    fn call<B: Basis>(self) -> Self::Output;
}

/// The basis function of one node, evaluated at a particle.
#[derive(Debug, Clone, Copy)]
pub struct NodeWeight<'a, const D: usize> {
    /// Index of the node.
    pub node: usize,
    /// Value of N_i at the particle.
    pub weight: f64,
    /// Gradient of N_i at the particle (1/m).
    pub gradient: &'a Vector<D>,
    /// Position of the function ([`Basis::abscissa`]) relative to the particle, x_i - x_p (m).
    pub offset: Vector<D>,
}

/// Nodes of a particle, with the basis functions evaluated there.
pub trait Patch<const D: usize>: Copy {
    /// Shape of the patches of this type.
    type ShapeOfPatch: PatchShape + Default;

    /// Stores this patch in lane `lane` of a batch.
    fn put<W: PatchShape>(&self, lane: usize, layout: &Layout, patches: &mut ProductBatch<D, W>);

    /// Returns the moments of the weights, with the second moment about the particle.
    fn weight_moments(&self) -> WeightMoments<D>;

    /// Returns mean (m) and variance (m^2) of `x_i - x_p` along each axis, for the only patch of a
    /// particle. The covariance is zero, because functions are products.
    fn variance(&self) -> ([f64; D], [f64; D]);

    /// Calls `visit` for every node.
    fn visit(&self, grid: &Grid<D>, visit: impl FnMut(NodeWeight<'_, D>));
}
