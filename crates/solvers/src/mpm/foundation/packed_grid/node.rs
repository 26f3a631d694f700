//! Nodes of packed fields (nodal values in the order of registers), and views of a field or of
//! consecutive layers of nodes.

use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::simd::{LANES, Plain, Register, Simd};
use std::fmt::Debug;

/// The numbers of one node of a packed field: momentum, mass and force, or some of these.
pub(in crate::mpm) trait PackedNode: Copy + Debug + Default + Send + Sync {
    /// Whether the node has separate lanes for force, next to momentum and mass.
    const IS_WIDE: bool;

    /// Register for the numbers of a node.
    type Lanes<S: Simd>: Register;

    /// Loads the numbers into a register.
    fn load<S: Simd>(&self, simd: S) -> Self::Lanes<S>;

    /// Stores the numbers of a register.
    fn store<S: Simd>(&mut self, numbers: Self::Lanes<S>);

    /// Returns a register whose lanes are all zero.
    #[inline(always)]
    fn zero<S: Simd>(simd: S) -> Self::Lanes<S> {
        Self::default().load(simd)
    }

    /// Creates the lanes from momentum and mass, without a force.
    fn of_inertia<S: Simd>(simd: S, inertia: S::F64x4) -> Self::Lanes<S>;

    /// Creates the lanes from a force, without momentum and mass.
    fn of_force<S: Simd>(simd: S, force: S::F64x4) -> Self::Lanes<S>;

    /// Joins the lanes of momentum and mass with the lanes of a force.
    fn join<S: Simd>(simd: S, inertia: S::F64x4, force: S::F64x4) -> Self::Lanes<S>;

    /// Adds the numbers of another node.
    #[inline(always)]
    fn add(&mut self, other: &Self) {
        self.store::<Plain>(self.load(Plain) + other.load(Plain));
    }

    /// Returns the first four numbers: momentum, and mass in the last lane.
    fn inertia(&self) -> [f64; LANES];

    /// Returns the four numbers that contain a force, starting at lane [`force_lane`].
    fn force(&self) -> [f64; LANES];
}

/// Returns the position of a force within the four lanes that contain it. In 1-D these lanes also
/// contain momentum and mass.
#[inline]
pub(in crate::mpm) const fn force_lane(dimension: usize) -> usize {
    if dimension == 1 { 1 } else { 0 }
}

/// Four numbers of a node, within one cache line.
#[derive(Debug, Clone, Copy)]
#[repr(align(32))]
pub(in crate::mpm) struct Node4(pub(in crate::mpm) [f64; LANES]);

/// Eight numbers of a node, in one cache line.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
pub(in crate::mpm) struct Node8([f64; 2 * LANES]);

// A derived `Default` would call the function of arrays, which is not always inlined.
impl Default for Node4 {
    #[inline(always)]
    fn default() -> Self {
        Self([0.0; LANES])
    }
}

impl Default for Node8 {
    #[inline(always)]
    fn default() -> Self {
        Self([0.0; 2 * LANES])
    }
}

impl PackedNode for Node4 {
    const IS_WIDE: bool = false;

    type Lanes<S: Simd> = S::F64x4;

    #[inline(always)]
    fn load<S: Simd>(&self, simd: S) -> S::F64x4 {
        simd.load(self.0)
    }

    #[inline(always)]
    fn store<S: Simd>(&mut self, numbers: S::F64x4) {
        self.0 = numbers.into();
    }

    #[inline(always)]
    fn of_inertia<S: Simd>(_: S, inertia: S::F64x4) -> S::F64x4 {
        inertia
    }

    #[inline(always)]
    fn of_force<S: Simd>(_: S, force: S::F64x4) -> S::F64x4 {
        force
    }

    #[inline(always)]
    fn join<S: Simd>(_: S, inertia: S::F64x4, force: S::F64x4) -> S::F64x4 {
        inertia + force
    }

    #[inline(always)]
    fn inertia(&self) -> [f64; LANES] {
        self.0
    }

    #[inline(always)]
    fn force(&self) -> [f64; LANES] {
        self.0
    }
}

impl PackedNode for Node8 {
    const IS_WIDE: bool = true;

    type Lanes<S: Simd> = S::F64x8;

    #[inline(always)]
    fn load<S: Simd>(&self, simd: S) -> S::F64x8 {
        simd.load_eight(self.0)
    }

