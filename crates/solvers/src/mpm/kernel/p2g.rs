//! P2G: mass, momentum and internal force, computed in one loop over the nodes of a particle.

use super::batch::{Batch, ParticleBatches, columns, divide};
use super::contract::{Affine, Divergence, P2gRequest};
use super::source::{AnyBasis, PatchSource};
use crate::mpm::basis::{NodeTerm, ProductBatch, WeightNeeds};
use crate::mpm::foundation::algebra::{Matrix, Vector, array};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::moments::WeightMoments;
use crate::mpm::foundation::packed_grid::{FieldViewMut, PackedNode, force_lane};
use crate::mpm::foundation::particles::Particles;
use crate::mpm::foundation::simd::{BATCH, Plain, Simd, SimdPass};
use std::hint::black_box;
use std::ops::Range;

pub(in crate::mpm) struct Scatter<'a, const D: usize, P, N> {
    pub(in crate::mpm) grid: &'a Grid<D>,
    pub(in crate::mpm) particles: &'a Particles<D>,
    pub(in crate::mpm) range: Range<usize>,
    pub(in crate::mpm) request: &'a P2gRequest<'a, D>,
    pub(in crate::mpm) field: FieldViewMut<'a, N>,
    pub(in crate::mpm) source: P,
}

/// Whether a request needs nodes of eight numbers: in more than one dimension, four numbers cannot
/// hold momentum, mass and force.
pub(in crate::mpm) fn wants_wide_nodes<const D: usize>(request: &P2gRequest<'_, D>) -> bool {
    request.force.is_some() && (request.mass || request.momentum.is_some())
}

/// Columns of the particles, starting with the first particle of a batch. Indexing the columns of
/// [`Particles`] would load their address and check the index for each particle.
#[derive(Clone, Copy)]
struct ParticleColumns<'a, const D: usize> {
    mass: &'a [f64],
    v: &'a [Vector<D>],
    /// Stresses and volumes, both empty for a body without stresses. `None` in the total-Lagrangian
    /// frame.
    stress: Option<(&'a [Matrix<D>], &'a [f64])>,
}

impl<'a, const D: usize> ParticleColumns<'a, D> {
    #[inline(always)]
    fn new(particles: &'a Particles<D>, request: &'a P2gRequest<'a, D>, first: usize) -> Self {
        // Lanes that the request does not need are never copied to the grid. For a body at rest,
        // which has no velocities, positions can therefore take their place.
        let v = request.momentum.map_or(&*particles.x, |field| field.v);
        let stress = if particles.current_position.is_empty() {
            let sigma = particles.sigma.get(first..).unwrap_or_default();
            Some((sigma, particles.vol.get(first..).unwrap_or_default()))
        } else {
            None
        };
        Self { mass: &particles.mass[first..], v: &v[first..], stress }
    }

    /// Shortens the columns to `end` particles, so that smaller indices need no check. Without a
    /// `force`, the stresses are omitted.
    #[inline(always)]
    fn up_to(self, end: usize, force: bool) -> Self {
        let stress = match self.stress {
            Some((sigma, volume)) if force => Some((&sigma[..end], &volume[..end])),
            _ => None,
        };
        Self { mass: &self.mass[..end], v: &self.v[..end], stress }
    }

    /// Returns the momentum of particle `first + lane`, with its mass in the last lane.
    #[inline(always)]
    fn inertial<S: Simd>(&self, simd: S, lane: usize) -> S::F64x4 {
        let mut lanes = [0.0, 0.0, 0.0, 1.0];
        for axis in 0..D {
            lanes[axis] = self.v[lane][axis];
        }
        simd.load(lanes) * self.mass[lane]
    }

    /// Returns the columns of `-V sigma` (J) of particle `first + lane`, or of the corresponding
    /// flux in the total-Lagrangian frame.
    #[inline(always)]
    fn flux<S: Simd>(
        &self,
        simd: S,
        particles: &Particles<D>,
        first: usize,
        lane: usize,
    ) -> [S::F64x4; D] {
        let Some((sigma, volume)) = self.stress else {
            let flux = columns(simd, &particles.flux(first + lane), force_lane(D));
            return array(flux[0], |axis| flux[axis] * -1.0);
        };
        // The columns are scaled separately. A product matrix in memory would be slow, because
        // store-to-load forwarding fails when its columns are loaded.
        let stress = columns(simd, &sigma[lane], force_lane(D));
        array(simd.splat(0.0), |axis| stress[axis] * -volume[lane])
    }
}

/// Particles `first + lanes` with their patches. For a particle with several patches, `of_all`
/// contains the moments of all its patches.
struct Visit<'a, const D: usize, P: PatchSource<D>> {
    first: usize,
    lanes: Range<usize>,
    patches: &'a Batch<P, D>,
    of_all: Option<&'a WeightMoments<D>>,
    source: ParticleColumns<'a, D>,
}

