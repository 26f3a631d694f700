//! The background grid: a box of equal cells, and fields on its nodes.

use super::algebra::{Vector, floor, whole, zeros};
use super::simd::vectorized;
use super::threads::PIECES;
use mpm_subject::Column;

/// A Cartesian grid with cell size `h` on every axis. The first axis varies fastest in node
/// indices.
#[derive(Debug, Clone)]
pub struct Grid<const D: usize> {
    /// Position of the first node (m).
    pub origin: Vector<D>,
    /// Cell size (m).
    pub h: f64,
    /// Number of cells along each axis.
    pub cells: [usize; D],
    /// Whether each axis is periodic.
    pub periodic: [bool; D],
    /// Number of basis functions ("nodes") along each axis.
    pub counts: [usize; D],
    /// Nodal mass m_i (kg).
    pub mass: Vec<f64>,
    /// Nodal momentum (kg m/s); later in the step, nodal velocity v_i (m/s).
    pub velocity: Vec<Vector<D>>,
    /// Nodal force f_i = f_int + f_ext (N).
    pub force: Vec<Vector<D>>,
    /// Nodal acceleration a_i (m/s2).
    pub acceleration: Vec<Vector<D>>,
    inverse_h: f64,
    /// Number of cells along each axis, as `f64` for comparison with positions.
    ends: [f64; D],
}

impl<const D: usize> Grid<D> {
    /// Creates a grid of `cells` cells of size `h` with its lowest corner at `origin`. `counts` is
    /// the number of basis functions along each axis ([`Basis::count`](crate::mpm::Basis::count)).
    pub fn new(
        origin: Vector<D>,
        h: f64,
        cells: [usize; D],
        periodic: [bool; D],
        counts: [usize; D],
    ) -> Self {
        let nodes = counts.iter().product();
        Self {
            origin,
            h,
            cells,
            periodic,
            counts,
            mass: vec![0.0; nodes],
            velocity: vec![zeros(); nodes],
            force: vec![zeros(); nodes],
            acceleration: vec![zeros(); nodes],
            inverse_h: 1.0 / h,
            ends: cells.map(|cells| cells as f64),
        }
    }

    /// Returns the number of nodes.
    pub fn nodes(&self) -> usize {
        self.mass.len()
    }

    /// Returns the columns of the nodal fields.
    pub fn columns(&self) -> [Column<'_>; 4] {
        [
            Column::of_nodes("mass", &self.mass),
            Column::of_nodes("velocity", &self.velocity),
            Column::of_nodes("force", &self.force),
            Column::of_nodes("acceleration", &self.acceleration),
        ]
    }

    /// Deletes the fields that describe motion, for a body that does not move.
    pub(in crate::mpm) fn forget_motion(&mut self) {
        (self.velocity, self.force, self.acceleration) = (Vec::new(), Vec::new(), Vec::new());
    }

    /// Returns the volume of a cell (m^D).
    pub fn cell_volume(&self) -> f64 {
        (0..D).map(|_| self.h).product()
    }

    /// Divides each value by the mass of its node; the result is zero for nodes without mass.
    pub fn divide_by_mass(&self, field: &mut [Vector<D>]) {
        PIECES.each(field, &|k, piece| {
            let mass = &self.mass[k * PIECES.length..];
            vectorized(
                #[inline(always)]
                || {
                    for (value, m) in piece.iter_mut().zip(mass) {
                        for axis in 0..D {
                            // The ratio is always computed, because a branch would cost more.
                            let ratio = value[axis] / *m;
                            value[axis] = if *m > 0.0 { ratio } else { 0.0 };
                        }
                    }
                },
            );
        });
    }

    /// Returns the cell that contains `x`; `None` outside the grid or if `x` is NaN. A point on the
    /// last face belongs to the last cell.
    #[inline]
    pub fn cell(&self, x: &Vector<D>) -> Option<[usize; D]> {
        let mut cell = [0; D];
        for axis in 0..D {
            let s = self.wrapped(x, axis);
            let n = self.cells[axis];
            if !(s >= 0.0 && s <= n as f64) {
                return None;
            }
            cell[axis] = (s as usize).min(n - 1);
        }
        Some(cell)
    }

    /// Returns the cell that contains `x`, and the position in the cell, from 0 to 1 on each axis;
    /// `None` outside the grid.
    #[inline(always)]
    pub fn locate(&self, x: &Vector<D>) -> Option<([usize; D], [f64; D])> {
        let (mut cell, mut xi) = ([0; D], [0.0; D]);
        for axis in 0..D {
            let (low, place) = self.locate_along(self.local(x, axis), axis)?;
            (cell[axis], xi[axis]) = (whole(low), place);
        }
        Some((cell, xi))
    }

