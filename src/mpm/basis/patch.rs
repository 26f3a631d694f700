//! What loops do with the nodes that a particle sees.

use crate::mpm::{
    algebra::{Matrix, Vector},
    four::Width,
    grid::Grid,
    packed::{View, ViewMut},
};

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
pub struct Spread<const D: usize> {
    /// `sum_i (x_i - x_p) N_i` (m).
    pub first: Vector<D>,
    /// `sum_i (x_i - x_p) (x) (x_i - x_p) N_i` (m^2).
    pub second: Matrix<D>,
}

/// Nodes that a particle sees, and the functions there. Fields of nodes hold four numbers each, and
/// so do particles: each method does the same to all four.
pub trait Patch<const D: usize>: Copy {
    /// Adds `value N_i` to the nodes.
    fn scatter<W: Width>(&self, width: W, value: W::Four, field: &mut ViewMut<'_>);

    /// Adds `(value + sum_a slope_a (x_i - x_p - mean)_a) N_i` to the nodes.
    fn scatter_affine<W: Width>(
        &self,
        width: W,
        value_and_mean: (W::Four, &Vector<D>),
        slope: &[W::Four; D],
        field: &mut ViewMut<'_>,
    );

    /// Adds `sum_a flux_a dN_i/dx_a` to the nodes.
    fn scatter_flux<W: Width>(&self, width: W, flux: &[W::Four; D], field: &mut ViewMut<'_>);

    /// `sum_i field_i N_i`.
    fn gather<W: Width>(&self, width: W, field: &View<'_>) -> W::Four;

    /// `sum_i field_i N_i` and, for each axis, `sum_i field_i (x_i - x_p - mean)_a N_i`.
    fn gather_moment<W: Width>(
        &self,
        width: W,
        mean: &Vector<D>,
        field: &View<'_>,
    ) -> (W::Four, [W::Four; D]);

    /// `sum_i field_i N_i` and, for each axis, `sum_i field_i dN_i/dx_a`.
    fn gather_gradient<W: Width>(&self, width: W, field: &View<'_>) -> (W::Four, [W::Four; D]);

    /// Moments of the weights.
    fn spread(&self) -> Spread<D>;

    /// Mean of `x_i - x_p` (m) and its variance (m^2) along each axis, where the patch has all nodes
    /// that the particle sees and its functions are products: there is no covariance.
    fn variance(&self) -> ([f64; D], [f64; D]);

    /// Calls `visit` for every node.
    fn visit(&self, grid: &Grid<D>, visit: impl FnMut(Seen<'_, D>));
}
