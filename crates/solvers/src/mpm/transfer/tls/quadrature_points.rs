//! Quadrature points: the Gauss points of full cells, and the particles in cells at the boundary of
//! the body. Gauss points are not used in boundary cells, because a polynomial fitted to the
//! particles would extend outside the body.

use crate::mpm::foundation::algebra::{Vector, zeros};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use mpm_subject::{Column, Entry};

/// Gauss points and weights along an axis; exact for a cubic B-spline times a linear field.
const RULE: [(f64, f64); 3] = [
    (-0.774_596_669_241_483_4, 5.0 / 18.0),
    (0.0, 8.0 / 18.0),
    (0.774_596_669_241_483_4, 5.0 / 18.0),
];

/// Fraction of h^2 below which a second moment of the particle positions in a cell counts as zero.
const SMALLEST: f64 = 1e-6;

/// A point at which the fields of a cell are integrated.
#[derive(Debug, Clone)]
pub(in crate::mpm) struct QuadraturePoint<const D: usize> {
    pub(in crate::mpm) x: Vector<D>,
    pub(in crate::mpm) volume: f64,
    /// Index of the particle; `None` for a Gauss point.
    pub(in crate::mpm) particle: Option<usize>,
    /// Centre of the cell of the point (m).
    pub(in crate::mpm) centre: Vector<D>,
    /// Value (m^2) below which a second moment of the particle positions in the cell counts as
    /// zero.
    pub(in crate::mpm) smallest: f64,
    pub(in crate::mpm) members: (usize, usize),
}

/// All quadrature points, and the particles sorted by cell.
#[derive(Debug, Clone, Default)]
pub(in crate::mpm) struct QuadraturePoints<const D: usize> {
    pub(in crate::mpm) all: Vec<QuadraturePoint<D>>,
    /// Position of each particle (m), wrapped into the grid on periodic axes.
    pub(in crate::mpm) x: Vec<Vector<D>>,
    cell: Vec<usize>,
    /// Indices of the particles, cell by cell.
    order: Vec<usize>,
    /// Start of each cell in `order`, and the end of the last cell.
    first: Vec<usize>,
}

impl<const D: usize> Entry for QuadraturePoint<D> {}

impl<const D: usize> QuadraturePoints<D> {
    pub(in crate::mpm) fn columns(&self) -> [Column<'_>; 5] {
        [
            Column::of_particles("quadrature point", &self.all),
            Column::of_particles("wrapped x", &self.x),
            Column::of_particles("cell", &self.cell),
            Column::of_particles("sorted particle", &self.order),
            Column::of_nodes("first of cell", &self.first),
        ]
    }

    /// Allocates all arrays, and returns the maximum number of quadrature points.
    pub(in crate::mpm) fn start(&mut self, grid: &Grid<D>, particles: &Particles<D>) -> usize {
        let cells: usize = grid.cells.iter().product();
        let most = particles.len().min(cells) * RULE.len().pow(D as u32) + particles.len();
        self.all.reserve(most);
        self.x.resize(particles.len(), zeros());
        self.cell.resize(particles.len(), 0);
        self.order.resize(particles.len(), 0);
        self.first.resize(cells + 2, 0);
        most
    }

    pub(in crate::mpm) fn members(&self, point: &QuadraturePoint<D>) -> &[usize] {
        &self.order[point.members.0..point.members.1]
    }

    /// Replaces the quadrature points by those for the current particle positions.
    pub(in crate::mpm) fn place(&mut self, grid: &Grid<D>, particles: &Particles<D>) {
        self.sort(grid, particles);
        self.all.clear();
        let cells: usize = grid.cells.iter().product();
        for cell in 0..cells {
            let members = (self.first[cell], self.first[cell + 1]);
            if members.0 == members.1 {
                continue;
            }
            let index = unfold(cell, &grid.cells);
            let centre =
                Vector::from_fn(|axis, _| grid.origin[axis] + (index[axis] as f64 + 0.5) * grid.h);
            let smallest = SMALLEST * grid.h * grid.h;
            let point = QuadraturePoint {
                x: centre,
                volume: 0.0,
                particle: None,
                centre,
                smallest,
                members,
            };
            if self.is_full(&index, grid) {
                self.all.extend(gauss(grid.h).map(|(from_centre, volume)| QuadraturePoint {
                    x: centre + from_centre,
                    volume,
                    ..point.clone()
                }));
            } else {
                self.all.extend(self.order[members.0..members.1].iter().map(|&p| {
                    QuadraturePoint {
                        x: particles.x[p],
                        volume: particles.vol[p],
                        particle: Some(p),
                        ..point.clone()
                    }
                }));
            }
        }
    }

    /// Sorts the particles by counting, which preserves their order within a cell. Particles
    /// outside the grid are ignored, as in the particle loops.
    fn sort(&mut self, grid: &Grid<D>, particles: &Particles<D>) {
        let cells: usize = grid.cells.iter().product();
        self.first.fill(0);
        for ((cell, inside), x) in self.cell.iter_mut().zip(&mut self.x).zip(&particles.x) {
            *inside = Vector::from_fn(|axis, _| {
                // Positions on axes that are not periodic are not changed, not even by rounding.
                let turns = if grid.periodic[axis] { grid.turns(x, axis) } else { 0.0 };
                x[axis] - turns * grid.cells[axis] as f64 * grid.h
            });
            *cell = grid.cell(x).map_or(cells, |index| fold(&index, &grid.cells));
            self.first[*cell + 1] += 1;
        }
        for cell in 0..=cells {
            self.first[cell + 1] += self.first[cell];
        }
        // Each start advances to the start of the next cell. The starts are restored below.
        for (p, cell) in self.cell.iter().enumerate() {
            self.order[self.first[*cell]] = p;
            self.first[*cell] += 1;
        }
        self.first.rotate_right(1);
        self.first[0] = 0;
    }

    /// Whether every neighbour of a cell across a face either contains particles or is a wall.
    fn is_full(&self, index: &[usize; D], grid: &Grid<D>) -> bool {
        (0..D).all(|axis| {
            let n = grid.cells[axis];
            let held = |along: usize| {
                let mut neighbour = *index;
                neighbour[axis] = along;
                let cell = fold(&neighbour, &grid.cells);
                self.first[cell] < self.first[cell + 1]
            };
            let (here, periodic) = (index[axis], grid.periodic[axis]);
            let low = if here > 0 { held(here - 1) } else { !periodic || held(n - 1) };
            let high = if here + 1 < n { held(here + 1) } else { !periodic || held(0) };
            low && high
        })
    }
}

/// Returns the Gauss points in a cell, relative to its centre (m), with their volumes (m^D).
fn gauss<const D: usize>(h: f64) -> impl Iterator<Item = (Vector<D>, f64)> {
    (0..RULE.len().pow(D as u32)).map(move |k| {
        let (mut rest, mut x, mut volume) = (k, zeros(), 1.0);
        for axis in 0..D {
            let (abscissa, weight) = RULE[rest % RULE.len()];
            rest /= RULE.len();
            x[axis] = 0.5 * h * abscissa;
            volume *= weight * h;
        }
        (x, volume)
    })
}

/// Returns the index of a cell from its index on each axis. The first axis varies fastest.
fn fold<const D: usize>(index: &[usize; D], counts: &[usize; D]) -> usize {
    (0..D).rev().fold(0, |number, axis| number * counts[axis] + index[axis])
}

fn unfold<const D: usize>(mut cell: usize, counts: &[usize; D]) -> [usize; D] {
    std::array::from_fn(|axis| {
        let index = cell % counts[axis];
        cell /= counts[axis];
        index
    })
}
