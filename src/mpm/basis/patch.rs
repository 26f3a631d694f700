//! What loops do with the nodes that a particle sees.

use crate::mpm::{
    algebra::{Matrix, Vector},
    grid::Grid,
    packed_grid::{FieldView, FieldViewMut, Layout},
    simd::Simd,
};
use std::{fmt::Debug, ops::Range};

/// One node as a particle sees it.
#[derive(Debug, Clone, Copy)]
pub struct NodeWeight<'a, const D: usize> {
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
    type Batch: PatchBatch<D>;

    /// Takes the place of patch `lane`.
    fn put(&self, lane: usize, layout: &Layout, patches: &mut Self::Batch);

    /// Moments of the weights.
    fn weight_moments(&self) -> WeightMoments<D>;

    /// Mean of `x_i - x_p` (m) and its variance about it (m^2) along each axis, where the patch has all
    /// nodes that the particle sees and its functions are products: there is no covariance.
    fn variance(&self) -> ([f64; D], [f64; D]);

    /// Calls `visit` for every node.
    fn visit(&self, grid: &Grid<D>, visit: impl FnMut(NodeWeight<'_, D>));
}

/// Several patches. What depends on weights only is computed for four at once, each lane of a register
/// one of them; the loops over nodes go from patch to patch. Fields of nodes hold four numbers each,
/// and so do particles: each method does the same to all four.
pub trait PatchBatch<const D: usize>: Debug {
    /// Where they add to nodes.
    type NodeAccumulator<'a, S: Simd>;

    /// No patches.
    fn none() -> Self;

    /// Prepares what `scatter` and its likes need of these patches.
    fn compute_row_weights<S: Simd>(&mut self, simd: S, lanes: &Range<usize>);

    /// Prepares what is affine of these patches: levers `x_i - x_p - mean` about `mean`, or about the mean of the
    /// nodes of each patch, which then is all that its particle sees; and for these the inverse of
    /// the inertia tensor (1/m^2), `h` being the cell size (m).
    fn compute_offsets<S: Simd>(
        &mut self,
        simd: S,
        lanes: &Range<usize>,
        h: f64,
        mean: Option<&Vector<D>>,
    );

    /// The matrix with these columns, times the inverse inertia tensor of patch `lane`.
    fn divide<S: Simd>(&self, lane: usize, columns: &[S::F64x4; D]) -> [S::F64x4; D];

    /// A field to be added to.
    fn accumulator<S: Simd>(simd: S, field: FieldViewMut<'_>) -> Self::NodeAccumulator<'_, S>;

    /// Ends what was added.
    fn flush<S: Simd>(accumulator: Self::NodeAccumulator<'_, S>);

    /// Adds `value N_i` to the nodes of patch `lane`.
    fn scatter<S: Simd>(
        &self,
        lane: usize,
        value: S::F64x4,
        accumulator: &mut Self::NodeAccumulator<'_, S>,
    );

    /// Adds `(value + sum_a slope_a lever_a) N_i` to the nodes.
    fn scatter_affine<S: Simd>(
        &self,
        lane: usize,
        value_and_slope: (S::F64x4, &[S::F64x4; D]),
        accumulator: &mut Self::NodeAccumulator<'_, S>,
    );

    /// Adds `sum_a flux_a dN_i/dx_a` to the nodes.
    fn scatter_flux<S: Simd>(
        &self,
        lane: usize,
        flux: &[S::F64x4; D],
        accumulator: &mut Self::NodeAccumulator<'_, S>,
    );

    /// What the others add, in one visit: `(value + slope lever) N_i + flux dN_i/dx`. Along one axis only.
    fn scatter_all<S: Simd>(
        &self,
        lane: usize,
        value_and_slope: (S::F64x4, Option<S::F64x4>),
        flux: S::F64x4,
        accumulator: &mut Self::NodeAccumulator<'_, S>,
    );

    /// `sum_i field_i N_i`.
    fn gather<S: Simd>(&self, simd: S, lane: usize, field: &FieldView<'_>) -> S::F64x4;

    /// `sum_i field_i N_i` and, for each axis, `sum_i field_i lever_a N_i`.
    fn gather_moment<S: Simd>(
        &self,
        simd: S,
        lane: usize,
        field: &FieldView<'_>,
    ) -> (S::F64x4, [S::F64x4; D]);

    /// `sum_i field_i N_i` and, for each axis, `sum_i field_i dN_i/dx_a`.
    fn gather_gradient<S: Simd>(
        &self,
        simd: S,
        lane: usize,
        field: &FieldView<'_>,
    ) -> (S::F64x4, [S::F64x4; D]);
}
