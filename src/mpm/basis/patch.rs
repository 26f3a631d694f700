//! What loops do with the nodes that a particle sees.

use crate::mpm::{
    algebra::{Matrix, Vector},
    grid::Grid,
    packed_grid::{Layout, View, ViewMut},
    simd::Width,
};
use std::{fmt::Debug, ops::Range};

/// One node as a particle sees it.
#[derive(Debug, Clone, Copy)]
pub struct Seen<'a, const D: usize> {
    /// Number of the node.
    pub node: usize,
    /// N_i at the particle.
    pub weight: f64,
    /// grad N_i at the particle (1/m).
    pub gradient: &'a Vector<D>,
    /// Where the function sits ([`Basis::abscissa`](super::Basis::abscissa)), from the particle:
    /// x_i - x_p (m).
    pub offset: Vector<D>,
}

/// Moments of weights, sums over nodes.
#[derive(Debug, Clone, Copy)]
pub struct WeightMoments<const D: usize> {
    /// `sum_i (x_i - x_p) N_i` (m).
    pub first: Vector<D>,
    /// `sum_i (x_i - x_p) (x) (x_i - x_p) N_i` (m^2).
    pub second: Matrix<D>,
}

/// Nodes that a particle sees, and the functions there, as a basis gives them.
pub trait Patch<const D: usize>: Copy {
    /// Several of them, as the loops use them.
    type Several: PatchBatch<D>;

    /// Takes the place of patch `lane`.
    fn put(&self, lane: usize, layout: &Layout, patches: &mut Self::Several);

    /// Moments of the weights.
    fn spread(&self) -> WeightMoments<D>;

    /// Mean of `x_i - x_p` (m) and its variance about it (m^2) along each axis, where the patch has all
    /// nodes that the particle sees and its functions are products: there is no covariance.
    fn variance(&self) -> ([f64; D], [f64; D]);

    /// Calls `visit` for every node.
    fn visit(&self, grid: &Grid<D>, visit: impl FnMut(Seen<'_, D>));
}

/// Several patches. What depends on weights only is computed for four at once, each lane of a register
/// one of them; the loops over nodes go from patch to patch. Fields of nodes hold four numbers each,
/// and so do particles: each method does the same to all four.
pub trait PatchBatch<const D: usize>: Debug {
    /// Where they add to nodes.
    type NodeAccumulator<'a, W: Width>;

    /// No patches.
    fn none() -> Self;

    /// Prepares what `scatter` and its likes need of these patches.
    fn cross<W: Width>(&mut self, width: W, lanes: &Range<usize>);

    /// Prepares what is affine of these patches: levers `x_i - x_p - mean` about `mean`, or about the mean of the
    /// nodes of each patch, which then is all that its particle sees; and for these the inverse of
    /// the inertia tensor (1/m^2), `h` being the cell size (m).
    fn lever<W: Width>(&mut self, width: W, lanes: &Range<usize>, h: f64, mean: Option<&Vector<D>>);

    /// The matrix with these columns, times the inverse inertia tensor of patch `lane`.
    fn divide<W: Width>(&self, lane: usize, columns: &[W::Four; D]) -> [W::Four; D];

    /// A field to be added to.
    fn sink<W: Width>(width: W, field: ViewMut<'_>) -> Self::NodeAccumulator<'_, W>;

    /// Ends what was added.
    fn put<W: Width>(sink: Self::NodeAccumulator<'_, W>);

    /// Adds `value N_i` to the nodes of patch `lane`.
    fn scatter<W: Width>(
        &self,
        lane: usize,
        value: W::Four,
        sink: &mut Self::NodeAccumulator<'_, W>,
    );

    /// Adds `(value + sum_a slope_a lever_a) N_i` to the nodes.
    fn scatter_affine<W: Width>(
        &self,
        lane: usize,
        value_and_slope: (W::Four, &[W::Four; D]),
        sink: &mut Self::NodeAccumulator<'_, W>,
    );

    /// Adds `sum_a flux_a dN_i/dx_a` to the nodes.
    fn scatter_flux<W: Width>(
        &self,
        lane: usize,
        flux: &[W::Four; D],
        sink: &mut Self::NodeAccumulator<'_, W>,
    );

    /// What the others add, in one visit: `(value + slope lever) N_i + flux dN_i/dx`. Along one axis only.
    fn scatter_all<W: Width>(
        &self,
        lane: usize,
        value_and_slope: (W::Four, Option<W::Four>),
        flux: W::Four,
        sink: &mut Self::NodeAccumulator<'_, W>,
    );

    /// `sum_i field_i N_i`.
    fn gather<W: Width>(&self, width: W, lane: usize, field: &View<'_>) -> W::Four;

    /// `sum_i field_i N_i` and, for each axis, `sum_i field_i lever_a N_i`.
    fn gather_moment<W: Width>(
        &self,
        width: W,
        lane: usize,
        field: &View<'_>,
    ) -> (W::Four, [W::Four; D]);

    /// `sum_i field_i N_i` and, for each axis, `sum_i field_i dN_i/dx_a`.
    fn gather_gradient<W: Width>(
        &self,
        width: W,
        lane: usize,
        field: &View<'_>,
    ) -> (W::Four, [W::Four; D]);
}
