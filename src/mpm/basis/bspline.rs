//! B-splines of degree 2 and 3: gradients without jumps.
//!
//! At walls the knots are open (repeated), so that the functions conform to the wall: the first one
//! is 1 there, and holding it holds the boundary (Steffen, Kirby & Berzins 2008, IJNME 76,
//! section 4; Tielen, Wobbes, Moeller & Beuth 2017). On a periodic axis the knots are uniform. The
//! functions are evaluated by the recursion of Cox and de Boor (Piegl & Tiller, The NURBS Book,
//! algorithm A2.2).

use super::{
    contract::{Basis, Domain, Seen},
    tensor::{self, Along},
};
use crate::mpm::{grid::Grid, particles::Particles};

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

/// The K = p + 1 functions of one axis at `s` (in cells) within `cell`, with derivatives per cell.
fn functions<const K: usize>(
    s: f64,
    cell: usize,
    cells: usize,
    periodic: bool,
) -> ([f64; K], [f64; K]) {
    let p = K - 1;
    let knot = |k: usize| knot(k, p, cells, periodic);
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

fn visit<const D: usize, const K: usize>(
    grid: &Grid<D>,
    particles: &Particles<D>,
    p: usize,
    visit: impl FnMut(Seen<'_, D>),
) {
    let x = &particles.x[p];
    let Some(cell) = grid.cell(x) else { return };
    let axes: [Along<K>; D] = std::array::from_fn(|axis| {
        let (cells, periodic) = (grid.cells[axis], grid.periodic[axis]);
        let s = grid.wrapped(x, axis);
        let (weight, slope) = functions::<K>(s, cell[axis], cells, periodic);
        Along {
            count: K,
            index: std::array::from_fn(|r| grid.wrap(cell[axis] + r, axis)),
            weight,
            slope: slope.map(|slope| slope * grid.inverse_h()),
        }
    });
    let offset = |axis: usize, r: usize| {
        let place = greville(cell[axis] + r, K - 1, grid.cells[axis], grid.periodic[axis]);
        (place - grid.wrapped(x, axis)) * grid.h
    };
    tensor::visit(grid, &axes, offset, visit);
}

macro_rules! bspline {
    ($name:ident, $degree:literal, $functions:literal) => {
        impl Basis for $name {
            const DEGREE: u8 = $degree;
            const DOMAIN: Domain = Domain::Point;

            fn count(cells: usize, periodic: bool) -> usize {
                if periodic { cells } else { cells + $degree }
            }

            fn abscissa(index: usize, cells: usize, periodic: bool) -> f64 {
                greville(index, $degree, cells, periodic)
            }

            #[inline]
            fn visit<const D: usize>(
                grid: &Grid<D>,
                particles: &Particles<D>,
                p: usize,
                seen: impl FnMut(Seen<'_, D>),
            ) {
                visit::<D, $functions>(grid, particles, p, seen);
            }

            fn support(dimension: usize) -> u64 {
                u64::pow($functions, dimension as u32)
            }
        }
    };
}

bspline!(QuadraticBSpline, 2, 3);
bspline!(CubicBSpline, 3, 4);
