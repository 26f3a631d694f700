//! Patches: the nodes of a particle and the functions there.

use crate::mpm::foundation::algebra::Vector;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::moments::WeightMoments;
use crate::mpm::foundation::packed_grid::{FieldView, FieldViewMut, Layout, PackedNode};
use crate::mpm::foundation::simd::{Register, Simd};
use std::fmt::Debug;
use std::ops::Range;

/// Functions of one node at a particle.
#[derive(Debug, Clone, Copy)]
pub struct NodeWeight<'a, const D: usize> {
    /// Number of the node.
    pub node: usize,
    /// N_i at the particle.
    pub weight: f64,
    /// grad N_i at the particle (1/m).
    pub gradient: &'a Vector<D>,
    /// Position of the function ([`Basis::abscissa`](super::Basis::abscissa)) from the particle,
    /// x_i - x_p (m).
    pub offset: Vector<D>,
}

/// Nodes of a particle and the functions there.
pub trait Patch<const D: usize>: Copy {
    /// Patches of a batch of particles.
    type Batch: PatchBatch<D>;

    /// Stores this as patch `lane` of a batch.
    fn put(&self, lane: usize, layout: &Layout, patches: &mut Self::Batch);

    /// Moments of the weights.
    fn weight_moments(&self) -> WeightMoments<D>;

    /// Mean of `x_i - x_p` (m) and variance about it (m^2) along each axis, for the only patch of a
    /// particle. Functions are products, so that there is no covariance.
    fn variance(&self) -> ([f64; D], [f64; D]);

    /// Calls `visit` for every node.
    fn visit(&self, grid: &Grid<D>, visit: impl FnMut(NodeWeight<'_, D>));
}

/// Contribution of a particle to each of its nodes,
/// `(value + sum_a slope_a (x_i - x_p - mean)_a) N_i + sum_a flux_a dN_i/dx_a`, all components of a
/// node at once. Parts that are absent cost nothing.
#[derive(Debug, Clone, Copy)]
pub struct NodeTerm<F, const D: usize> {
    /// Constant part.
    pub value: Option<F>,
    /// Affine part; needs a value, which may be zero.
    pub slope: Option<[F; D]>,
    /// Part along the gradient.
    pub flux: Option<[F; D]>,
}

impl<F: Register, const D: usize> NodeTerm<F, D> {
    /// No part.
    pub(in crate::mpm) const NONE: Self = Self { value: None, slope: None, flux: None };
}

/// Patches of a batch of particles. Weights are computed for four particles at once; the loops over
/// nodes take one patch after another, four components of a node at once.
pub trait PatchBatch<const D: usize>: Debug {
    /// Empty batch.
    fn none() -> Self;

    /// Computes the products of weights that [`PatchBatch::scatter`] needs.
    fn compute_row_weights<S: Simd>(&mut self, simd: S, lanes: &Range<usize>);

    /// Computes offsets `x_i - x_p - mean` (m) and the inverse of the inertia tensor (1/m^2), for
    /// cells of size `h` (m). Without `mean`, that of the nodes of each patch is taken, which then
    /// must be the only patch of its particle.
    fn compute_offsets<S: Simd>(
        &mut self,
        simd: S,
        lanes: &Range<usize>,
        h: f64,
        mean: Option<&Vector<D>>,
    );

    /// The matrix with these columns, times the inverse inertia tensor of patch `lane`.
    fn divide<S: Simd>(&self, lane: usize, columns: &[S::F64x4; D]) -> [S::F64x4; D];

    /// Adds the terms of particles, each with its lane, to their nodes in `field`.
    fn scatter<S: Simd, N: PackedNode, T>(
        &self,
        simd: S,
        field: FieldViewMut<'_, N>,
        particles: impl Iterator<Item = (usize, T)>,
        term: impl Fn(usize, T) -> NodeTerm<N::Lanes<S>, D>,
    );

    /// `sum_i field_i N_i`.
    fn gather<S: Simd>(&self, simd: S, lane: usize, field: &FieldView<'_>) -> S::F64x4;

    /// `sum_i field_i N_i` and, for each axis, `sum_i field_i (x_i - x_p - mean)_a N_i`.
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
