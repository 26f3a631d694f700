//! What a basis is to the rest of the solver.

use crate::mpm::{algebra::Vector, grid::Grid};

/// Weights and gradients of the K nodes per axis that a point sees, as factors per axis: the
/// tensor product is formed where it is used.
#[derive(Debug, Clone, Copy)]
pub struct Stencil<const D: usize, const K: usize> {
    /// Index of the first node on each axis.
    pub first: [usize; D],
    /// One-dimensional weights N, per axis.
    pub weight: [[f64; K]; D],
    /// One-dimensional gradients dN/dx (1/m), per axis.
    pub slope: [[f64; K]; D],
}

/// A family of basis functions N_i on the grid.
pub trait Basis: Sized + Sync + Send + 'static {
    /// Degree p of the polynomials that the basis reproduces.
    const DEGREE: u8;

    /// Whether sum N_i x_i = x holds (linear completeness); the law tests hold a basis to it.
    const REPRODUCES_LINEAR: bool;

    /// Calls `visit(node, N_i(x), grad N_i(x))` for every node that `x` sees, in the order of the
    /// node numbers. Does nothing where `x` is outside the grid: the solver reports that when it
    /// moves particles, not here.
    fn visit<const D: usize>(
        grid: &Grid<D>,
        x: &Vector<D>,
        visit: impl FnMut(usize, f64, &Vector<D>),
    );

    /// Nodes visited per particle in D dimensions: the unit of the work counter.
    fn support(dimension: usize) -> u64;
}

impl<const D: usize, const K: usize> Stencil<D, K> {
    /// Forms the tensor product, the first axis running fastest.
    #[inline]
    pub fn visit(&self, grid: &Grid<D>, mut visit: impl FnMut(usize, f64, &Vector<D>)) {
        for k in 0..K.pow(D as u32) {
            let (mut rest, mut index, mut at) = (k, [0; D], [0; D]);
            let mut weight = 1.0;
            for axis in 0..D {
                at[axis] = rest % K;
                rest /= K;
                index[axis] = self.first[axis] + at[axis];
                weight *= self.weight[axis][at[axis]];
            }
            let gradient = Vector::from_fn(|axis, _| self.gradient(axis, &at));
            visit(grid.node(&index), weight, &gradient);
        }
    }

    #[inline]
    fn gradient(&self, along: usize, at: &[usize; D]) -> f64 {
        let mut product = self.slope[along][at[along]];
        for axis in (0..D).filter(|&axis| axis != along) {
            product *= self.weight[axis][at[axis]];
        }
        product
    }
}
