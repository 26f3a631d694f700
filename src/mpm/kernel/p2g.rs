//! P2G: mass, momentum and internal force in one visit to the nodes of a particle.

use super::batch::{Batch, ParticleBatches};
use super::matrix_columns::{columns, divide};
use super::moments::InertiaTensor;
use super::request::{Affine, Divergence, P2gRequest};
use crate::mpm::algebra::Vector;
use crate::mpm::basis::{Basis, NodeTerm, PatchBatch, WeightNeeds};
use crate::mpm::grid::Grid;
use crate::mpm::packed_grid::FieldViewMut;
use crate::mpm::particles::Particles;
use crate::mpm::simd::{BATCH, LANES, Simd, SimdPass};
use std::marker::PhantomData;
use std::ops::Range;

/// Pass of P2G to two packed fields: momentum with mass in the last lane, and force; or to one
/// field that holds all ([`has_one_field`]).
pub(in crate::mpm) struct Scatter<'a, const D: usize, B> {
    pub(in crate::mpm) grid: &'a Grid<D>,
    pub(in crate::mpm) particles: &'a Particles<D>,
    /// Particles of the pass.
    pub(in crate::mpm) range: Range<usize>,
    pub(in crate::mpm) request: &'a P2gRequest<'a, D>,
    pub(in crate::mpm) fields: [FieldViewMut<'a>; 2],
    pub(in crate::mpm) basis: PhantomData<B>,
}

/// Whether one packed field holds momentum, force (in this order) and mass (in the last lane), so
/// that nodes are visited once: in 1-D.
pub(in crate::mpm) fn has_one_field<const D: usize>(
    particles: &Particles<D>,
    request: &P2gRequest<'_, D>,
) -> bool {
    let by_gradient =
        request.force == Some(Divergence::Gradient) && particles.current_position.is_empty();
    fits_one_field::<D>() && request.momentum.is_some() && by_gradient
}

/// Whether momentum, force and mass are at most four numbers.
const fn fits_one_field<const D: usize>() -> bool {
    2 * D < LANES
}

/// Momentum and, in the last lane, mass of a particle.
#[inline(always)]
fn inertial<S: Simd, const D: usize>(simd: S, m: f64, v: &Vector<D>) -> S::F64x4 {
    let mut lanes = [0.0, 0.0, 0.0, 1.0];
    for axis in 0..D {
        lanes[axis] = v[axis];
    }
    simd.load(lanes) * m
}