    #[inline(always)]
    fn store<S: Simd>(&mut self, numbers: S::F64x8) {
        self.0 = numbers.into();
    }

    #[inline(always)]
    fn of_inertia<S: Simd>(simd: S, inertia: S::F64x4) -> S::F64x8 {
        simd.join(inertia, simd.splat(0.0))
    }

    #[inline(always)]
    fn of_force<S: Simd>(simd: S, force: S::F64x4) -> S::F64x8 {
        simd.join(simd.splat(0.0), force)
    }

    #[inline(always)]
    fn join<S: Simd>(simd: S, inertia: S::F64x4, force: S::F64x4) -> S::F64x8 {
        simd.join(inertia, force)
    }

    #[inline(always)]
    fn inertia(&self) -> [f64; LANES] {
        let [a, b, c, d, ..] = self.0;
        [a, b, c, d]
    }

    #[inline(always)]
    fn force(&self) -> [f64; LANES] {
        let [.., a, b, c, d] = self.0;
        [a, b, c, d]
    }
}

/// Number of nodes in the margin of an axis: one less than the maximum number of functions of a
/// patch.
pub(in crate::mpm) const MARGIN: usize = 3;

/// Memory layout of the nodes in a packed field or in a view of the field.
#[derive(Debug, Clone, Copy, Default)]
pub struct Layout {
    /// Distance between neighbours along each axis, followed by the number of nodes of the field.
    pub(in crate::mpm) strides: [usize; 4],
    /// Number of field nodes before the first node of the view.
    pub(in crate::mpm) before: usize,
}

impl Layout {
    pub(in crate::mpm) fn new<const D: usize>(grid: &Grid<D>) -> Self {
        let mut strides = [1; 4];
        for axis in 0..3 {
            let count = grid.counts.get(axis).map_or(1, |count| count + MARGIN);
            strides[axis + 1] = strides[axis] * count;
        }
        Self { strides, before: 0 }
    }

    /// Returns the position in the view of the node with these indices. A node before the view gets
    /// a position after the end of the view.
    #[inline(always)]
    pub(in crate::mpm) fn number<const D: usize>(&self, index: &[usize; D]) -> usize {
        let mut number = index[0];
        for axis in 1..D {
            number += index[axis] * self.strides[axis];
        }
        number.wrapping_sub(self.before)
    }

    /// Returns the distance of row `j` in plane `k` from the first row.
    #[inline(always)]
    pub(in crate::mpm) fn row(&self, j: usize, k: usize) -> usize {
        j * self.strides[1] + k * self.strides[2]
    }
}

/// Shared view of a packed field, for loops that read it.
#[derive(Debug, Clone, Copy)]
pub(in crate::mpm) struct FieldView<'a> {
    pub(in crate::mpm) nodes: &'a [Node4],
    pub(in crate::mpm) layout: Layout,
}

/// Mutable view of a packed field or of consecutive layers, for loops that add to it.
#[derive(Debug)]
pub(in crate::mpm) struct FieldViewMut<'a, N> {
    pub(in crate::mpm) nodes: &'a mut [N],
    pub(in crate::mpm) layout: Layout,
}

impl FieldView<'_> {
    #[inline(always)]
    pub(in crate::mpm) fn row(&self, start: usize, count: usize) -> &[Node4] {
        &self.nodes[start..start + count]
    }
}

impl<N: PackedNode> FieldViewMut<'_, N> {
    #[inline(always)]
    pub(in crate::mpm) fn reborrow(&mut self) -> FieldViewMut<'_, N> {
        FieldViewMut { nodes: self.nodes, layout: self.layout }
    }

    #[inline(always)]
    pub(in crate::mpm) fn row(&mut self, start: usize, count: usize) -> &mut [N] {
        &mut self.nodes[start..start + count]
    }

    #[inline]
    pub(in crate::mpm) fn clear(&mut self) {
        // `fill` is not always inlined.
        self.nodes.iter_mut().for_each(|node| *node = N::default());
    }

    /// Splits the view at the first node of a layer. Layers are perpendicular to the last of the D
    /// axes.
    pub(in crate::mpm) fn split_at<const D: usize>(self, layer: usize) -> (Self, Self) {
        let Self { nodes, layout } = self;
        let before = layout.before.max(layer * layout.strides[D - 1]);
        let (low, high) = nodes.split_at_mut(nodes.len().min(before - layout.before));
        (Self { nodes: low, layout }, Self { nodes: high, layout: Layout { before, ..layout } })
    }
}
