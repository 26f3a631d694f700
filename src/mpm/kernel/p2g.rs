//! From particles to nodes: mass, momentum and internal force in one visit.

use super::{
    batch::{Batch, ParticleBatches},
    moments::InertiaTensor,
    request::{Affine, Divergence, P2gRequest},
};
use crate::mpm::{
    algebra::{Matrix, Vector, array},
    basis::{Basis, PatchBatch, WeightNeeds},
    grid::Grid,
    packed_grid::FieldViewMut,
    particles::Particles,
    simd::{BATCH, LANES, Pass, Simd},
};
use std::{marker::PhantomData, ops::Range};

/// Maps what `maps` says to the nodes of two packed fields: momentum with mass in the last lane, and
/// force; of one where [`has_one_field`] says so.
pub(in crate::mpm) struct Scatter<'a, const D: usize, B> {
    pub(in crate::mpm) grid: &'a Grid<D>,
    pub(in crate::mpm) particles: &'a Particles<D>,
    /// The particles that give.
    pub(in crate::mpm) these: Range<usize>,
    pub(in crate::mpm) maps: &'a P2gRequest<'a, D>,
    pub(in crate::mpm) fields: [FieldViewMut<'a>; 2],
    pub(in crate::mpm) basis: PhantomData<B>,
}

/// Whether momentum, force and mass stand in one field, if they fit, and the nodes are visited once:
/// the force follows the momentum there.
pub(in crate::mpm) fn has_one_field<const D: usize>(
    particles: &Particles<D>,
    maps: &P2gRequest<'_, D>,
) -> bool {
    let by_gradient =
        maps.force == Some(Divergence::Gradient) && particles.current_position.is_empty();
    2 * D < LANES && maps.momentum.is_some() && by_gradient
}

/// The columns of a matrix, as fours, from lane `from` on.
#[inline(always)]
fn columns<S: Simd, const D: usize>(simd: S, matrix: &Matrix<D>, from: usize) -> [S::F64x4; D] {
    array(simd.load([0.0; 4]), |axis| {
        let mut lanes = [0.0; 4];
        for row in 0..D {
            lanes[(from + row) % LANES] = matrix[(row, axis)];
        }
        simd.load(lanes)
    })
}

/// Momentum and mass of a particle, as a four.
#[inline(always)]
fn inertial<S: Simd, const D: usize>(simd: S, m: f64, v: &Vector<D>) -> S::F64x4 {
    let mut lanes = [0.0, 0.0, 0.0, 1.0];
    for axis in 0..D {
        lanes[axis] = v[axis];
    }
    simd.load(lanes) * m
}

/// `matrix D_p^-1`, as fours: D_p is that of the patch of this lane, if it has all nodes that the
/// particle sees, or of all its patches.
#[inline(always)]
fn divide<B: Basis, S: Simd, const D: usize>(
    (simd, patches, lane): (S, &Batch<B, D>, usize),
    of_all: Option<&InertiaTensor<D>>,
    matrix: &Matrix<D>,
    h: f64,
) -> [S::F64x4; D] {
    match of_all {
        None => patches.divide::<S>(lane, &columns(simd, matrix, 0)),
        Some(of_all) => columns(simd, &of_all.divide(matrix, h), 0),
    }
}

