//! GIMP: linear functions averaged over the particle's domain (Bardenhagen & Kober 2004, CMES 5,
//! eqs 30-32).
//!
//! `N_i = 1/(2l) int hat_i` over `[x - l, x + l]`, `N_i' = (hat_i(x + l) - hat_i(x - l))/(2l)`. In
//! several dimensions the domain remains aligned with the axes. uGIMP uses the reference size. In
//! contiguous-particle GIMP (Wallstedt & Guilkey 2008) the half-length along an axis is multiplied
//! by the diagonal entry of F, so that domains neither separate nor overlap. At walls the domain is
//! truncated.
//!
//! Four particles are processed at a time if their domains reach at most three nodes along each
//! axis. Otherwise one particle is processed at a time, in groups of three nodes.

use super::cell_locator::{CellLocator, CellPositions};
use super::contract::{Basis, Domain, FourLanes, LoopsUser, NodeWeight, Patch};
use super::product::Product;
use super::product_batch::ProductBatch;
use super::shape::PatchShape;
use super::weights_1d::{Weights1d, WeightsSimd};
use crate::mpm::foundation::algebra::{Matrix, Vector, array};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::foundation::simd::{F64x4, LANES, Plain, Simd};

/// GIMP, whose domains either follow the deformation or have constant size.
#[derive(Debug, Clone, Copy)]
pub struct Gimp<const FOLLOWS: bool>;

/// GIMP with domains of constant size.
pub type UniformGimp = Gimp<false>;

/// GIMP with domains that follow the deformation.
pub type ContiguousGimp = Gimp<true>;

/// Returns the half-length (m) of the domain of particle `p` along `axis`. Particles of uGIMP have
/// no column of domains, so both kinds of GIMP share their loops.
#[inline(always)]
fn half<const D: usize>(particles: &Particles<D>, p: usize, axis: usize) -> f64 {
    particles.domain.get(p).map_or(0.5 * particles.spacing[axis], |r| r[(axis, axis)])
}

#[cold]
#[inline(never)]
fn last<const D: usize>(particles: &Particles<D>, first: usize, axis: usize) -> [f64; LANES] {
    array(0.0, |k| half(particles, first + k, axis))
}

/// If the `first` node of a domain lies before the start of a periodic axis, wraps it.
#[cold]
#[inline(never)]
fn beyond_seam<const D: usize>(grid: &Grid<D>, axis: usize, first: [f64; LANES]) -> [f64; LANES] {
    first.map(|first| grid.wrap_signed(first, axis) as f64)
}

#[cold]
#[inline(never)]
fn not_below_zero(four: [f64; LANES]) -> u32 {
    (0..LANES).map(|k| u32::from(four[k] >= 0.0) << k).sum()
}

/// Whether the domain of a particle at `x` with the half-length `half` (m) is inside the walls
/// along `axis` and has a node in its interior.
fn is_bent<const D: usize>(grid: &Grid<D>, x: &Vector<D>, axis: usize, half: f64) -> bool {
    let (at, half) = (grid.wrapped(x, axis), half.abs() * grid.inverse_h());
    let (low, high) = (at - half, at + half);
    let is_inside = grid.periodic[axis] || (low >= 0.0 && high <= grid.cells[axis] as f64);
    is_inside && half < LONGEST && low.floor() + 1.0 < high
}

impl<const FOLLOWS: bool> Basis for Gimp<FOLLOWS> {
    const DEGREE: u8 = 1;
    const DOMAIN: Domain = if FOLLOWS { Domain::Follows } else { Domain::Fixed };

    const ONE_PATCH: bool = false;

    type Patch<const D: usize> = Product<D, AT_ONCE>;

    #[inline(always)]
    fn patches<const D: usize>(
        grid: &Grid<D>,
        particles: &Particles<D>,
        p: usize,
        mut visit: impl FnMut(&Product<D, AT_ONCE>),
    ) {
        let x = &particles.x[p];
        if grid.cell(x).is_none() {
            return;
        }
        let alone = |axis: usize| {
            let half = half(particles, p, axis) * grid.inverse_h();
            Domain1d::new(grid, grid.wrapped(x, axis), half, axis)
        };
        let axes: [Domain1d; D] = array(alone(0), alone);
        let mut groups = 1;
        for axis in &axes {
            groups *= axis.groups;
        }
        for mut group in 0..groups {
            visit(&Product(array(Weights1d::NONE, |axis| {
                let along = axes[axis].along(grid, axis, group % axes[axis].groups);
                group /= axes[axis].groups;
                along
            })));
        }
    }

