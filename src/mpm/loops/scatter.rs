//! From particles to nodes: mass, momentum and internal force in one visit.

use super::inertia::inertia;
use crate::mpm::{
    algebra::{Matrix, array},
    basis::{Basis, Patch},
    four::{Pass, Width},
    grid::Grid,
    kernel::{Affine, Divergence, Maps, Shown},
    moments::Inertia,
    packed::ViewMut,
    particles::Particles,
};
use std::marker::PhantomData;

/// Maps what `maps` says to the nodes of two packed fields: momentum with mass in the last lane, and
/// force.
pub(super) struct Scatter<'a, const D: usize, B> {
    pub(super) grid: &'a Grid<D>,
    pub(super) particles: &'a Particles<D>,
    pub(super) maps: &'a Maps<'a, D>,
    pub(super) fields: [ViewMut<'a>; 2],
    pub(super) basis: PhantomData<B>,
}

/// The columns of a matrix, as fours.
#[inline(always)]
fn columns<W: Width, const D: usize>(width: W, matrix: &Matrix<D>) -> [W::Four; D] {
    array(width.four([0.0; 4]), |axis| {
        let mut lanes = [0.0; 4];
        for row in 0..D {
            lanes[row] = matrix[(row, axis)];
        }
        width.four(lanes)
    })
}

/// `matrix D_p^-1`.
#[inline(always)]
fn divide<B: Basis, const D: usize>(inertia: &Inertia<D>, matrix: &Matrix<D>, h: f64) -> Matrix<D> {
    if B::ONE_PATCH { inertia.divide_diagonal(matrix, h) } else { inertia.divide(matrix, h) }
}

impl<const D: usize, B: Basis> Scatter<'_, D, B> {
    /// Adds `(value + slope (x_i - mean)) N_i` to the nodes.
    #[inline(always)]
    fn affine<W: Width>(
        width: W,
        patch: &B::Patch<D>,
        (value, slope): (W::Four, Matrix<D>),
        inertia: &Inertia<D>,
        field: &mut ViewMut<'_>,
    ) {
        let slope = columns(width, &slope);
        patch.scatter_affine(width, (value, &inertia.mean), &slope, field);
    }

    #[inline(always)]
    fn momentum<W: Width>(
        &mut self,
        width: W,
        p: usize,
        shown: Option<&Shown<'_, D>>,
        patch: &B::Patch<D>,
        inertia: impl Fn() -> Inertia<D>,
    ) {
        let (m, field) = (self.particles.mass[p], &mut self.fields[0]);
        let mut lanes = [0.0, 0.0, 0.0, m];
        let Some(shown) = shown else { return patch.scatter(width, width.four(lanes), field) };
        for axis in 0..D {
            lanes[axis] = m * shown.v[p][axis];
        }
        let value = width.four(lanes);
        let Some(affine) = shown.affine else { return patch.scatter(width, value, field) };
        let inertia = inertia();
        let slope = match affine {
            Affine::Slope(c) => c[p],
            Affine::Moment(b) => divide::<B, D>(&inertia, &b[p], self.grid.h),
        };
        Self::affine(width, patch, (value, slope * m), &inertia, field);
    }

    #[inline(always)]
    fn force<W: Width>(
        &mut self,
        width: W,
        divergence: Divergence,
        flux: &Matrix<D>,
        patch: &B::Patch<D>,
        inertia: impl Fn() -> Inertia<D>,
    ) {
        let field = &mut self.fields[1];
        if divergence == Divergence::Gradient {
            return patch.scatter_flux(width, &columns(width, flux), field);
        }
        let inertia = inertia();
        let slope = divide::<B, D>(&inertia, flux, self.grid.h);
        Self::affine(width, patch, (width.four([0.0; 4]), slope), &inertia, field);
    }
}

impl<const D: usize, B: Basis> Pass for Scatter<'_, D, B> {
    #[inline(always)]
    fn run<W: Width>(mut self, width: W) {
        let Self { grid, particles, maps, .. } = self;
        let is_affine = maps.momentum.is_some_and(|shown| shown.affine.is_some());
        let of_all = !B::ONE_PATCH && (is_affine || maps.force == Some(Divergence::Fit));
        for p in 0..particles.len() {
            // Where there are several patches, their moments must be known before the first of them
            // is seen; where there is one, they follow from its weights at no cost.
            let of_all = of_all.then(|| inertia::<D, B>(grid, particles, p));
            let flux = maps.force.map(|divergence| (divergence, -particles.flux(p)));
            B::patches(
                grid,
                particles,
                p,
                #[inline(always)]
                |patch| {
                    let inertia = || of_all.unwrap_or_else(|| Inertia::diagonal(patch.variance()));
                    if maps.mass || maps.momentum.is_some() {
                        self.momentum(width, p, maps.momentum.as_ref(), patch, inertia);
                    }
                    if let Some((divergence, flux)) = &flux {
                        self.force(width, *divergence, flux, patch, inertia);
                    }
                },
            );
        }
    }
}
