//! Properties that every registered basis must satisfy in 1-D, 2-D and 3-D: inside the grid, at
//! walls, and on periodic axes.

use super::{
    Basis, BasisName, CellLocator, Domain, FourLanes, Patch, ProductBatch, WeightNeeds, contract,
    product, weights_1d, with_basis,
};
use crate::mpm::foundation::algebra::{Matrix, Vector, dyad};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::packed_grid::Layout;
use crate::mpm::foundation::particles::{Block, Particles};
use crate::mpm::foundation::simd::{LANES, Plain};
use approx::assert_abs_diff_eq;
use rstest::rstest;

/// The basis added by `docs/exercises/basis.md`.
#[allow(unreachable_pub)] // the page has it in a public module
#[path = "../../../../../tests/exercises/quadratic_bernstein.rs"]
pub(in crate::mpm) mod exercise;

const CELLS: usize = 4;

fn grid<B: Basis, const D: usize>(periodic: bool) -> Grid<D> {
    let counts = [B::count(CELLS, periodic); D];
    Grid::new(Vector::from_element(-0.3), 0.25, [CELLS; D], [periodic; D], counts)
}

/// Half the length of the bounding box of the particle domain along any axis (cells).
const REACH: f64 = 0.3;

/// Creates one particle at `x`, with a domain of half a cell, slightly stretched and rotated.
fn particle<const D: usize>(grid: &Grid<D>, x: Vector<D>) -> Particles<D> {
    let (from, to) = (Vector::zeros(), Vector::from_element(0.5 * grid.h));
    let mut particles = Particles::fill(&Block { from, to, density: 1.0 }, grid.h, 1);
    particles.track_deformation();
    let turn = |i: usize, j: usize| 0.4 * REACH * (i as f64 - j as f64);
    let stretch = |i: usize| 4.0 * REACH - (0..D).map(|j| turn(i, j).abs()).sum::<f64>();
    particles.def_grad[0] = Matrix::from_fn(|i, j| if i == j { stretch(i) } else { turn(i, j) });
    particles.track_domains();
    particles.x[0] = x;
    particles
}

/// Returns scattered points, including points on nodes, walls and corners.
fn points<const D: usize>(grid: &Grid<D>) -> Vec<Vector<D>> {
    let along = [0.0, 0.07, REACH, 0.5, 1.0, 1.93, 2.5, 3.0, 3.999, 4.0];
    (0..60)
        .map(|k| {
            Vector::from_fn(|axis, _| {
                grid.origin[axis] + grid.h * along[(k * (2 * axis + 1) + axis) % along.len()]
            })
        })
        .collect()
}

/// Whether the particle domain is inside the walls. A domain that crosses a wall is truncated.
fn is_whole<B: Basis, const D: usize>(grid: &Grid<D>, x: &Vector<D>) -> bool {
    let inside = REACH - 1e-12..=CELLS as f64 - REACH + 1e-12;
    B::DOMAIN == Domain::Point || (0..D).all(|axis| inside.contains(&grid.local(x, axis)))
}

struct NodeWeights<const D: usize> {
    node: usize,
    weight: f64,
    gradient: Vector<D>,
    offset: Vector<D>,
}

/// Returns the nodes of the only particle and their weights. The function is not inlined, so all
/// tests share one compiled loop.
#[inline(never)]
fn node_weights<B: Basis, const D: usize>(
    grid: &Grid<D>,
    particles: &Particles<D>,
) -> Vec<NodeWeights<D>> {
    let mut nodes = Vec::new();
    B::visit(grid, particles, 0, |i| {
        let (node, weight, gradient, offset) = (i.node, i.weight, *i.gradient, i.offset);
        nodes.push(NodeWeights { node, weight, gradient, offset });
    });
    nodes
}