impl<const D: usize, B: Basis> Scatter<'_, D, B> {
    /// Momentum, with mass in the last lane; mass alone where no momentum is asked for.
    #[inline(always)]
    fn momentum<S: Simd>(
        &mut self,
        simd: S,
        (first, lanes): (usize, Range<usize>),
        patches: &Batch<B, D>,
        of_all: Option<&InertiaTensor<D>>,
    ) {
        let (h, here) = (self.grid.h, first + lanes.start..first + lanes.end);
        let (field, mass) = (self.fields[0].reborrow(), &self.particles.mass[here.clone()]);
        let Some(of) = &self.request.momentum else {
            return patches.scatter(
                simd,
                field,
                lanes.zip(mass),
                #[inline(always)]
                |_, m| NodeTerm { value: Some(simd.load([0.0, 0.0, 0.0, *m])), ..NodeTerm::NONE },
            );
        };
        let particles = mass.iter().zip(&of.v[here.clone()]);
        match of.affine {
            None => patches.scatter(
                simd,
                field,
                lanes.zip(particles),
                #[inline(always)]
                |_, (m, v)| NodeTerm { value: Some(inertial(simd, *m, v)), ..NodeTerm::NONE },
            ),
            Some(affine) => patches.scatter(
                simd,
                field,
                lanes.zip(particles.zip(&affine.state()[here])),
                #[inline(always)]
                |lane, ((m, v), state)| {
                    let slope = match affine {
                        Affine::Slope(_) => columns(simd, state, 0),
                        Affine::Moment(_) => {
                            let state = columns(simd, state, 0);
                            divide::<B, S, D>((simd, patches, lane), of_all, &state, h)
                        }
                    };
                    NodeTerm::affine(inertial(simd, *m, v), slope, *m)
                },
            ),
        }
    }

    /// Internal force.
    #[inline(always)]
    fn force<S: Simd>(
        &mut self,
        simd: S,
        divergence: Divergence,
        (first, lanes): (usize, Range<usize>),
        patches: &Batch<B, D>,
        of_all: Option<&InertiaTensor<D>>,
    ) {
        let (h, particles, field) = (self.grid.h, self.particles, self.fields[1].reborrow());
        if divergence == Divergence::Fit {
            patches.scatter(
                simd,
                field,
                lanes.map(|lane| (lane, ())),
                #[inline(always)]
                |lane, ()| {
                    let flux = columns(simd, &-particles.flux(first + lane), 0);
                    let slope = divide::<B, S, D>((simd, patches, lane), of_all, &flux, h);
                    let value = Some(simd.splat(0.0));
                    NodeTerm { value, slope: Some(slope), flux: None }
                },
            );
        } else if particles.current_position.is_empty() {
            // `flux`, with the choice of its columns taken out of the loop.
            let here = first + lanes.start..first + lanes.end;
            let stresses = particles.sigma[here.clone()].iter().zip(&particles.vol[here]);
            patches.scatter(
                simd,
                field,
                lanes.zip(stresses),
                #[inline(always)]
                |_, (sigma, vol)| NodeTerm::flux(columns(simd, &-(sigma * *vol), 0)),
            );
        } else {
            patches.scatter(
                simd,
                field,
                lanes.map(|lane| (lane, ())),
                #[inline(always)]
                |lane, ()| NodeTerm::flux(columns(simd, &-particles.flux(first + lane), 0)),
            );
        }
    }

    /// Mass, momentum and force in one field.
    #[inline(always)]
    fn all<S: Simd>(
        &mut self,
        simd: S,
        (first, lanes): (usize, Range<usize>),
        patches: &Batch<B, D>,
        of_all: Option<&InertiaTensor<D>>,
    ) {
        let (h, particles) = (self.grid.h, self.particles);
        let Some(of) = &self.request.momentum else { return };
        let here = first + lanes.start..first + lanes.end;
        let inertias = particles.mass[here.clone()].iter().zip(&of.v[here.clone()]);
        let stresses = particles.sigma[here.clone()].iter().zip(&particles.vol[here]);
        patches.scatter(
            simd,
            self.fields[0].reborrow(),
            lanes.zip(inertias.zip(stresses)),
            #[inline(always)]
            |lane, ((m, v), (sigma, vol))| {
                let (value, flux) = (inertial(simd, *m, v), columns(simd, &-(sigma * *vol), D));
                let slope = match of.affine {
                    None => return NodeTerm { value: Some(value), ..NodeTerm::flux(flux) },
                    Some(Affine::Slope(c)) => columns(simd, &c[first + lane], 0),
                    Some(Affine::Moment(b)) => {
                        let b = columns(simd, &b[first + lane], 0);
                        divide::<B, S, D>((simd, patches, lane), of_all, &b, h)
                    }
                };
                NodeTerm { flux: Some(flux), ..NodeTerm::affine(value, slope, *m) }
            },
        );
    }
}

impl<const D: usize, B: Basis> SimdPass for Scatter<'_, D, B> {
    const NEEDS_32_REGISTERS: bool = false;

    #[inline(always)]
    fn run<S: Simd>(mut self, simd: S) {
        let Self { grid, particles, request, .. } = self;
        let range = std::mem::take(&mut self.range);
        let is_affine = request.momentum.is_some_and(|shown| shown.affine.is_some())
            || request.force == Some(Divergence::Fit);
        let wants_inertia = request.mass || request.momentum.is_some();
        let has_one_field = has_one_field(particles, request);
        let layout = self.fields[usize::from(!wants_inertia)].layout;
        let mut patches = Batch::<B, D>::none();
        let slopes = request.force == Some(Divergence::Gradient);
        let needs = WeightNeeds { slopes, offsets: is_affine };
        let batches = ParticleBatches::<B, D>::new((grid, layout), particles, needs);
        for first in range.step_by(BATCH) {
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
                    // Known in each dimension: where it is false, the loop is not compiled.
                    if const { fits_one_field::<D>() } && has_one_field {
                        return self.all(simd, (first, lanes), patches, of_all);
                    }
                    if wants_inertia {
                        self.momentum(simd, (first, lanes.clone()), patches, of_all);
                    }
                    if let Some(divergence) = request.force {
                        self.force(simd, divergence, (first, lanes), patches, of_all);
                    }
                },
            );
        }
    }
}
