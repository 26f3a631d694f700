//! CPDI: convected particle domain interpolation (Sadeghirad, Brannon & Burghardt 2011, IJNME 86,
//! 1435-1456).
//!
//! The domain of a particle is the segment, parallelogram or parallelepiped `x + R xi`,
//! `-1 <= xi_a <= 1`. The columns of R are `r_a = F r_a0`. On the domain the hat functions `S_i` of
//! the grid are replaced by their multilinear interpolation between the corners `x_c = x + R s_c`,
//! `s_c = (+-1, ...)`: `sum_c M_c(xi) S_i(x_c)`, `M_c = prod_a (1 + s_ca xi_a)/2`. Over the domain,
//! the average of `M_c` is `1/2^D`, and the average of `d M_c/d xi_a` is `s_ca/2^D`. With the chain
//! rule `grad = R^-T d/d xi`,
//!
//! ```text
//! N_i      = 2^-D sum_c S_i(x_c)
//! grad N_i = 2^-D sum_c S_i(x_c) R^-T s_c
//! ```
//!
//! In 2-D these are the formulas of the paper. In 1-D the formulas are
//! `(S_i(x + l) + S_i(x - l))/2` and `(S_i(x + l) - S_i(x - l))/(2l)`. The gradient is the same as
//! in contiguous-particle GIMP, but the weight differs. `grad N_i` is the average of a gradient,
//! not the gradient of the average `N_i`. `N_i` and `grad N_i` reproduce linear fields:
//! `sum_i x_i N_i = x`, `sum_i x_i (x) grad N_i = R (2^-D sum_c s_c s_c^T) R^-1 = I`.
//!
//! A domain that extends through a wall is compressed along the axis until it ends at the wall,
//! similar to the truncated domain of GIMP. The whole domain is compressed by an affine map, so the
//! sign of det R does not change. Moving single corners to the wall could change this sign.

use super::contract::{Basis, Domain, NodeWeight, Patch};
use super::product::Product;
use super::product_batch::ProductBatch;
use super::shape::{FixedShape, PatchShape};
use super::weights_1d::Weights1d;
use crate::mpm::foundation::algebra::{Matrix, Vector, array, cofactor, det, floor, times};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::moments::WeightMoments;
use crate::mpm::foundation::packed_grid::Layout;
use crate::mpm::foundation::particles::Particles;

/// CPDI with parallelogram domains.
#[derive(Debug, Clone, Copy)]
pub struct Cpdi;

/// Maximum extent of a domain on a periodic axis (cells). For more distant corners, rounding would
/// destroy the position within the cell.
const FAR: f64 = 1e6;

/// Returns centre and domain vectors of a particle (in cells), compressed to fit between the walls.
#[inline]
fn within<const D: usize>(
    grid: &Grid<D>,
    particles: &Particles<D>,
    p: usize,
) -> (Vector<D>, Matrix<D>) {
    let reference = || Matrix::from_diagonal(&(particles.spacing * 0.5));
    let mut domain = particles.domain.get(p).copied().unwrap_or_else(reference) * grid.inverse_h();
    let mut centre = Vector::from_fn(|axis, _| grid.wrapped(&particles.x[p], axis));
    for axis in 0..D {
        let mut reach = 0.0;
        for k in 0..D {
            reach += domain[(axis, k)].abs();
        }
        let (low, high) = if grid.periodic[axis] {
            (centre[axis] - FAR, centre[axis] + FAR)
        } else {
            (0.0, grid.cells[axis] as f64)
        };
        if centre[axis] - reach < low || centre[axis] + reach > high {
            let (low, high) = (low.max(centre[axis] - reach), high.min(centre[axis] + reach));
            centre[axis] = 0.5 * (low + high);
            let shorter = 0.5 * (high - low) / reach;
            for k in 0..D {
                domain[(axis, k)] *= shorter;
            }
        }
    }
    (centre, domain)
}

