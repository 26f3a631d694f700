//! B-splines of degree 2 and 3, whose gradients are continuous.
//!
//! At walls the knots are open (repeated), so the first function is 1 there, and prescribing its
//! coefficient prescribes the boundary value (Steffen, Kirby & Berzins 2008, IJNME 76, section 4;
//! Tielen, Wobbes, Moeller & Beuth 2017). On a periodic axis the knots are uniform. The functions
//! are evaluated by the Cox-de Boor recursion (Piegl & Tiller, The NURBS Book, algorithm A2.2).

use super::cell_locator::{CellLocator, CellPositions};
use super::contract::{Basis, Domain, FourLanes};
use super::product::Product;
use super::product_batch::ProductBatch;
use super::shape::PatchShape;
use super::weights_1d::{Weights1d, Weights1dBatch, WeightsSimd};
use crate::mpm::foundation::algebra::array;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::foundation::simd::{F64x4, LANES, Plain, Simd};

/// Quadratic B-splines.
#[derive(Debug, Clone, Copy)]
pub struct QuadraticBSpline;

/// Cubic B-splines.
#[derive(Debug, Clone, Copy)]
pub struct CubicBSpline;

/// Returns the position of knot `k` (in cells) for degree `p`. Knots are uniform, and repeated at
/// walls.
#[inline]
fn knot(k: usize, p: usize, cells: usize, periodic: bool) -> f64 {
    let uniform = k as f64 - p as f64;
    if periodic { uniform } else { uniform.clamp(0.0, cells as f64) }
}

/// Returns the Greville abscissa of function `i`, the mean of its inner knots.
fn greville(i: usize, p: usize, cells: usize, periodic: bool) -> f64 {
    let knots: [f64; MOST_KNOTS] = array(0.0, |k| knot(i + 1 + k, p, cells, periodic));
    mean(&knots[..p])
}

#[inline(always)]
fn mean(knots: &[f64]) -> f64 {
    let mut sum = 0.0;
    for knot in knots {
        sum += knot;
    }
    sum / knots.len() as f64
}

/// Maximum number of knots around a cell: twice the largest degree.
const MOST_KNOTS: usize = 6;

/// Returns the 2p knots around a cell for degree `p`, on an axis with walls: p knots up to the low
/// side of the cell, and p knots from its high side. The rest of the array is not used.
#[inline]
fn knots_around(cell: usize, p: usize, cells: usize) -> [f64; MOST_KNOTS] {
    array(0.0, |k| knot(cell + 1 + k, p, cells, false))
}

/// Evaluates the K = p + 1 functions and their derivatives (per cell) on an axis with walls. `s` is
/// the position (in cells), in a cell with the knots `around` ([`knots_around`]).
#[inline(always)]
fn functions<const K: usize>(s: f64, around: &[f64; MOST_KNOTS]) -> ([f64; K], [f64; K]) {
    let p = K - 1;
    let (mut value, mut lower) = ([0.0; K], [0.0; K]);
    value[0] = 1.0;
    for degree in 1..=p {
        lower = value;
        let mut saved = 0.0;
        for r in 0..degree {
            let (left, right) = (around[p + r - degree], around[p + r]);
            let share = lower[r] / (right - left);
            value[r] = saved + (right - s) * share;
            saved = (s - left) * share;
        }
        value[degree] = saved;
    }
    // Derivatives: N' = p N_(i,p-1)/(t_(i+p) - t_i) - p N_(i+1,p-1)/(t_(i+p+1) - t_(i+1))
    let term = array::<K, _>(0.0, |r| match r {
        0 => 0.0,
        r => p as f64 * lower[r - 1] / (around[p + r - 1] - around[r - 1]),
    });
    let slope = array(0.0, |r| term[r] - if r == p { 0.0 } else { term[r + 1] });
    (value, slope)
}

/// Evaluates the K functions and their derivatives (per cell) for uniform knots with unit spacing.
/// `xi` is the position in the cell, from 0 to 1.
#[inline(always)]
fn uniform<S: Simd, const K: usize>(simd: S, xi: S::F64x4) -> ([S::F64x4; K], [S::F64x4; K]) {
    let zero = simd.splat(0.0);
    let (mut value, mut lower) = ([zero; K], [zero; K]);
    value[0] = simd.splat(1.0);
    for degree in 1..K {
        lower = value;
        for r in 0..degree {
            let share = lower[r] * (1.0 / degree as f64);
            let falling = (simd.splat((r + 1) as f64) - xi) * share;
            value[r] = if r > 0 { value[r] + falling } else { falling };
            value[r + 1] = (xi + (degree - 1 - r) as f64) * share;
        }
    }
    let slope = array(zero, |r| match r {
        0 => zero - lower[0],
        r if r + 1 < K => lower[r - 1] - lower[r],
        r => lower[r - 1],
    });
    (value, slope)
}

