//! From particles to nodes: mass, momentum and internal force in one visit.

use super::{
    batch::{ParticleBatches, Several},
    moments::InertiaTensor,
    request::{Affine, Divergence, P2gRequest},
};
use crate::mpm::{
    algebra::{Matrix, Vector, array},
    basis::{Basis, Needs, PatchBatch},
    grid::Grid,
    packed_grid::ViewMut,
    particles::Particles,
    simd::{FOUR, LANES, Pass, Width},
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
    pub(in crate::mpm) fields: [ViewMut<'a>; 2],
    pub(in crate::mpm) basis: PhantomData<B>,
}

/// Whether momentum, force and mass stand in one field, if they fit, and the nodes are visited once:
/// the force follows the momentum there.
pub(in crate::mpm) fn has_one_field<const D: usize>(
    particles: &Particles<D>,
    maps: &P2gRequest<'_, D>,
) -> bool {
    let by_gradient = maps.force == Some(Divergence::Gradient) && particles.moved.is_empty();
    2 * D < FOUR && maps.momentum.is_some() && by_gradient
}

/// The columns of a matrix, as fours, from lane `from` on.
#[inline(always)]
fn columns<W: Width, const D: usize>(width: W, matrix: &Matrix<D>, from: usize) -> [W::Four; D] {
    array(width.four([0.0; 4]), |axis| {
        let mut lanes = [0.0; 4];
        for row in 0..D {
            lanes[(from + row) % FOUR] = matrix[(row, axis)];
        }
        width.four(lanes)
    })
}

/// Momentum and mass of a particle, as a four.
#[inline(always)]
fn inertial<W: Width, const D: usize>(width: W, m: f64, v: &Vector<D>) -> W::Four {
    let mut lanes = [0.0, 0.0, 0.0, 1.0];
    for axis in 0..D {
        lanes[axis] = v[axis];
    }
    width.four(lanes) * m
}

/// `matrix D_p^-1`, as fours: D_p is that of the patch of this lane, if it has all nodes that the
/// particle sees, or of all its patches.
#[inline(always)]
fn divide<B: Basis, W: Width, const D: usize>(
    (width, patches, lane): (W, &Several<B, D>, usize),
    of_all: Option<&InertiaTensor<D>>,
    matrix: &Matrix<D>,
    h: f64,
) -> [W::Four; D] {
    match of_all {
        None => patches.divide::<W>(lane, &columns(width, matrix, 0)),
        Some(of_all) => columns(width, &of_all.divide(matrix, h), 0),
    }
}

impl<const D: usize, B: Basis> Scatter<'_, D, B> {
    /// Momentum, with mass in the last lane; mass alone where no momentum is shown.
    #[inline(always)]
    fn momentum<W: Width>(
        &mut self,
        width: W,
        (first, lanes): (usize, Range<usize>),
        patches: &Several<B, D>,
        of_all: Option<&InertiaTensor<D>>,
    ) {
        let (h, maps) = (self.grid.h, self.maps);
        let mut sink = Several::<B, D>::sink(width, self.fields[0].again());
        let here = first + lanes.start..first + lanes.end;
        let masses = lanes.zip(&self.particles.mass[here.clone()]);
        let Some(shown) = &maps.momentum else {
            for (lane, m) in masses {
                patches.scatter(lane, width.four([0.0, 0.0, 0.0, *m]), &mut sink);
            }
            return Several::<B, D>::put(sink);
        };
        let shown_here = masses.zip(&shown.v[here.clone()]);
        match shown.affine {
            None => {
                for ((lane, m), v) in shown_here {
                    patches.scatter(lane, inertial(width, *m, v), &mut sink);
                }
            }
            Some(Affine::Slope(c)) => {
                for (((lane, m), v), c) in shown_here.zip(&c[here]) {
                    let slope = columns(width, c, 0);
                    let slope = array(slope[0], |axis| slope[axis] * *m);
                    patches.scatter_affine(lane, (inertial(width, *m, v), &slope), &mut sink);
                }
            }
            Some(Affine::Moment(b)) => {
                for (((lane, m), v), b) in shown_here.zip(&b[here]) {
                    let slope = divide::<B, W, D>((width, patches, lane), of_all, b, h);
                    let slope = array(slope[0], |axis| slope[axis] * *m);
                    patches.scatter_affine(lane, (inertial(width, *m, v), &slope), &mut sink);
                }
            }
        }
        Several::<B, D>::put(sink);
    }

    #[inline(always)]
    fn force<W: Width>(
        &mut self,
        width: W,
        divergence: Divergence,
        (first, lanes): (usize, Range<usize>),
        patches: &Several<B, D>,
        of_all: Option<&InertiaTensor<D>>,
    ) {
        let (h, particles) = (self.grid.h, self.particles);
        let mut sink = Several::<B, D>::sink(width, self.fields[1].again());
        let here = first + lanes.start..first + lanes.end;
        if divergence == Divergence::Fit {
            for lane in lanes {
                let flux = -particles.flux(first + lane);
                let slope = divide::<B, W, D>((width, patches, lane), of_all, &flux, h);
                patches.scatter_affine(lane, (width.all(0.0), &slope), &mut sink);
            }
        } else if particles.moved.is_empty() {
            // What `flux` does, with one look at the columns for all.
            let sigma = lanes.zip(&particles.sigma[here.clone()]);
            for ((lane, sigma), vol) in sigma.zip(&particles.vol[here]) {
                let flux = columns(width, &-(sigma * *vol), 0);
                patches.scatter_flux(lane, &flux, &mut sink);
            }
        } else {
            for lane in lanes {
                let flux = columns(width, &-particles.flux(first + lane), 0);
                patches.scatter_flux(lane, &flux, &mut sink);
            }
        }
        Several::<B, D>::put(sink);
    }

    /// Mass, momentum and force to one field.
    #[inline(always)]
    fn all<W: Width>(
        &mut self,
        width: W,
        (first, lanes): (usize, Range<usize>),
        patches: &Several<B, D>,
        of_all: Option<&InertiaTensor<D>>,
    ) {
        let (h, particles) = (self.grid.h, self.particles);
        let Some(shown) = &self.maps.momentum else { return };
        let mut sink = Several::<B, D>::sink(width, self.fields[0].again());
        let here = first + lanes.start..first + lanes.end;
        let inertias = lanes.zip(&particles.mass[here.clone()]).zip(&shown.v[here.clone()]);
        let fluxes = particles.sigma[here.clone()].iter().zip(&particles.vol[here]);
        for (((lane, m), v), (sigma, vol)) in inertias.zip(fluxes) {
            let slope = shown.affine.map(|affine| {
                let slope = match affine {
                    Affine::Slope(c) => columns(width, &c[first + lane], 0),
                    Affine::Moment(b) => {
                        divide::<B, W, D>((width, patches, lane), of_all, &b[first + lane], h)
                    }
                };
                slope[0] * *m
            });
            let flux = columns(width, &-(sigma * *vol), D)[0];
            patches.scatter_all(lane, (inertial(width, *m, v), slope), flux, &mut sink);
        }
        Several::<B, D>::put(sink);
    }
}