/// Hat functions at a corner, divided by the number of corners. Gradients are proportional to
/// weights.
#[derive(Debug, Clone, Copy)]
pub struct Corner<const D: usize> {
    hats: Product<D, 2>,
    /// Vector `R^-T s_c` (1/m), which converts weights to gradients.
    outward: Vector<D>,
}

/// Evaluates the hat functions at `s` (in cells) along `axis`. Corners that are outside the grid by
/// round-off are moved to the wall.
#[inline(always)]
fn hats<const D: usize>(grid: &Grid<D>, s: f64, own: f64, axis: usize) -> Weights1d<2> {
    let (first, cell, xi) = if grid.periodic[axis] {
        let cell = floor(s);
        (grid.wrap_signed(cell, axis), cell, s - cell)
    } else {
        let cell = (s as i64 as usize).min(grid.cells[axis] - 1);
        (cell, cell as f64, (s - cell as f64).clamp(0.0, 1.0))
    };
    let slope = grid.inverse_h();
    let offset = [(cell - own) * grid.h, (cell + 1.0 - own) * grid.h];
    Weights1d::new(first, [1.0 - xi, xi], [-slope, slope], offset)
}

impl<const D: usize> Patch<D> for Corner<D> {
    type ShapeOfPatch = FixedShape<2, true>;

    #[inline(always)]
    fn put<W: PatchShape>(&self, lane: usize, layout: &Layout, patches: &mut ProductBatch<D, W>) {
        self.hats.put(lane, layout, patches);
        patches.outward[lane] = self.outward;
    }

    #[inline(always)]
    fn weight_moments(&self) -> WeightMoments<D> {
        self.hats.weight_moments()
    }

    #[inline(always)]
    fn variance(&self) -> ([f64; D], [f64; D]) {
        self.hats.variance()
    }

    #[inline(always)]
    fn visit(&self, grid: &Grid<D>, mut visit: impl FnMut(NodeWeight<'_, D>)) {
        self.hats.visit(grid, |i| visit(NodeWeight { gradient: &(self.outward * i.weight), ..i }));
    }
}

impl Basis for Cpdi {
    const DEGREE: u8 = 1;
    const DOMAIN: Domain = Domain::Follows;
    const GRADIENT_OF_WEIGHT: bool = false;
    const ONE_PATCH: bool = false;

    type Patch<const D: usize> = Corner<D>;

    #[inline(always)]
    fn patches<const D: usize>(
        grid: &Grid<D>,
        particles: &Particles<D>,
        p: usize,
        mut visit: impl FnMut(&Corner<D>),
    ) {
        if grid.cell(&particles.x[p]).is_none() {
            return;
        }
        let own: [f64; D] = array(0.0, |axis| grid.wrapped(&particles.x[p], axis));
        let (centre, domain) = within(grid, particles, p);
        let corners = 1_usize << D;
        let share = 1.0 / corners as f64;
        let inverse_transposed = cofactor(&domain) * (grid.inverse_h() / det(&domain));
        for corner in 0..corners {
            let side = Vector::from_fn(|axis, _| if corner >> axis & 1 == 0 { -1.0 } else { 1.0 });
            let at = centre + times(&domain, &side);
            let mut axes = array(Weights1d::NONE, |axis| hats(grid, at[axis], own[axis], axis));
            let Weights1d { first, weight, slope, offset, .. } = axes[0];
            axes[0] = Weights1d::new(first, array(0.0, |k| weight[k] * share), slope, offset);
            visit(&Corner { hats: Product(axes), outward: times(&inverse_transposed, &side) });
        }
    }

