//! GIMP: linear functions averaged over the particle's domain (Bardenhagen & Kober 2004, CMES 5,
//! eqs 30-32).
//!
//! `N_i = 1/(2l) int hat_i` over `[x - l, x + l]`, `N_i' = (hat_i(x + l) - hat_i(x - l))/(2l)`. In
//! several dimensions the domain stays aligned with the axes. uGIMP keeps the reference size; in
//! the contiguous-particle form (Wallstedt & Guilkey 2008) the half-length on an axis follows the
//! diagonal of F, so that domains neither part nor overlap. At walls the domain is cut off.

use super::{
    along::Along,
    contract::{Basis, Domain},
    product::Product,
};
use crate::mpm::{
    algebra::array,
    grid::{Grid, floor},
    particles::Particles,
};

/// GIMP with domains of constant size.
#[derive(Debug, Clone, Copy)]
pub struct UniformGimp;

/// GIMP with domains that follow the deformation.
#[derive(Debug, Clone, Copy)]
pub struct ContiguousGimp;

/// Functions along an axis that are seen at once: all of them while the domain is not longer than a
/// cell.
const AT_ONCE: usize = 3;

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

/// The domain along one axis.
#[derive(Clone, Copy)]
struct Extent {
    /// The particle and the ends of its domain, in cells.
    at: f64,
    low: f64,
    high: f64,
    /// The first node that it sees, and how many times [`AT_ONCE`] of them.
    first: f64,
    groups: usize,
}

impl Extent {
    const NONE: Self = Self { at: 0.0, low: 0.0, high: 0.0, first: 0.0, groups: 1 };

    #[inline(always)]
    fn new<const D: usize>(grid: &Grid<D>, at: f64, half: f64, axis: usize) -> Self {
        let half = half.abs().min(LONGEST);
        let (mut low, mut high) = (at - half, at + half);
        if !grid.periodic[axis] {
            low = low.max(0.0);
            high = high.min(grid.cells[axis] as f64);
        }
        let first = floor(low);
        let beyond = high - first - (AT_ONCE - 1) as f64;
        let groups = 1 + if beyond > 0.0 { 1 + (beyond / AT_ONCE as f64) as usize } else { 0 };
        Self { at, low, high, first, groups }
    }

    /// The functions of a group. Those beyond the domain and beyond the wall are zero.
    #[inline(always)]
    fn along<const D: usize>(&self, grid: &Grid<D>, axis: usize, group: usize) -> Along<AT_ONCE> {
        let first = self.first + (group * AT_ONCE) as f64;
        let (share, node) = (1.0 / (self.high - self.low), |k: usize| first + k as f64);
        let (low, high) = (|k| self.low - node(k), |k| self.high - node(k));
        Along::new(
            grid.wrap_signed(first, axis),
            array(0.0, |k| (integral(high(k)) - integral(low(k))) * share),
            array(0.0, |k| (hat(high(k)) - hat(low(k))) * share * grid.inverse_h()),
            array(0.0, |k| (node(k) - self.at) * grid.h),
        )
    }
}

#[inline(always)]
fn patches<const D: usize>(
    grid: &Grid<D>,
    particles: &Particles<D>,
    p: usize,
    follows: bool,
    mut see: impl FnMut(&Product<D, AT_ONCE>),
) {
    let x = &particles.x[p];
    if grid.cell(x).is_none() {
        return;
    }
    let extents: [Extent; D] = array(Extent::NONE, |axis| {
        let followed = particles.domain.get(p).filter(|_| follows);
        let half = followed.map_or(0.5 * particles.spacing[axis], |r| r[(axis, axis)].abs());
        Extent::new(grid, grid.wrapped(x, axis), half * grid.inverse_h(), axis)
    });
    let groups: usize = extents.iter().map(|extent| extent.groups).product();
    for mut group in 0..groups {
        see(&Product(array(Along::NONE, |axis| {
            let along = extents[axis].along(grid, axis, group % extents[axis].groups);
            group /= extents[axis].groups;
            along
        })));
    }
}

macro_rules! gimp {
    ($name:ident, $domain:ident) => {
        impl Basis for $name {
            const DEGREE: u8 = 1;
            const DOMAIN: Domain = Domain::$domain;

            const ONE_PATCH: bool = false;

            type Patch<const D: usize> = Product<D, AT_ONCE>;

            fn count(cells: usize, periodic: bool) -> usize {
                cells + usize::from(!periodic)
            }

            fn abscissa(index: usize, _: usize, _: bool) -> f64 {
                index as f64
            }

            #[inline(always)]
            fn patches<const D: usize>(
                grid: &Grid<D>,
                particles: &Particles<D>,
                p: usize,
                see: impl FnMut(&Product<D, AT_ONCE>),
            ) {
                patches(grid, particles, p, Self::DOMAIN == Domain::Follows, see);
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

#[cfg(test)]
mod tests {
    use crate::mpm::{BasisName, Block, Particles, Vector, kernel};
    use rstest::rstest;

    /// Found by the fuzzer: a length that no body has reached far beyond the grid.
    #[rstest]
    #[case::negative(-1e30)]
    #[case::infinite(f64::INFINITY)]
    #[case::nan(f64::NAN)]
    fn a_domain_of_senseless_length_stays_in_the_grid(#[case] spacing: f64) {
        let kernel = kernel::<1>(BasisName::UniformGimp);
        let (from, to) = (Vector::<1>::new(0.0), Vector::<1>::new(4.0));
        let mut particles = Particles::fill(&Block { from, to, density: 1.0 }, 1.0, 2);
        particles.spacing[0] = spacing;
        let mut grid = kernel.grid(from, 1.0, [4], [false]);
        kernel.p2g_mass(&particles, &mut grid);
        assert_eq!(grid.mass.len(), 5);
    }
}