fn hold<B: Basis, const D: usize>(periodic: bool) {
    let grid = grid::<B, D>(periodic);
    for x in points(&grid) {
        let particles = particle(&grid, x);
        let (mut sum, mut slope) = (0.0, Vector::<D>::zeros());
        let mut mean = Vector::<D>::zeros();
        let (mut position, mut identity) = (Vector::<D>::zeros(), Matrix::<D>::zeros());
        let nodes = node_weights::<B, D>(&grid, &particles);
        for i in &nodes {
            assert!(i.weight >= 0.0, "no negative weight");
            sum += i.weight;
            slope += i.gradient;
            mean += i.offset * i.weight;
            let node = Vector::from_fn(|axis, _| {
                let index = grid.index_on_axis(i.node, axis);
                grid.origin[axis] + grid.h * B::abscissa(index, CELLS, periodic)
            });
            position += node * i.weight;
            identity += dyad(&node, &i.gradient);
        }
        assert!(nodes.len() as u64 <= B::support(D), "the work counter counts all that is visited");
        assert_abs_diff_eq!(sum, 1.0, epsilon = 1e-14);
        assert_abs_diff_eq!(slope.norm(), 0.0, epsilon = 1e-12);
        if B::ONE_PATCH {
            assert_abs_diff_eq!(mean.norm(), 0.0, epsilon = 1e-15);
        }
        if !periodic {
            assert_abs_diff_eq!((identity - Matrix::identity()).norm(), 0.0, epsilon = 1e-13);
        }
        if !periodic && is_whole::<B, D>(&grid, &x) {
            assert_abs_diff_eq!((position - x).norm(), 0.0, epsilon = 1e-14);
        }
    }
}

/// Compares grad N with central differences, for bases with `GRADIENT_OF_WEIGHT`. Points are
/// excluded if a node lies between the points of the difference, because gradients may jump at
/// nodes.
fn differentiate<B: Basis, const D: usize>(periodic: bool) {
    if !B::GRADIENT_OF_WEIGHT {
        return;
    }
    let grid = grid::<B, D>(periodic);
    let eps = 1e-6;
    let field = |x: Vector<D>, node: usize| {
        let nodes = node_weights::<B, D>(&grid, &particle(&grid, x));
        nodes.iter().filter(|i| i.node == node).map(|i| i.weight).sum::<f64>()
    };
    for along in [0.4, 1.55, 2.1, 3.6] {
        let x = Vector::<D>::from_fn(|a, _| grid.origin[a] + grid.h * (along - 0.02 * a as f64));
        for NodeWeights { node, gradient, .. } in node_weights::<B, D>(&grid, &particle(&grid, x)) {
            for axis in 0..D {
                let mut step = Vector::zeros();
                step[axis] = eps;
                let difference = (field(x + step, node) - field(x - step, node)) / (2.0 * eps);
                assert_abs_diff_eq!(difference, gradient[axis], epsilon = 1e-6);
            }
        }
    }
}

/// Compares patches computed for four particles at once with patches of single particles, bit for
/// bit.
fn fill<B: Basis, const D: usize>(periodic: bool) {
    let grid = grid::<B, D>(periodic);
    let layout = Layout::new(&grid);
    for four in points(&grid).chunks_exact(LANES) {
        let mut particles = particle(&grid, four[0]);
        particles.x = four.to_vec();
        particles.domain = vec![particles.domain[0]; LANES];
        let none = || ProductBatch::new(<B::Patch<D> as Patch<D>>::ShapeOfPatch::default());
        let (mut together, mut alone) = (none(), none());
        let needs = WeightNeeds { slopes: true, offsets: true };
        let locator = CellLocator::new(&grid, layout, needs);
        let lanes = FourLanes { particle: 0, lane: LANES };
        let one = B::patches_x4(Plain, &grid, &locator, &particles, lanes, &mut together);
        for k in 0..LANES {
            let mut patches = 0;
            B::patches(&grid, &particles, k, |patch| {
                patch.put(LANES + k, &layout, &mut alone);
                patches += 1;
            });
            assert_eq!(one >> k & 1 == 1, patches == 1, "all that the particle sees");
        }
        if B::ONE_PATCH || one != 0 {
            assert_eq!(format!("{together:?}"), format!("{alone:?}"), "{four:?}");
        }
    }
}

fn obey<B: Basis>(periodic: bool) {
    fill::<B, 1>(periodic);
    fill::<B, 2>(periodic);
    fill::<B, 3>(periodic);
    hold::<B, 1>(periodic);
    hold::<B, 2>(periodic);
    hold::<B, 3>(periodic);
    differentiate::<B, 1>(periodic);
    differentiate::<B, 2>(periodic);
    differentiate::<B, 3>(periodic);
}

#[rstest]
fn every_basis_obeys_its_laws(#[values(false, true)] periodic: bool) {
    for &name in BasisName::ALL {
        with_basis!(name, B => obey::<B>(periodic));
    }
    obey::<exercise::QuadraticBernstein>(periodic);
}