    /// Stores the patches of particles with at most [`AT_ONCE`] functions along each axis.
    #[inline(always)]
    fn patches_x4<S: Simd, W: PatchShape, const D: usize>(
        simd: S,
        grid: &Grid<D>,
        locator: &CellLocator<D>,
        particles: &Particles<D>,
        lanes: FourLanes,
        patches: &mut ProductBatch<D, W>,
    ) -> u32 {
        let FourLanes { particle: first, lane } = lanes;
        let CellPositions { cell, xi, inside } = locator.locate(simd, grid, &particles.x, first);
        let (mut start, mut one) = (cell, inside);
        let domains = particles.domain.get(first..).and_then(<[Matrix<D>]>::first_chunk::<LANES>);
        for axis in 0..D {
            let half = match domains {
                _ if particles.domain.is_empty() => simd.splat(0.5 * particles.spacing[axis]),
                Some(four) => simd.load(array(0.0, |k| four[k][(axis, axis)])),
                None => simd.load(last(particles, first, axis)),
            };
            let wall = (!locator.periodic[axis]).then_some(locator.ends[axis]);
            let at = cell[axis] + xi[axis];
            let extent = Domain1dSimd::<S>::new(at, half * locator.inverse_h, wall);
            let along = extent.along(simd, locator.h, locator.inverse_h);
            along.put(lane / LANES, locator.needs, &mut patches.axes[axis]);
            start[axis] = extent.first;
            if wall.is_none() && !start[axis].are_in(0.0, locator.ends[axis]) {
                start[axis] = simd.load(beyond_seam(grid, axis, start[axis].into()));
            }
            let spare = extent.spare();
            if !spare.are_in(0.0, f64::INFINITY) {
                one &= not_below_zero(spare.into());
            }
        }
        patches.put_starts(lane, locator.starts(&start));
        one
    }

    fn visit_domain_end<const D: usize>(
        grid: &Grid<D>,
        particles: &Particles<D>,
        p: usize,
        (axis, outwards): (usize, f64),
        mut visit: impl FnMut(NodeWeight<'_, D>),
    ) {
        let half = half(particles, p, axis);
        if !is_bent(grid, &particles.x[p], axis, half) {
            return;
        }
        let arm = outwards * half;
        Self::patches(grid, particles, p, |patch| {
            let mut end = *patch;
            let along = &mut end.0[axis];
            for k in 0..AT_ONCE {
                let exact = hat((arm - along.offset[k]) * grid.inverse_h());
                along.weight[k] = exact - along.weight[k] - arm * along.slope[k];
            }
            end.visit(grid, &mut visit);
        });
    }

    fn with_loops<U: LoopsUser>(user: U) -> U::Output {
        user.call::<ContiguousGimp>()
    }

    /// Counts three nodes along each axis, the number for domains of at most one cell.
    fn support(dimension: usize) -> u64 {
        3_u64.pow(dimension as u32)
    }
}

/// Number of functions in a group. One group contains all functions along an axis if the domain is
/// at most one cell long.
pub(in crate::mpm) const AT_ONCE: usize = 3;

/// Maximum half-length of a domain (cells); longer domains are truncated.
const LONGEST: f64 = 2.5;

fn hat(z: f64) -> f64 {
    (1.0 - z.abs()).max(0.0)
}

/// Integrates the hat function from minus infinity to z.
fn integral(z: f64) -> f64 {
    let z = z.clamp(-1.0, 1.0);
    if z < 0.0 { 0.5 * (1.0 + z) * (1.0 + z) } else { 0.5 + z - 0.5 * z * z }
}

/// Domains of four particles along one axis, in cells.
#[derive(Clone, Copy)]
pub(in crate::mpm) struct Domain1dSimd<S: Simd> {
    /// Positions of the particles. `low` and `high` are the ends of their domains.
    at: S::F64x4,
    low: S::F64x4,
    high: S::F64x4,
    pub(in crate::mpm) first: S::F64x4,
}

impl<S: Simd> Domain1dSimd<S> {
    /// Creates domains centred at `at`. If there are walls, domains are truncated at node 0 and at
    /// node `last`.
    #[inline(always)]
    pub(in crate::mpm) fn new(at: S::F64x4, half: S::F64x4, last: Option<f64>) -> Self {
        let half = half.abs().at_most(LONGEST);
        let (mut low, mut high) = (at - half, at + half);
        if let Some(last) = last {
            (low, high) = (low.at_least(0.0), high.at_most(last));
        }
        Self { at, low, high, first: low.floor() }
    }

    /// Returns the distance by which the last of [`AT_ONCE`] nodes is beyond the end of the domain;
    /// negative if the domain has more nodes.
    #[inline(always)]
    pub(in crate::mpm) fn spare(&self) -> S::F64x4 {
        self.first + (AT_ONCE - 1) as f64 - self.high
    }

