//! The uniform mesh: where nodes and quadrature points are, and interpolation between nodes.

use super::element::{Element, PerNode};

/// A quadrature point, the same in every element.
#[derive(Debug, Clone, Copy)]
pub(super) struct MeshPoint {
    /// Place within the element, 0 at its left end and 1 at its right end.
    pub(super) place: f64,
    /// Shape functions.
    pub(super) shape: PerNode,
    /// Derivatives of the shape functions with respect to X (1/m).
    pub(super) gradient: PerNode,
    /// Length that the point stands for (m).
    pub(super) weight: f64,
}

/// Elements of one kind and one length.
#[derive(Debug, Clone)]
pub(super) struct Mesh {
    from: f64,
    to: f64,
    cells: usize,
    element: Element,
    points: Vec<MeshPoint>,
}

impl Mesh {
    /// `from < to` and `cells > 0` have been checked.
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

    /// Number of elements.
    pub(super) fn cells(&self) -> usize {
        self.cells
    }

    /// Kind of the elements.
    #[inline]
    pub(super) fn element(&self) -> Element {
        self.element
    }

    /// Length of an element (m).
    pub(super) fn cell_length(&self) -> f64 {
        (self.to - self.from) / self.cells as f64
    }

    /// Quadrature points of an element.
    #[inline]
    pub(super) fn points(&self) -> &[MeshPoint] {
        &self.points
    }

    /// Number of nodes.
    pub(super) fn node_count(&self) -> usize {
        self.cells * self.element.degree() + 1
    }

    /// Reference position of node `i`.
    pub(super) fn node(&self, i: usize) -> f64 {
        self.from + (self.to - self.from) * i as f64 / (self.node_count() - 1) as f64
    }

    /// Reference position of a place (0 to 1) in a cell.
    pub(super) fn position(&self, cell: usize, place: f64) -> f64 {
        self.from + (self.to - self.from) * (cell as f64 + place) / self.cells as f64
    }

    /// Index of the first node of a cell. The others follow it.
    #[inline]
    pub(super) fn first_node(&self, cell: usize) -> usize {
        cell * self.element.degree()
    }

    /// Nodal values of a cell.
    #[inline]
    pub(super) fn local<'a>(&self, cell: usize, nodal: &'a [f64]) -> &'a [f64] {
        &nodal[self.first_node(cell)..][..self.element.nodes()]
    }

    /// Nodal values of a cell, to be changed.
    #[inline]
    pub(super) fn local_mut<'a>(&self, cell: usize, nodal: &'a mut [f64]) -> &'a mut [f64] {
        &mut nodal[self.first_node(cell)..][..self.element.nodes()]
    }

    /// Cell that holds X, and the place in it. Beyond an end, that end is meant.
    pub(super) fn locate(&self, x: f64) -> (usize, f64) {
        let along = (x.clamp(self.from, self.to) - self.from) / self.cell_length();
        let cell = (along as usize).min(self.cells - 1); // the last node belongs to the last cell
        (cell, along - cell as f64)
    }

    /// Value at a place of a cell of the field that has these nodal values.
    pub(super) fn interpolate(&self, cell: usize, place: f64, nodal: &[f64]) -> f64 {
        dot(&self.element.shape(2.0 * place - 1.0), self.local(cell, nodal))
    }
}

/// `sum_a weight_a nodal_a` over the nodes of an element, from left to right.
#[inline]
pub(super) fn dot(weight: &PerNode, nodal: &[f64]) -> f64 {
    weight.iter().zip(nodal).map(|(weight, value)| weight * value).sum()
}
