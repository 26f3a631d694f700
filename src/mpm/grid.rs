//! The background grid: a box of equal cells, and the fields on its nodes.

use super::algebra::Vector;

/// A Cartesian grid with cell size `h` on every axis. Nodes are numbered with the first axis
/// running fastest.
#[derive(Debug, Clone)]
pub struct Grid<const D: usize> {
    /// Position of the first node (m).
    pub origin: Vector<D>,
    /// Cell size (m).
    pub h: f64,
    /// Cells along each axis.
    pub cells: [usize; D],
    /// Nodal mass m_i (kg).
    pub mass: Vec<f64>,
    /// Nodal momentum, then velocity, v_i (kg m/s, then m/s).
    pub velocity: Vec<Vector<D>>,
    /// Nodal force f_i = f_int + f_ext (N).
    pub force: Vec<Vector<D>>,
    /// Nodal acceleration a_i (m/s2).
    pub acceleration: Vec<Vector<D>>,
    inverse_h: f64,
}

impl<const D: usize> Grid<D> {
    /// A grid of `cells` cells of size `h` from `origin` on.
    pub fn new(origin: Vector<D>, h: f64, cells: [usize; D]) -> Self {
        let nodes = cells.iter().map(|n| n + 1).product();
        Self {
            origin,
            h,
            cells,
            mass: vec![0.0; nodes],
            velocity: vec![Vector::zeros(); nodes],
            force: vec![Vector::zeros(); nodes],
            acceleration: vec![Vector::zeros(); nodes],
            inverse_h: 1.0 / h,
        }
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.mass.len()
    }

    /// The cell that holds `x`, or `None` outside the grid (or where `x` is not a number). A
    /// point on the last face belongs to the last cell.
    #[inline]
    pub fn cell(&self, x: &Vector<D>) -> Option<[usize; D]> {
        let mut cell = [0; D];
        for axis in 0..D {
            let offset = self.local(x, axis);
            let n = self.cells[axis];
            if !(offset >= 0.0 && offset <= n as f64) {
                return None;
            }
            cell[axis] = (offset as usize).min(n - 1);
        }
        Some(cell)
    }

    /// Position along `axis` in units of h, counted from the first node.
    #[inline]
    pub fn local(&self, x: &Vector<D>, axis: usize) -> f64 {
        (x[axis] - self.origin[axis]) * self.inverse_h
    }

    /// 1/h (1/m).
    #[inline]
    pub fn inverse_h(&self) -> f64 {
        self.inverse_h
    }

    /// Number of the node with the given index on each axis.
    #[inline]
    pub fn node(&self, index: &[usize; D]) -> usize {
        let mut number = 0;
        for axis in (0..D).rev() {
            number = number * (self.cells[axis] + 1) + index[axis];
        }
        number
    }

    /// Index of a node on one axis.
    pub fn index_on_axis(&self, node: usize, axis: usize) -> usize {
        let stride: usize = self.cells[..axis].iter().map(|n| n + 1).product();
        node / stride % (self.cells[axis] + 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_indices_agree() {
        let grid = Grid::<3>::new(Vector::zeros(), 0.5, [2, 3, 4]);
        for node in 0..grid.nodes() {
            let index = std::array::from_fn(|axis| grid.index_on_axis(node, axis));
            assert_eq!(grid.node(&index), node);
        }
    }

    #[test]
    fn outside_and_not_a_number_have_no_cell() {
        let grid = Grid::<1>::new(Vector::<1>::new(1.0), 0.5, [4]);
        for (x, cell) in [(1.0, Some([0])), (3.0, Some([3])), (3.001, None), (f64::NAN, None)] {
            assert_eq!(grid.cell(&Vector::<1>::new(x)), cell, "x = {x}");
        }
    }
}
