//! The uniform mesh: positions of nodes and quadrature points, interpolation between nodes, and
//! shape functions on the parent interval `-1 <= xi <= 1`.

use mpm_subject::named;

/// A quadrature point, at the same relative position in every element.
#[derive(Debug, Clone, Copy)]
pub(super) struct MeshPoint {
    /// Position in the element: 0 at its left end, 1 at its right end.
    pub(super) place: f64,
    pub(super) shape: PerNode,
    /// Derivatives of the shape functions with respect to X (1/m).
    pub(super) gradient: PerNode,
    /// Quadrature weight: the length that the point represents (m).
    pub(super) weight: f64,
}

/// A mesh of elements of the same kind and length.
#[derive(Debug, Clone)]
pub(super) struct Mesh {
    from: f64,
    to: f64,
    cells: usize,
    element: Element,
    points: Vec<MeshPoint>,
}

impl Mesh {
    /// Creates a mesh. The caller must check that `from < to` and `cells > 0`.
    pub(super) fn new(from: f64, to: f64, cells: usize, element: Element) -> Self {
        let half = 0.5 * (to - from) / cells as f64; // dX/dxi
        let points = element.quadrature().iter().map(|gauss| MeshPoint {
            place: 0.5 * (1.0 + gauss.xi),
            shape: element.shape(gauss.xi),
            gradient: element.gradient(gauss.xi).map(|slope| slope / half),
            weight: gauss.weight * half,
        });
        Self { from, to, cells, element, points: points.collect() }
    }

    pub(super) fn cells(&self) -> usize {
        self.cells
    }

    #[inline]
    pub(super) fn element(&self) -> Element {
        self.element
    }

    pub(super) fn cell_length(&self) -> f64 {
        (self.to - self.from) / self.cells as f64
    }

    #[inline]
    pub(super) fn points(&self) -> &[MeshPoint] {
        &self.points
    }

    #[inline]
    pub(super) fn points_of<const N: usize>(&self) -> &[MeshPoint; N] {
        self.points.first_chunk().unwrap_or_else(|| unreachable!("{N} nodes"))
    }

    #[inline]
    pub(super) fn nodes_of<const N: usize>(cell: usize, nodal: &[f64]) -> &[f64; N] {
        let local = nodal[cell * (N - 1)..].first_chunk();
        local.unwrap_or_else(|| unreachable!("cell {cell}"))
    }

    #[inline]
    pub(super) fn nodes_of_mut<const N: usize>(cell: usize, nodal: &mut [f64]) -> &mut [f64; N] {
        let local = nodal[cell * (N - 1)..].first_chunk_mut();
        local.unwrap_or_else(|| unreachable!("cell {cell}"))
    }

    pub(super) fn node_count(&self) -> usize {
        self.cells * self.element.degree() + 1
    }

    pub(super) fn node(&self, i: usize) -> f64 {
        self.from + (self.to - self.from) * i as f64 / (self.node_count() - 1) as f64
    }

    /// Returns the reference position of the point at `place` (0 to 1) in a cell.
    pub(super) fn position(&self, cell: usize, place: f64) -> f64 {
        self.from + (self.to - self.from) * (cell as f64 + place) / self.cells as f64
    }

    /// Returns the index of a cell's leftmost node. The indices of its other nodes follow.
    #[inline]
    pub(super) fn first_node(&self, cell: usize) -> usize {
        cell * self.element.degree()
    }

    #[inline]
    pub(super) fn local<'a>(&self, cell: usize, nodal: &'a [f64]) -> &'a [f64] {
        &nodal[self.first_node(cell)..][..self.element.nodes()]
    }

    #[inline]
    pub(super) fn local_mut<'a>(&self, cell: usize, nodal: &'a mut [f64]) -> &'a mut [f64] {
        &mut nodal[self.first_node(cell)..][..self.element.nodes()]
    }

    /// Interpolates `nodal` values at the point `place` (0 to 1) of a cell.
    pub(super) fn interpolate(&self, cell: usize, place: f64, nodal: &[f64]) -> f64 {
        dot(&self.element.shape(2.0 * place - 1.0), self.local(cell, nodal))
    }
}

