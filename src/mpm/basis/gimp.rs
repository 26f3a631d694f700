//! GIMP: linear functions averaged over the particle's domain (Bardenhagen & Kober 2004, CMES 5,
//! eqs 30-32).
//!
//! `N_i = 1/(2l) int hat_i` over `[x - l, x + l]`, `N_i' = (hat_i(x + l) - hat_i(x - l))/(2l)`. In
//! several dimensions the domain stays aligned with the axes. uGIMP keeps the reference size; in
//! the contiguous-particle form (Wallstedt & Guilkey 2008) the half-length on an axis follows the
//! diagonal of F, so that domains neither part nor overlap. At walls the domain is cut off.

use super::{
    contract::{Basis, Domain, Seen},
    tensor::{self, Along},
};
use crate::mpm::{grid::Grid, particles::Particles};

/// GIMP with domains of constant size.
#[derive(Debug, Clone, Copy)]
pub struct UniformGimp;

/// GIMP with domains that follow the deformation.
#[derive(Debug, Clone, Copy)]
pub struct ContiguousGimp;

/// Most functions along an axis: domains up to five cells long.
const MOST: usize = 8;

/// Largest half-length of a domain, in cells. A particle that is stretched further is seen with
/// this one.
const LONGEST: f64 = 2.5;

/// The hat of a node at distance z, in cells.
fn hat(z: f64) -> f64 {
    (1.0 - z.abs()).max(0.0)
}

/// Its integral from minus infinity.
fn integral(z: f64) -> f64 {
    let z = z.clamp(-1.0, 1.0);
    if z < 0.0 { 0.5 * (1.0 + z) * (1.0 + z) } else { 0.5 + z - 0.5 * z * z }
}

/// The functions of one axis, and where the first of them sits, from the particle (in cells).
fn along<const D: usize>(grid: &Grid<D>, s: f64, half: f64, axis: usize) -> (Along<MOST>, f64) {
    let half = half.min(LONGEST);
    let (mut low, mut high) = (s - half, s + half);
    if !grid.periodic[axis] {
        low = low.max(0.0);
        high = high.min(grid.cells[axis] as f64);
    }
    let mut along = Along::EMPTY;
    let first = libm::floor(low);
    for k in 0..MOST {
        let node = first + k as f64;
        if node >= high + 1.0 || (!grid.periodic[axis] && node > grid.cells[axis] as f64) {
            break;
        }
        along.index[k] = grid.wrap_signed(node, axis);
        along.weight[k] = (integral(high - node) - integral(low - node)) / (high - low);
        along.slope[k] = (hat(high - node) - hat(low - node)) / (high - low) * grid.inverse_h();
        along.count = k + 1;
    }
    (along, first - s)
}

fn visit<const D: usize>(
    grid: &Grid<D>,
    particles: &Particles<D>,
    p: usize,
    follows: bool,
    visit: impl FnMut(Seen<'_, D>),
) {
    let x = &particles.x[p];
    if grid.cell(x).is_none() {
        return;
    }
    let half = |axis: usize| {
        let followed = particles.domain.get(p).filter(|_| follows);
        let half = followed.map_or(0.5 * particles.spacing[axis], |r| r[(axis, axis)].abs());
        half * grid.inverse_h()
    };
    let (mut axes, mut first) = ([Along::EMPTY; D], [0.0; D]);
    for axis in 0..D {
        (axes[axis], first[axis]) = along(grid, grid.wrapped(x, axis), half(axis), axis);
    }
    let offset = |axis: usize, k: usize| (first[axis] + k as f64) * grid.h;
    tensor::visit(grid, &axes, offset, visit);
}

macro_rules! gimp {
    ($name:ident, $domain:ident) => {
        impl Basis for $name {
            const DEGREE: u8 = 1;
            const DOMAIN: Domain = Domain::$domain;

            fn count(cells: usize, periodic: bool) -> usize {
                cells + usize::from(!periodic)
            }

            fn abscissa(index: usize, _: usize, _: bool) -> f64 {
                index as f64
            }

            #[inline]
            fn visit<const D: usize>(
                grid: &Grid<D>,
                particles: &Particles<D>,
                p: usize,
                seen: impl FnMut(Seen<'_, D>),
            ) {
                let follows = Self::DOMAIN == Domain::Follows;
                visit(grid, particles, p, follows, seen);
            }

            /// Three nodes along an axis while the domain is not longer than a cell.
            fn support(dimension: usize) -> u64 {
                3_u64.pow(dimension as u32)
            }
        }
    };
}

gimp!(UniformGimp, Fixed);
gimp!(ContiguousGimp, Follows);