#[inline(always)]
fn along<S: Simd, const K: usize>(
    simd: S,
    xi: S::F64x4,
    h: f64,
    inverse_h: f64,
) -> WeightsSimd<S, K> {
    let (weight, slope) = uniform::<S, K>(simd, xi);
    let first = simd.splat(1.0 - 0.5 * K as f64) - xi;
    WeightsSimd {
        weight,
        slope: array(xi, |r| slope[r] * inverse_h),
        offset: array(xi, |r| (first + r as f64) * h),
        // The functions are convolutions of p + 1 boxes. The variance of each box is 1/12.
        variance: simd.splat(K as f64 / 12.0 * (h * h)),
    }
}

/// Returns the range `low..high` of cells whose knots are not repeated.
#[inline]
fn uniform_cells(degree: usize, cells: f64, periodic: bool) -> (f64, f64) {
    if periodic { (0.0, cells) } else { (degree as f64 - 1.0, cells - degree as f64 + 1.0) }
}

/// Evaluates the functions along an axis near walls, where knots may be repeated.
#[cold]
#[inline(never)]
fn along_wall<const D: usize, const K: usize>(
    grid: &Grid<D>,
    axis: usize,
    cell: usize,
    xi: f64,
) -> Weights1d<K> {
    let (h, [weight, slope, place]) = (grid.h, at_wall::<K>(grid.cells[axis], cell, xi));
    let mut variance = 0.0;
    for r in 0..K {
        variance += weight[r] * place[r] * place[r];
    }
    Weights1d {
        first: cell,
        weight,
        slope: array(0.0, |r| slope[r] * grid.inverse_h()),
        offset: array(0.0, |r| place[r] * h),
        variance: variance * (h * h),
    }
}

#[cold]
#[inline(never)]
fn put_right<const D: usize, const K: usize>(
    grid: &Grid<D>,
    axis: usize,
    cell: [f64; LANES],
    xi: [f64; LANES],
    lane: usize,
    weights: &mut Weights1dBatch,
) {
    let (low, high) = uniform_cells(K - 1, grid.cells[axis] as f64, grid.periodic[axis]);
    for k in 0..LANES {
        if cell[k] < low || cell[k] >= high {
            weights.put(lane + k, &along_wall::<D, K>(grid, axis, cell[k] as usize, xi[k]));
        }
    }
}

/// Returns values, slopes (per cell) and offsets from the particle (in cells) near walls, where
/// knots may be repeated.
#[inline]
fn at_wall<const K: usize>(cells: usize, cell: usize, xi: f64) -> [[f64; K]; 3] {
    let (p, s) = (K - 1, cell as f64 + xi);
    let around = knots_around(cell, p, cells);
    let (weight, slope) = functions::<K>(s, &around);
    [weight, slope, array(0.0, |r| mean(&around[r..r + p]) - s)]
}

macro_rules! bspline {
    ($name:ident, $degree:literal, $functions:literal) => {
        impl Basis for $name {
            const DEGREE: u8 = $degree;
            const DOMAIN: Domain = Domain::Point;

            type Patch<const D: usize> = Product<D, $functions>;

            fn count(cells: usize, periodic: bool) -> usize {
                if periodic { cells } else { cells + $degree }
            }

            fn abscissa(index: usize, cells: usize, periodic: bool) -> f64 {
                greville(index, $degree, cells, periodic)
            }

            #[inline(always)]
            fn patches<const D: usize>(
                grid: &Grid<D>,
                particles: &Particles<D>,
                p: usize,
                mut visit: impl FnMut(&Product<D, $functions>),
            ) {
                let Some((cell, xi)) = grid.locate(&particles.x[p]) else { return };
                visit(&Product(array(Weights1d::NONE, |axis| {
                    let (cell, xi, cells) = (cell[axis], xi[axis], grid.cells[axis] as f64);
                    let (low, high) = uniform_cells($degree, cells, grid.periodic[axis]);
                    if !(low..high).contains(&(cell as f64)) {
                        return along_wall(grid, axis, cell, xi);
                    }
                    along(Plain, Plain.splat(xi), grid.h, grid.inverse_h()).take(0, cell)
                })));
            }

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
                let CellPositions { cell, xi, inside } =
                    locator.locate(simd, grid, &particles.x, first);
                patches.put_starts(lane, locator.starts(&cell));
                for axis in 0..D {
                    let (cell, xi) = (cell[axis], xi[axis]);
                    let weights = &mut patches.axes[axis];
                    along::<S, $functions>(simd, xi, locator.h, locator.inverse_h).put(
                        lane / LANES,
                        locator.needs,
                        weights,
                    );
                    let (low, high) =
                        uniform_cells($degree, locator.ends[axis], locator.periodic[axis]);
                    if !cell.are_in(low, high) {
                        put_right::<D, $functions>(
                            grid,
                            axis,
                            cell.into(),
                            xi.into(),
                            lane,
                            weights,
                        );
                    }
                }
                inside
            }

            fn support(dimension: usize) -> u64 {
                u64::pow($functions, dimension as u32)
            }
        }
    };
}

bspline!(QuadraticBSpline, 2, 3);
bspline!(CubicBSpline, 3, 4);