impl<const D: usize, B: Basis> Pass for Scatter<'_, D, B> {
    const NEEDS_REGISTERS: bool = false;

    #[inline(always)]
    fn run<W: Width>(mut self, width: W) {
        let Self { grid, particles, maps, .. } = self;
        let these = std::mem::take(&mut self.these);
        let is_affine = maps.momentum.is_some_and(|shown| shown.affine.is_some())
            || maps.force == Some(Divergence::Fit);
        let wants_inertia = maps.mass || maps.momentum.is_some();
        let has_one_field = has_one_field(particles, maps);
        let layout = self.fields[usize::from(!wants_inertia)].layout;
        let mut patches = Several::<B, D>::none();
        let slopes = maps.force == Some(Divergence::Gradient);
        let needs = Needs { slopes, places: is_affine };
        let sight = ParticleBatches::<B, D>::new((grid, layout), particles, needs);
        for first in these.step_by(LANES) {
            sight.of(
                width,
                first,
                &mut patches,
                #[inline(always)]
                |patches, lanes, of_all| {
                    patches.cross(width, &lanes);
                    if is_affine {
                        patches.lever(width, &lanes, grid.h, of_all.map(|of_all| &of_all.mean));
                    }
                    if has_one_field {
                        return self.all(width, (first, lanes), patches, of_all);
                    }
                    if wants_inertia {
                        self.momentum(width, (first, lanes.clone()), patches, of_all);
                    }
                    if let Some(divergence) = maps.force {
                        self.force(width, divergence, (first, lanes), patches, of_all);
                    }
                },
            );
        }
    }
}
