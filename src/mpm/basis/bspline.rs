//! B-splines of degree 2 and 3: gradients without jumps.
//!
//! At walls the knots are open (repeated), so that the functions conform to the wall: the first one
//! is 1 there, and holding it holds the boundary (Steffen, Kirby & Berzins 2008, IJNME 76,
//! section 4; Tielen, Wobbes, Moeller & Beuth 2017). On a periodic axis the knots are uniform. The
//! functions are evaluated by the recursion of Cox and de Boor (Piegl & Tiller, The NURBS Book,
//! algorithm A2.2).

use super::{
    along::Along,
    contract::{Basis, Domain},
    product::Product,
};
use crate::mpm::{algebra::array, grid::Grid, particles::Particles};

/// Quadratic B-splines.
#[derive(Debug, Clone, Copy)]
pub struct QuadraticBSpline;

/// Cubic B-splines.
#[derive(Debug, Clone, Copy)]
pub struct CubicBSpline;

/// Knot k of an axis of `cells` cells for degree `p`, in cells: open at walls, else uniform.
fn knot(k: usize, p: usize, cells: usize, periodic: bool) -> f64 {
    let uniform = k as f64 - p as f64;
    if periodic { uniform } else { uniform.clamp(0.0, cells as f64) }
}

/// Greville abscissa of function `i`: the mean of its inner knots.
fn greville(i: usize, p: usize, cells: usize, periodic: bool) -> f64 {
    (i + 1..=i + p).map(|k| knot(k, p, cells, periodic)).sum::<f64>() / p as f64
}

/// The K = p + 1 functions of an axis with walls at `s` (in cells) within `cell`, with derivatives
/// per cell.
fn functions<const K: usize>(s: f64, cell: usize, cells: usize) -> ([f64; K], [f64; K]) {
    let p = K - 1;
    let knot = |k: usize| knot(k, p, cells, false);
    let span = cell + p;
    let (mut value, mut lower) = ([0.0; K], [0.0; K]);
    value[0] = 1.0;
    for degree in 1..=p {
        lower = value;
        let mut carried = 0.0;
        for r in 0..degree {
            let (left, right) = (knot(span + r + 1 - degree), knot(span + r + 1));
            let share = lower[r] / (right - left);
            value[r] = carried + (right - s) * share;
            carried = (s - left) * share;
        }
        value[degree] = carried;
    }
    // N' = p N_(i,p-1)/(t_(i+p) - t_i) - p N_(i+1,p-1)/(t_(i+p+1) - t_(i+1))
    let term = |r: usize| match r {
        0 => 0.0,
        r if r == K => 0.0,
        r => p as f64 * lower[r - 1] / (knot(span + r) - knot(span + r - p)),
    };
    let slope = std::array::from_fn(|r| term(r) - term(r + 1));
    (value, slope)
}

/// The same where no knot is repeated, at `xi` from 0 to 1 within the cell: all spans have length 1.
#[inline(always)]
fn uniform<const K: usize>(xi: f64) -> ([f64; K], [f64; K]) {
    let (mut value, mut lower) = ([0.0; K], [0.0; K]);
    value[0] = 1.0;
    for degree in 1..K {
        lower = value;
        let mut carried = 0.0;
        for r in 0..degree {
            let share = lower[r] * (1.0 / degree as f64);
            value[r] = carried + ((r + 1) as f64 - xi) * share;
            carried = (xi + (degree - 1 - r) as f64) * share;
        }
        value[degree] = carried;
    }
    let mut slope = [0.0; K];
    for r in 1..K {
        slope[r - 1] -= lower[r - 1];
        slope[r] += lower[r - 1];
    }
    (value, slope)
}

/// The functions of `axis` in a cell, at `xi` from 0 to 1 within it.
#[inline(always)]
fn along<const D: usize, const K: usize>(
    grid: &Grid<D>,
    axis: usize,
    cell: usize,
    xi: f64,
) -> Along<K> {
    let (p, cells, h) = (K - 1, grid.cells[axis], grid.h);
    let (mut weight, mut slope) = uniform::<K>(xi);
    let first = 0.5 * (1.0 - p as f64) - xi;
    let mut place: [f64; K] = array(0.0, |r| first + r as f64);
    // A sum of p + 1 boxes has p + 1 times the variance 1/12 of one.
    let mut variance = (p + 1) as f64 / 12.0;
    if !grid.periodic[axis] && (cell + 1 < p || cell + p > cells) {
        let wall = at_wall::<K>(cells, cell, xi);
        // One by one: numbers that stay in registers elsewhere must not go by memory for its sake.
        variance = 0.0;
        for r in 0..K {
            (weight[r], slope[r], place[r]) = (wall[0][r], wall[1][r], wall[2][r]);
            variance += weight[r] * place[r] * place[r];
        }
    }
    Along {
        first: cell,
        weight,
        slope: array(0.0, |r| slope[r] * grid.inverse_h()),
        offset: array(0.0, |r| place[r] * h),
        variance: variance * (h * h),
    }
}

/// Values, slopes per cell and places (in cells, from the particle) where knots may be repeated.
#[cold]
#[inline(never)]
fn at_wall<const K: usize>(cells: usize, cell: usize, xi: f64) -> [[f64; K]; 3] {
    let s = cell as f64 + xi;
    let (weight, slope) = functions::<K>(s, cell, cells);
    [weight, slope, array(0.0, |r| greville(cell + r, K - 1, cells, false) - s)]
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
                mut see: impl FnMut(&Product<D, $functions>),
            ) {
                let Some((cell, xi)) = grid.locate(&particles.x[p]) else { return };
                see(&Product(array(Along::NONE, |axis| along(grid, axis, cell[axis], xi[axis]))));
            }

            fn support(dimension: usize) -> u64 {
                u64::pow($functions, dimension as u32)
            }
        }
    };
}

bspline!(QuadraticBSpline, 2, 3);
bspline!(CubicBSpline, 3, 4);
