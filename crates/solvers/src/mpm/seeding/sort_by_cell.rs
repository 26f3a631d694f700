//! Sorts particles by cell, so that neighbours in space are neighbours in memory.
//!
//! Seeded bodies are nearly sorted. In a large unsorted body, a step costs several times as much,
//! because consecutive particles contribute to distant nodes. Particles are therefore sorted once,
//! before the solver is set up.

use crate::mpm::foundation::algebra::Vector;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;

impl<const D: usize> Particles<D> {
    /// Sorts the particles by the cells of `grid`, and returns the old index of each particle.
    /// Particles in the same cell keep their order, and particles outside the grid come last. Must
    /// be called before effects or transfers create their own columns.
    pub fn sort_by_cell(&mut self, grid: &Grid<D>) -> Vec<usize> {
        // Particles outside the grid get an additional cell number after all cells.
        let nowhere = grid.cells.iter().product();
        let place = |x: &Vector<D>| {
            grid.cell(x).map_or(nowhere, |cell| {
                (0..D).rev().fold(0, |number, axis| number * grid.cells[axis] + cell[axis])
            })
        };
        let cells: Vec<usize> = self.x.iter().map(place).collect();
        // Counting sort: the first position of a cell is the number of particles in previous cells.
        let mut next = vec![0; nowhere + 2];
        for cell in &cells {
            next[cell + 1] += 1;
        }
        for cell in 1..next.len() {
            next[cell] += next[cell - 1];
        }
        let mut order = vec![0; self.len()];
        for (p, &cell) in cells.iter().enumerate() {
            order[next[cell]] = p;
            next[cell] += 1;
        }
        let (vectors, scalars, matrices) = self.columns_mut();
        permute(vectors, &order);
        permute(scalars, &order);
        permute(matrices, &order);
        order
    }
}

/// Moves entry `order[k]` to position k, in all existing columns. The sorted copy of each column is
/// written to the memory of the previous column, because allocation costs more than the moves.
fn permute<T: Copy, const N: usize>(columns: [&mut Vec<T>; N], order: &[usize]) {
    let mut spare = Vec::new();
    for column in columns.into_iter().filter(|column| !column.is_empty()) {
        spare.clear();
        spare.extend(order.iter().map(|&p| column[p]));
        std::mem::swap(column, &mut spare);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mpm::Block;

    fn body() -> (Grid<2>, Particles<2>) {
        let (from, to) = (Vector::zeros(), Vector::<2>::new(3.0, 2.0));
        let mut particles = Particles::fill(&Block { from, to, density: 1.0 }, 1.0, 2);
        particles.track_domains();
        for p in 0..particles.len() {
            (particles.mass[p], particles.v[p][1], particles.sigma[p][(1, 0)]) =
                (p as f64, p as f64, p as f64);
        }
        (Grid::new(from, 1.0, [3, 2], [false; 2], [4, 3]), particles)
    }

    #[test]
    fn all_columns_are_sorted_by_cell() {
        let (grid, mut particles) = body();
        let before = particles.clone();
        let order = particles.sort_by_cell(&grid);
        let mut cells = Vec::new();
        for (p, &old) in order.iter().enumerate() {
            assert_eq!(particles.x[p], before.x[old]);
            assert_eq!(particles.x0[p], before.x0[old]);
            assert_eq!((particles.mass[p], particles.v[p][1]), (old as f64, old as f64));
            assert_eq!(particles.sigma[p][(1, 0)], old as f64);
            let [i, j] = grid.cell(&particles.x[p]).unwrap();
            cells.push((j, i, old));
        }
        assert!(cells.is_sorted(), "rows of cells, and within a cell as before: {cells:?}");
        assert!(particles.current_position.is_empty() && particles.temperature.is_empty());
    }

    #[test]
    fn particles_outside_the_grid_come_last() {
        let (grid, mut particles) = body();
        particles.x[0] = Vector::<2>::new(-1.0, f64::NAN);
        assert_eq!(particles.sort_by_cell(&grid).last(), Some(&0));
    }
}