    /// Counts the nodes of the cells that contain the corners. A node shared by two corners counts
    /// twice.
    fn support(dimension: usize) -> u64 {
        4_u64.pow(dimension as u32)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mpm::basis::Linear;
    use approx::assert_abs_diff_eq;
    use rstest::rstest;

    const CELLS: usize = 6;

    fn grid<const D: usize>(periodic: bool) -> Grid<D> {
        let counts = [Cpdi::count(CELLS, periodic); D];
        Grid::new(Vector::zeros(), 0.5, [CELLS; D], [periodic; D], counts)
    }

    fn particle<const D: usize>(x: Vector<D>, domain: Matrix<D>) -> Particles<D> {
        let mut particles = Particles::cubes([1; D]);
        (particles.x[0], particles.domain) = (x, vec![domain]);
        particles
    }

    /// Returns weight and gradient of every node, summed over the corners of the particle domain.
    fn seen<B: Basis, const D: usize>(
        grid: &Grid<D>,
        particles: &Particles<D>,
    ) -> Vec<(f64, Vector<D>)> {
        let mut seen = vec![(0.0, Vector::zeros()); grid.nodes()];
        B::visit(grid, particles, 0, |i| {
            seen[i.node].0 += i.weight;
            seen[i.node].1 += i.gradient;
        });
        seen
    }

    /// Compares weights and gradients with averages of the interpolated hat functions and their
    /// slopes along the domain vectors, `dN/dxi_a = r_a . grad N`. The averages use two Gauss
    /// points per axis. This quadrature is exact for functions multilinear in xi.
    fn averages<const D: usize>(periodic: bool) {
        let grid = grid::<D>(periodic);
        let x = Vector::from_fn(|axis, _| 1.4 + 0.07 * axis as f64);
        let domain = Matrix::from_fn(|i, j| if i == j { 0.4 } else { 0.3 * (i as f64 - j as f64) });
        let signs = |k: usize| Vector::<D>::from_fn(|a, _| 2.0 * (k >> a & 1) as f64 - 1.0);
        let corners: Vec<_> = (0..1 << D)
            .map(|c| seen::<Linear, D>(&grid, &particle(x + domain * signs(c), domain)))
            .collect();
        let field = |xi: &Vector<D>, i: usize| -> f64 {
            let share = |c: usize| {
                signs(c).iter().zip(xi).map(|(s, xi)| 0.5 * (1.0 + s * xi)).product::<f64>()
            };
            (0..1 << D).map(|c| share(c) * corners[c][i].0).sum()
        };
        let mean = |value: &dyn Fn(Vector<D>) -> f64| -> f64 {
            (0..1 << D).map(|k| value(signs(k) / f64::sqrt(3.0))).sum::<f64>() / f64::from(1 << D)
        };
        for (i, (weight, gradient)) in
            seen::<Cpdi, D>(&grid, &particle(x, domain)).iter().enumerate()
        {
            assert_abs_diff_eq!(*weight, mean(&|xi| field(&xi, i)), epsilon = 1e-14);
            for axis in 0..D {
                let mut step = Vector::zeros();
                step[axis] = 0.25;
                let slope = |xi| (field(&(xi + step), i) - field(&(xi - step), i)) / 0.5;
                let along = domain.column(axis).dot(gradient);
                assert_abs_diff_eq!(along, mean(&slope), epsilon = 1e-13);
            }
        }
    }

    #[rstest]
    fn weight_and_gradient_are_averages_over_the_domain(#[values(false, true)] periodic: bool) {
        averages::<1>(periodic);
        averages::<2>(periodic);
        averages::<3>(periodic);
    }

    /// Tests domains in 2-D with rotation, shear and very large stretch.
    #[rstest]
    #[case::longer_than_the_grid(20.0)]
    #[case::far_longer(1e8)]
    #[case::as_long_as_can_be(1e300)]
    fn weights_of_a_long_domain_sum_to_one(
        #[case] length: f64,
        #[values(false, true)] periodic: bool,
    ) {
        let domain = Matrix::<2>::new(1.0, -0.5, 0.7, 0.2) * length;
        let seen = seen::<Cpdi, 2>(&grid(periodic), &particle(Vector::<2>::new(0.0, 1.3), domain));
        assert!(seen.iter().all(|(weight, _)| *weight >= 0.0));
        assert_abs_diff_eq!(seen.iter().map(|s| s.0).sum::<f64>(), 1.0, epsilon = 1e-14);
        assert_abs_diff_eq!(
            seen.iter().map(|s| s.1).sum::<Vector<2>>().norm(),
            0.0,
            epsilon = 1e-13
        );
    }
}
