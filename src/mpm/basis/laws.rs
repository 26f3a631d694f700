//! The laws that every registered basis is held to, in 1-D, 2-D and 3-D, inside and at walls.

use super::{Basis, BasisName, with_basis};
use crate::mpm::{algebra::Vector, grid::Grid};
use approx::assert_abs_diff_eq;
use rstest::rstest;

/// Points of a grid of 4 cells a side: scattered inside, on nodes, on walls and in corners.
fn points<const D: usize>(grid: &Grid<D>) -> Vec<Vector<D>> {
    let along = [0.0, 0.07, 0.5, 1.0, 1.93, 2.5, 3.0, 3.999, 4.0];
    (0..60)
        .map(|k| {
            Vector::from_fn(|axis, _| {
                grid.origin[axis] + grid.h * along[(k * (2 * axis + 1) + axis) % along.len()]
            })
        })
        .collect()
}

fn hold<B: Basis, const D: usize>() {
    let grid = Grid::<D>::new(Vector::from_element(-0.3), 0.25, [4; D]);
    let node_position =
        |i| Vector::<D>::from_fn(|a, _| grid.origin[a] + grid.h * grid.index_on_axis(i, a) as f64);
    for x in points(&grid) {
        let (mut sum, mut slope, mut position, mut visits) =
            (0.0, Vector::<D>::zeros(), Vector::<D>::zeros(), 0);
        B::visit(&grid, &x, |i, n, grad| {
            sum += n;
            slope += grad;
            position += node_position(i) * n;
            visits += 1;
        });
        assert_eq!(visits, B::support(D), "the work counter counts what is visited");
        assert_abs_diff_eq!(sum, 1.0, epsilon = 1e-14);
        assert_abs_diff_eq!(slope.norm(), 0.0, epsilon = 1e-12);
        if B::REPRODUCES_LINEAR {
            assert_abs_diff_eq!((position - x).norm(), 0.0, epsilon = 1e-14);
        }
    }
}

/// grad N against central differences, at points where the stencil does not reach over a node.
fn differentiate<B: Basis, const D: usize>() {
    let grid = Grid::<D>::new(Vector::from_element(-0.3), 0.25, [4; D]);
    let eps = 1e-6;
    let field = |x: &Vector<D>, node: usize| {
        let mut value = 0.0;
        B::visit(&grid, x, |i, n, _| value += if i == node { n } else { 0.0 });
        value
    };
    for along in [0.3, 1.4, 3.7] {
        let x = Vector::<D>::from_fn(|a, _| grid.origin[a] + grid.h * (along - 0.05 * a as f64));
        let mut seen = Vec::new();
        B::visit(&grid, &x, |i, _, grad| seen.push((i, *grad)));
        for (i, grad) in seen {
            for axis in 0..D {
                let mut step = Vector::zeros();
                step[axis] = eps;
                let difference = (field(&(x + step), i) - field(&(x - step), i)) / (2.0 * eps);
                assert_abs_diff_eq!(difference, grad[axis], epsilon = 1e-8);
            }
        }
    }
}

#[rstest]
fn every_basis_obeys_its_laws() {
    for &name in BasisName::ALL {
        with_basis!(name, B => {
            hold::<B, 1>();
            hold::<B, 2>();
            hold::<B, 3>();
            differentiate::<B, 1>();
            differentiate::<B, 2>();
            differentiate::<B, 3>();
        });
    }
}