    /// Evaluates the functions of domains that end before the third node. The branches of
    /// [`integral`] and [`hat`] are then known in advance. The results are bit-identical to those
    /// of [`Domain1d::one_of_many`].
    #[inline(always)]
    pub(in crate::mpm) fn along(&self, simd: S, h: f64, inverse_h: f64) -> WeightsSimd<S, AT_ONCE> {
        let (zero, one) = (simd.splat(0.0), simd.splat(1.0));
        let rising = |z: S::F64x4| (z + 1.0) * 0.5 * (z + 1.0);
        let falling = |z: S::F64x4| z + 0.5 - z * 0.5 * z;
        let node: [_; AT_ONCE] = array(zero, |k| self.first + k as f64);
        let (low, high) =
            ([self.low - node[0], self.low - node[1]], |k: usize| self.high - node[k]);
        let high = [high(0).at_most(1.0), high(1), high(2).at_least(-1.0)];
        let (left, right) = (high[1].at_most(0.0), high[1].at_least(0.0));
        let share = (self.high - self.low).inverse();
        let weight = [
            (falling(high[0]) - falling(low[0])) * share,
            (rising(left) + right - right * 0.5 * right - rising(low[1])) * share,
            rising(high[2]) * share,
        ];
        let slope = [
            (one - high[0] - (one - low[0])) * share * inverse_h,
            (one - high[1].abs() - (low[1] + 1.0)) * share * inverse_h,
            (high[2] + 1.0) * share * inverse_h,
        ];
        let offset = array(zero, |k| (node[k] - self.at) * h);
        let (mut mean, mut second) = (weight[0] * offset[0], weight[0] * offset[0] * offset[0]);
        for k in 1..AT_ONCE {
            mean += weight[k] * offset[k];
            second += weight[k] * offset[k] * offset[k];
        }
        // The mean is not zero for a truncated domain, which is not centred at its particle.
        WeightsSimd { weight, slope, offset, variance: second - mean * mean }
    }
}

#[derive(Clone, Copy)]
pub(in crate::mpm) struct Domain1d {
    extent: Domain1dSimd<Plain>,
    /// Number of groups of [`AT_ONCE`] nodes that the domain needs.
    pub(in crate::mpm) groups: usize,
}

impl Domain1d {
    #[inline(always)]
    pub(in crate::mpm) fn new<const D: usize>(
        grid: &Grid<D>,
        at: f64,
        half: f64,
        axis: usize,
    ) -> Self {
        let last = (!grid.periodic[axis]).then_some(grid.cells[axis] as f64);
        let extent = Domain1dSimd::<Plain>::new(Plain.splat(at), Plain.splat(half), last);
        let [spare, ..]: [f64; LANES] = extent.spare().into();
        let groups = if spare >= 0.0 { 1 } else { 2 + (-spare / AT_ONCE as f64) as usize };
        Self { extent, groups }
    }

    #[inline(always)]
    pub(in crate::mpm) fn along<const D: usize>(
        &self,
        grid: &Grid<D>,
        axis: usize,
        group: usize,
    ) -> Weights1d<AT_ONCE> {
        if self.groups > 1 {
            return self.one_of_many(grid, axis, group);
        }
        let first = <[f64; LANES]>::from(self.extent.first)[0];
        let along = self.extent.along(Plain, grid.h, grid.inverse_h());
        along.take(0, grid.wrap_signed(first, axis))
    }

    /// Evaluates the functions of one group for a domain of any length; the functions are zero
    /// outside the domain and the walls.
    #[inline(always)]
    fn one_of_many<const D: usize>(
        &self,
        grid: &Grid<D>,
        axis: usize,
        group: usize,
    ) -> Weights1d<AT_ONCE> {
        let Domain1dSimd { at, low, high, first } = self.extent;
        let [at, low, high, first] =
            [at, low, high, first].map(|four| <[f64; LANES]>::from(four)[0]);
        let first = first + (group * AT_ONCE) as f64;
        let (share, node) = (1.0 / (high - low), |k: usize| first + k as f64);
        let (low, high) = (|k| low - node(k), |k| high - node(k));
        Weights1d::new(
            grid.wrap_signed(first, axis),
            array(0.0, |k| (integral(high(k)) - integral(low(k))) * share),
            array(0.0, |k| (hat(high(k)) - hat(low(k))) * share * grid.inverse_h()),
            array(0.0, |k| (node(k) - at) * grid.h),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// For a short domain, both code paths give bit-identical functions.
        #[test]
        fn a_short_domain_has_the_functions_of_any(
            at in 0.0..=5.0_f64,
            half in 0.0..1.0_f64,
            whole: bool,
            periodic: bool,
        ) {
            let grid = Grid::<1>::new(Vector::<1>::new(0.0), 0.3, [5], [periodic], [6]);
            let at = if whole { libm::round(at) } else { at };
            for half in [half, 0.5 * libm::round(2.0 * half), libm::fabs(at - libm::round(at)), 1e-9 * half] {
                let alone = Domain1d::new(&grid, at, half, 0);
                if alone.groups > 1 || half == 0.0 {
                    continue;
                }
                let (short, any) = (alone.along(&grid, 0, 0), alone.one_of_many(&grid, 0, 0));
                prop_assert_eq!(short.first, any.first);
                prop_assert_eq!(short.weight, any.weight);
                prop_assert_eq!(short.slope, any.slope);
                prop_assert_eq!(short.offset, any.offset);
                let [_, mean, second] = any.moments();
                prop_assert_eq!(short.variance, second - mean * mean);
            }
        }
    }
}