/// Computes `sum_a weight_a nodal_a` over the nodes of an element, from left to right.
#[inline]
pub(super) fn dot(weight: &PerNode, nodal: &[f64]) -> f64 {
    let mut sum = weight[0] * nodal[0];
    for a in 1..nodal.len() {
        sum += weight[a] * nodal[a];
    }
    sum
}

named! {
    /// Kind of element: a Lagrange element with equally spaced nodes (Hughes, *The Finite Element
    /// Method*, 2000, sections 1.8 and 3.6).
    pub enum Element {
        /// Two nodes, linear displacement; displacement errors are of order 2.
        Linear = "linear",
        /// Three nodes, quadratic displacement; displacement errors inside the elements are of
        /// order 3.
        Quadratic = "quadratic",
    }
}

const MOST_NODES: usize = 3;

/// One number for each node of an element, from left to right; a linear element ignores the last
/// number.
pub(super) type PerNode = [f64; MOST_NODES];

#[derive(Debug, Clone, Copy)]
pub(super) struct GaussPoint {
    pub(super) xi: f64,
    pub(super) weight: f64,
}

const fn gauss(xi: f64, weight: f64) -> GaussPoint {
    GaussPoint { xi, weight }
}

/// Coordinate `1 / sqrt(3)` of the two-point Gauss rule.
const TWO: f64 = 0.577_350_269_189_625_8;
/// Coordinate `sqrt(3 / 5)` of the three-point Gauss rule.
const THREE: f64 = 0.774_596_669_241_483_4;

/// Two-point Gauss rule, exact to degree 3 (Hughes 2000, section 3.8).
const GAUSS_2: [GaussPoint; 2] = [gauss(-TWO, 1.0), gauss(TWO, 1.0)];
/// Three-point Gauss rule, exact to degree 5 (Hughes 2000, section 3.8).
const GAUSS_3: [GaussPoint; 3] =
    [gauss(-THREE, 5.0 / 9.0), gauss(0.0, 8.0 / 9.0), gauss(THREE, 5.0 / 9.0)];

impl Element {
    /// Returns the polynomial degree k. The displacement error is of order k + 1.
    #[inline]
    pub fn degree(self) -> usize {
        match self {
            Self::Linear => 1,
            Self::Quadratic => 2,
        }
    }

    #[inline]
    pub(super) fn nodes(self) -> usize {
        self.degree() + 1
    }

    pub(super) fn shape(self, xi: f64) -> PerNode {
        match self {
            Self::Linear => [0.5 * (1.0 - xi), 0.5 * (1.0 + xi), 0.0],
            Self::Quadratic => {
                [0.5 * xi * (xi - 1.0), (1.0 - xi) * (1.0 + xi), 0.5 * xi * (xi + 1.0)]
            }
        }
    }

    /// Returns the derivatives of the shape functions with respect to `xi`.
    pub(super) fn gradient(self, xi: f64) -> PerNode {
        match self {
            Self::Linear => [-0.5, 0.5, 0.0],
            Self::Quadratic => [xi - 0.5, -2.0 * xi, xi + 0.5],
        }
    }

    /// Returns the `k + 1` Gauss points, which integrate polynomials of degree `2k + 1` exactly,
    /// and therefore the mass matrix (degree `2k`) and the internal force of a linear law (of
    /// degree `2k - 2`). The error for a smooth integrand is of order `2k + 2`, above the order
    /// `k + 1` of the element (Ciarlet, *The Finite Element Method for Elliptic Problems*, 1978,
    /// section 4.1).
    pub(super) fn quadrature(self) -> &'static [GaussPoint] {
        match self {
            Self::Linear => &GAUSS_2,
            Self::Quadratic => &GAUSS_3,
        }
    }

    /// Returns `int N_a dxi / 2`, the fraction of the element length assigned to each node a. For
    /// the quadratic element these are the weights of Simpson's rule, so row sums of the mass
    /// matrix and lumping by nodal quadrature agree (Hughes 2000, section 7.3.2).
    pub(super) fn shares(self) -> PerNode {
        match self {
            Self::Linear => [0.5, 0.5, 0.0],
            Self::Quadratic => [1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0],
        }
    }
}