impl<const D: usize, P: PatchSource<D>, N: PackedNode> Scatter<'_, D, P, N> {
    /// Whether a node has lanes for momentum and mass in addition to a force.
    const HOLDS_ALL: bool = N::IS_WIDE || D == 1;

    /// Adds the contributions of particles to their nodes. If `SLOPE` is true, the contributions
    /// have an affine part; if `FLUX` is true, they have a part along the gradient of the basis
    /// function.
    #[inline(always)]
    fn add<S: Simd, const SLOPE: bool, const FLUX: bool>(
        &mut self,
        simd: S,
        Visit { first, lanes, patches, of_all, source }: Visit<'_, D, P>,
    ) {
        let Self { grid, particles, request, .. } = self;
        let (zero, h) = (simd.splat(0.0), grid.h);
        let affine = request.momentum.and_then(|field| field.affine);
        let is_fit = request.force == Some(Divergence::Fit);
        let has_inertia = Self::HOLDS_ALL || !(FLUX || is_fit);
        let source = source.up_to(lanes.end, FLUX || is_fit);
        patches.scatter(
            simd,
            self.field.reborrow(),
            lanes,
            #[inline(always)]
            |lane| {
                let p = first + lane;
                let value = if has_inertia { source.inertial(simd, lane) } else { zero };
                let mut term = NodeTerm::NONE;
                if Self::HOLDS_ALL || !FLUX {
                    term.value = Some(N::of_inertia(simd, value));
                }
                if SLOPE {
                    let growth = match affine {
                        None => [zero; D],
                        Some(Affine::Slope(c)) => columns(simd, &c[p], 0),
                        Some(Affine::Moment(b)) => {
                            let b = columns(simd, &b[p], 0);
                            divide::<P, S, D>(simd, patches, lane, of_all, &b, 0, h)
                        }
                    };
                    let (mut slope, mut fit) = ([N::zero(simd); D], None);
                    if is_fit {
                        let (force, from) =
                            (source.flux(simd, particles, first, lane), force_lane(D));
                        fit = Some(divide::<P, S, D>(simd, patches, lane, of_all, &force, from, h));
                    }
                    for axis in 0..D {
                        let growth = growth[axis] * source.mass[lane];
                        slope[axis] = match &fit {
                            Some(fit) => N::join(simd, growth, fit[axis]),
                            None => N::of_inertia(simd, growth),
                        };
                    }
                    term.slope = Some(slope);
                }
                if FLUX {
                    let (columns, mut flux) =
                        (source.flux(simd, particles, first, lane), [N::zero(simd); D]);
                    for axis in 0..D {
                        flux[axis] = N::of_force(simd, columns[axis]);
                    }
                    term.flux = Some(flux);
                }
                term
            },
        );
    }
}

impl<const D: usize, P: PatchSource<D>, N: PackedNode> SimdPass for Scatter<'_, D, P, N> {
    const NEEDS_AVX512: bool = N::IS_WIDE;

    #[inline(always)]
    fn run<S: Simd>(mut self, simd: S) {
        let Self { grid, particles, request, source: basis, .. } = self;
        let range = std::mem::take(&mut self.range);
        let has_slope = request.momentum.is_some_and(|field| field.affine.is_some())
            || request.force == Some(Divergence::Fit);
        let has_flux = request.force == Some(Divergence::Gradient);
        let mut patches = ProductBatch::new(basis.shape());
        let needs = WeightNeeds { slopes: has_flux, offsets: has_slope };
        let batches = ParticleBatches::new(basis, grid, self.field.layout, particles, needs);
        for first in range.step_by(BATCH) {
            let source = ParticleColumns::new(particles, request, first);
            batches.visit(
                simd,
                first,
                &mut patches,
                #[inline(always)]
                |patches, lanes, of_all| {
                    patches.compute_row_weights(simd, &lanes);
                    if has_slope {
                        let mean = of_all.map(|of_all| &of_all.mean);
                        patches.compute_offsets(simd, &lanes, grid.h, mean);
                    }
                    let visit = Visit { first, lanes, patches, of_all, source };
                    match (has_slope, has_flux) {
                        (true, true) if const { Self::HOLDS_ALL } => {
                            self.add::<S, true, true>(simd, visit);
                        }
                        (true, _) => self.add::<S, true, false>(simd, visit),
                        (false, true) => self.add::<S, false, true>(simd, visit),
                        (false, false) if const { N::IS_WIDE } => {}
                        (false, false) => self.add::<S, false, false>(simd, visit),
                    }
                },
            );
        }
    }

    fn run_plain(self) {
        let Self { grid, particles, range, request, field, source } = self;
        let source = black_box(source.for_any_basis());
        Scatter { grid, particles, range, request, field, source }.run_for_any_basis();
    }
}

impl<const D: usize, N: PackedNode> Scatter<'_, D, AnyBasis<D>, N> {
    /// Runs the loop. The function is not inlined, and callers hide the basis from the compiler.
    /// Otherwise the compiler would optimise one loop for each basis.
    #[inline(never)]
    fn run_for_any_basis(self) {
        self.run(Plain);
    }
}
