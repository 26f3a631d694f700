//! Finds the cells of particles, four particles at a time.

use crate::mpm::foundation::algebra::{Vector, WHOLE, array, zeros};
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::packed_grid::Layout;
use crate::mpm::foundation::simd::{F64x4, LANES, Simd};

/// Quantities that a pass needs in addition to the values of the basis functions.
#[derive(Debug, Clone, Copy)]
pub struct WeightNeeds {
    /// Whether the pass needs derivatives.
    pub(in crate::mpm) slopes: bool,
    /// Whether the pass needs offsets from the particle and their variance.
    pub(in crate::mpm) offsets: bool,
}

/// Grid data needed to locate particles, small enough to stay in registers.
#[derive(Debug, Clone, Copy)]
pub struct CellLocator<const D: usize> {
    pub(super) h: f64,
    pub(super) inverse_h: f64,
    origin: [f64; D],
    /// Number of cells along each axis.
    pub(super) ends: [f64; D],
    pub(super) periodic: [bool; D],
    pub(in crate::mpm) layout: Layout,
    pub(super) needs: WeightNeeds,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct CellPositions<F, const D: usize> {
    pub(super) cell: [F; D],
    /// Position in the cell, from 0 to 1.
    pub(super) xi: [F; D],
    /// Mask of valid particles inside the grid: bit k for particle k.
    pub(super) inside: u32,
}

const ALL: u32 = (1 << LANES) - 1;

impl<const D: usize> CellLocator<D> {
    #[inline]
    pub(in crate::mpm) fn new(grid: &Grid<D>, layout: Layout, needs: WeightNeeds) -> Self {
        Self {
            h: grid.h,
            inverse_h: grid.inverse_h(),
            origin: array(0.0, |axis| grid.origin[axis]),
            ends: array(0.0, |axis| grid.cells[axis] as f64),
            periodic: grid.periodic,
            layout,
            needs,
        }
    }

    /// Finds the cells of four particles starting at `first`, like [`Grid::locate`].
    #[inline(always)]
    pub(super) fn locate<S: Simd>(
        &self,
        simd: S,
        grid: &Grid<D>,
        x: &[Vector<D>],
        first: usize,
    ) -> CellPositions<S::F64x4, D> {
        let zero = simd.splat(0.0);
        let mut places = CellPositions { cell: [zero; D], xi: [zero; D], inside: ALL };
        // The four positions are read by reference. Copying them would be slow, because
        // store-to-load forwarding fails for scalar stores followed by a vector load.
        let few;
        let x = if let Some(four) = x[first..].first_chunk() {
            four
        } else {
            few = last(&x[first..]);
            &few
        };
        for axis in 0..D {
            let at = [x[0][axis], x[1][axis], x[2][axis], x[3][axis]];
            let s = (simd.load(at) + -self.origin[axis]) * self.inverse_h;
            let cell = s.floor();
            (places.cell[axis], places.xi[axis]) = (cell, s - cell);
            if !s.are_in(0.0, self.ends[axis]) {
                let (cell, xi, inside) = at_ends(grid, axis, s.into());
                (places.cell[axis], places.xi[axis]) = (simd.load(cell), simd.load(xi));
                places.inside &= inside;
            }
        }
        places
    }

    /// Returns the index of each cell's first node in a packed field.
    #[inline(always)]
    pub(super) fn starts<F: F64x4>(&self, cell: &[F; D]) -> [u32; LANES] {
        let mut start = cell[0];
        for axis in 1..D {
            start += cell[axis] * self.layout.strides[axis] as f64;
        }
        // For an `f64` x above 2^52, the last bits hold the integer x - 2^52.
        let whole: [f64; LANES] = (start + (WHOLE - self.layout.before as f64)).into();
        array(0, |lane| whole[lane].to_bits() as u32)
    }
}

/// Returns the positions of the last one to three particles, padded with NaN.
#[cold]
#[inline(never)]
fn last<const D: usize>(x: &[Vector<D>]) -> [Vector<D>; LANES] {
    array(zeros(), |k| x.get(k).copied().unwrap_or(Vector::from_element(f64::NAN)))
}

/// Returns cells, positions in the cells, and the mask of particles inside the grid, for positions
/// `s` (in cells) along an axis. This slow path handles values of `s` that are NaN, at the end of
/// the axis or outside the axis.
#[cold]
#[inline(never)]
fn at_ends<const D: usize>(
    grid: &Grid<D>,
    axis: usize,
    s: [f64; LANES],
) -> ([f64; LANES], [f64; LANES], u32) {
    let (mut cells, mut places, mut inside) = ([0.0; LANES], [0.0; LANES], 0);
    for lane in 0..LANES {
        if let Some((cell, xi)) = grid.locate_along(s[lane], axis) {
            (cells[lane], places[lane]) = (cell, xi);
            inside |= 1 << lane;
        }
    }
    (cells, places, inside)
}