impl<const D: usize, B: Basis> Scatter<'_, D, B> {
    /// Momentum, with mass in the last lane; mass alone where no momentum is shown.
    #[inline(always)]
    fn momentum<S: Simd>(
        &mut self,
        simd: S,
        (first, lanes): (usize, Range<usize>),
        patches: &Batch<B, D>,
        of_all: Option<&InertiaTensor<D>>,
    ) {
        let (h, maps) = (self.grid.h, self.maps);
        let mut accumulator = Batch::<B, D>::accumulator(simd, self.fields[0].reborrow());
        let here = first + lanes.start..first + lanes.end;
        let masses = lanes.zip(&self.particles.mass[here.clone()]);
        let Some(shown) = &maps.momentum else {
            for (lane, m) in masses {
                patches.scatter(lane, simd.load([0.0, 0.0, 0.0, *m]), &mut accumulator);
            }
            return Batch::<B, D>::flush(accumulator);
        };
        let shown_here = masses.zip(&shown.v[here.clone()]);
        match shown.affine {
            None => {
                for ((lane, m), v) in shown_here {
                    patches.scatter(lane, inertial(simd, *m, v), &mut accumulator);
                }
            }
            Some(Affine::Slope(c)) => {
                for (((lane, m), v), c) in shown_here.zip(&c[here]) {
                    let slope = columns(simd, c, 0);
                    let slope = array(slope[0], |axis| slope[axis] * *m);
                    patches.scatter_affine(lane, (inertial(simd, *m, v), &slope), &mut accumulator);
                }
            }
            Some(Affine::Moment(b)) => {
                for (((lane, m), v), b) in shown_here.zip(&b[here]) {
                    let slope = divide::<B, S, D>((simd, patches, lane), of_all, b, h);
                    let slope = array(slope[0], |axis| slope[axis] * *m);
                    patches.scatter_affine(lane, (inertial(simd, *m, v), &slope), &mut accumulator);
                }
            }
        }
        Batch::<B, D>::flush(accumulator);
    }

    #[inline(always)]
    fn force<S: Simd>(
        &mut self,
        simd: S,
        divergence: Divergence,
        (first, lanes): (usize, Range<usize>),
        patches: &Batch<B, D>,
        of_all: Option<&InertiaTensor<D>>,
    ) {
        let (h, particles) = (self.grid.h, self.particles);
        let mut accumulator = Batch::<B, D>::accumulator(simd, self.fields[1].reborrow());
        let here = first + lanes.start..first + lanes.end;
        if divergence == Divergence::Fit {
            for lane in lanes {
                let flux = -particles.flux(first + lane);
                let slope = divide::<B, S, D>((simd, patches, lane), of_all, &flux, h);
                patches.scatter_affine(lane, (simd.splat(0.0), &slope), &mut accumulator);
            }
        } else if particles.current_position.is_empty() {
            // What `flux` does, with one look at the columns for all.
            let sigma = lanes.zip(&particles.sigma[here.clone()]);
            for ((lane, sigma), vol) in sigma.zip(&particles.vol[here]) {
                let flux = columns(simd, &-(sigma * *vol), 0);
                patches.scatter_flux(lane, &flux, &mut accumulator);
            }
        } else {
            for lane in lanes {
                let flux = columns(simd, &-particles.flux(first + lane), 0);
                patches.scatter_flux(lane, &flux, &mut accumulator);
            }
        }
        Batch::<B, D>::flush(accumulator);
    }

    /// Mass, momentum and force to one field.
    #[inline(always)]
    fn all<S: Simd>(
        &mut self,
        simd: S,
        (first, lanes): (usize, Range<usize>),
        patches: &Batch<B, D>,
        of_all: Option<&InertiaTensor<D>>,
    ) {
        let (h, particles) = (self.grid.h, self.particles);
        let Some(shown) = &self.maps.momentum else { return };
        let mut accumulator = Batch::<B, D>::accumulator(simd, self.fields[0].reborrow());
        let here = first + lanes.start..first + lanes.end;
        let inertias = lanes.zip(&particles.mass[here.clone()]).zip(&shown.v[here.clone()]);
        let fluxes = particles.sigma[here.clone()].iter().zip(&particles.vol[here]);
        for (((lane, m), v), (sigma, vol)) in inertias.zip(fluxes) {
            let slope = shown.affine.map(|affine| {
                let slope = match affine {
                    Affine::Slope(c) => columns(simd, &c[first + lane], 0),
                    Affine::Moment(b) => {
                        divide::<B, S, D>((simd, patches, lane), of_all, &b[first + lane], h)
                    }
                };
                slope[0] * *m
            });
            let flux = columns(simd, &-(sigma * *vol), D)[0];
            patches.scatter_all(lane, (inertial(simd, *m, v), slope), flux, &mut accumulator);
        }
        Batch::<B, D>::flush(accumulator);
    }
}

impl<const D: usize, B: Basis> Pass for Scatter<'_, D, B> {
    const NEEDS_32_REGISTERS: bool = false;

    #[inline(always)]
    fn run<S: Simd>(mut self, simd: S) {
        let Self { grid, particles, maps, .. } = self;
        let these = std::mem::take(&mut self.these);
        let is_affine = maps.momentum.is_some_and(|shown| shown.affine.is_some())
            || maps.force == Some(Divergence::Fit);
        let wants_inertia = maps.mass || maps.momentum.is_some();
        let has_one_field = has_one_field(particles, maps);
        let layout = self.fields[usize::from(!wants_inertia)].layout;
        let mut patches = Batch::<B, D>::none();
        let slopes = maps.force == Some(Divergence::Gradient);
        let needs = WeightNeeds { slopes, offsets: is_affine };
        let batches = ParticleBatches::<B, D>::new((grid, layout), particles, needs);
        for first in these.step_by(BATCH) {
            batches.visit(
                simd,
                first,
                &mut patches,
                #[inline(always)]
                |patches, lanes, of_all| {
                    patches.compute_row_weights(simd, &lanes);
                    if is_affine {
                        patches.compute_offsets(
                            simd,
                            &lanes,
                            grid.h,
                            of_all.map(|of_all| &of_all.mean),
                        );
                    }
                    if has_one_field {
                        return self.all(simd, (first, lanes), patches, of_all);
                    }
                    if wants_inertia {
                        self.momentum(simd, (first, lanes.clone()), patches, of_all);
                    }
                    if let Some(divergence) = maps.force {
                        self.force(simd, divergence, (first, lanes), patches, of_all);
                    }
                },
            );
        }
    }
}