    /// Returns the cell index and the position in the cell, from 0 to 1, on one axis. `s` is the
    /// position in units of h ([`Grid::local`]). `None` outside the grid.
    #[inline(always)]
    pub(in crate::mpm) fn locate_along(&self, s: f64, axis: usize) -> Option<(f64, f64)> {
        let (s, end) = (self.within(s, axis), self.ends[axis]);
        if !(s >= 0.0 && s <= end) {
            return None;
        }
        let (low, last) = (floor(s), end - 1.0);
        let low = if low > last { last } else { low };
        Some((low, s - low))
    }

    /// Returns the position along `axis` in units of h, measured from the first wall.
    #[inline(always)]
    pub fn local(&self, x: &Vector<D>, axis: usize) -> f64 {
        (x[axis] - self.origin[axis]) * self.inverse_h
    }

    /// Returns the position along `axis` in units of h ([`Grid::local`]), wrapped into the grid on
    /// a periodic axis.
    #[inline(always)]
    pub fn wrapped(&self, x: &Vector<D>, axis: usize) -> f64 {
        self.within(self.local(x, axis), axis)
    }

    #[inline(always)]
    fn within(&self, s: f64, axis: usize) -> f64 {
        let n = self.ends[axis];
        if !self.periodic[axis] || (s >= 0.0 && s < n) {
            return s;
        }
        s - n * libm::floor(s / n)
    }

    /// Returns the number of periods between `x` and the grid on a periodic axis.
    pub fn turns(&self, x: &Vector<D>, axis: usize) -> f64 {
        libm::floor(self.local(x, axis) / self.cells[axis] as f64)
    }

    /// Wraps the index of a basis function into the grid on a periodic axis.
    #[inline]
    pub fn wrap(&self, index: usize, axis: usize) -> usize {
        if self.periodic[axis] { index % self.counts[axis] } else { index }
    }

    /// Wraps an index like [`Grid::wrap`]; `index` is an integral number that may be negative.
    #[inline(always)]
    pub fn wrap_signed(&self, index: f64, axis: usize) -> usize {
        let n = self.counts[axis] as f64;
        let beyond = self.periodic[axis] && !(index >= 0.0 && index < n);
        let index = if beyond { index - n * libm::floor(index / n) } else { index };
        index as i64 as usize
    }

    /// Returns 1/h (1/m).
    #[inline(always)]
    pub fn inverse_h(&self) -> f64 {
        self.inverse_h
    }

    /// Returns the node number for the given index on each axis.
    #[inline]
    pub fn node(&self, index: &[usize; D]) -> usize {
        let mut number = 0;
        for axis in (0..D).rev() {
            number = number * self.counts[axis] + index[axis];
        }
        number
    }

    /// Returns the index of a node on one axis.
    pub fn index_on_axis(&self, node: usize, axis: usize) -> usize {
        let stride: usize = self.counts[..axis].iter().product();
        node / stride % self.counts[axis]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn cell_plus_position_in_cell_is_the_position(x in -2.0..20.0_f64, periodic: bool) {
            let grid = Grid::<1>::new(Vector::<1>::new(1.0), 0.5, [7], [periodic], [8]);
            let x = Vector::<1>::new(x);
            let found = grid.locate(&x);
            prop_assert_eq!(found.map(|(cell, _)| cell), grid.cell(&x));
            if let Some(([cell], [xi])) = found {
                prop_assert!((0.0..=1.0).contains(&xi));
                prop_assert_eq!(cell as f64 + xi, grid.wrapped(&x, 0));
            }
        }
    }

    #[test]
    fn points_outside_and_nan_have_no_cell() {
        let grid = Grid::<1>::new(Vector::<1>::new(1.0), 0.5, [4], [false], [5]);
        for (x, cell) in [(1.0, Some([0])), (3.0, Some([3])), (3.001, None), (f64::NAN, None)] {
            assert_eq!(grid.cell(&Vector::<1>::new(x)), cell, "x = {x}");
        }
    }

    #[test]
    fn every_point_of_a_periodic_axis_has_a_cell() {
        let grid = Grid::<1>::new(Vector::<1>::new(1.0), 0.5, [4], [true], [4]);
        for (x, cell) in [(1.0, 0), (3.0, 0), (0.9, 3), (-7.4, 3), (3.3, 0)] {
            assert_eq!(grid.cell(&Vector::<1>::new(x)), Some([cell]), "x = {x}");
        }
        assert_eq!((grid.wrap(5, 0), grid.wrap_signed(-1.0, 0)), (1, 3));
    }
}
