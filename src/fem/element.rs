//! Shape functions on the parent interval `-1 <= xi <= 1`, and Gauss points that are good enough.

use crate::named::named;

named! {
    /// Which polynomials an element carries. Both are Lagrange elements with equally spaced nodes
    /// (Hughes, *The Finite Element Method*, 2000, sections 1.8 and 3.6).
    pub enum Element {
        /// Two nodes, `u` linear: order 2 in the displacement.
        Linear = "linear",
        /// Three nodes, `u` quadratic: order 3 in the displacement, inside the elements.
        Quadratic = "quadratic",
    }
}

/// Largest number of nodes of an element.
const MOST_NODES: usize = 3;

/// One number for each node of an element, from left to right; a linear element ignores the last.
pub(super) type PerNode = [f64; MOST_NODES];

/// A Gauss point of the parent interval.
#[derive(Debug, Clone, Copy)]
pub(super) struct GaussPoint {
    pub(super) xi: f64,
    pub(super) weight: f64,
}

const fn gauss(xi: f64, weight: f64) -> GaussPoint {
    GaussPoint { xi, weight }
}

/// `1 / sqrt(3)`.
const TWO: f64 = 0.577_350_269_189_625_8;
/// `sqrt(3 / 5)`.
const THREE: f64 = 0.774_596_669_241_483_4;

/// Exact to degree 3 (Hughes 2000, section 3.8).
const GAUSS_2: [GaussPoint; 2] = [gauss(-TWO, 1.0), gauss(TWO, 1.0)];
/// Exact to degree 5 (Hughes 2000, section 3.8).
const GAUSS_3: [GaussPoint; 3] =
    [gauss(-THREE, 5.0 / 9.0), gauss(0.0, 8.0 / 9.0), gauss(THREE, 5.0 / 9.0)];

impl Element {
    /// Polynomial degree k; the displacement is of order k + 1.
    #[inline]
    pub fn degree(self) -> usize {
        match self {
            Self::Linear => 1,
            Self::Quadratic => 2,
        }
    }

    /// Number of nodes of one element.
    #[inline]
    pub(super) fn nodes(self) -> usize {
        self.degree() + 1
    }

    /// Values of the shape functions.
    pub(super) fn shape(self, xi: f64) -> PerNode {
        match self {
            Self::Linear => [0.5 * (1.0 - xi), 0.5 * (1.0 + xi), 0.0],
            Self::Quadratic => {
                [0.5 * xi * (xi - 1.0), (1.0 - xi) * (1.0 + xi), 0.5 * xi * (xi + 1.0)]
            }
        }
    }

    /// Derivatives of the shape functions with respect to `xi`.
    pub(super) fn gradient(self, xi: f64) -> PerNode {
        match self {
            Self::Linear => [-0.5, 0.5, 0.0],
            Self::Quadratic => [xi - 0.5, -2.0 * xi, xi + 0.5],
        }
    }

    /// The `k + 1` Gauss points. They are exact to degree `2k + 1`, thus for the mass matrix
    /// (degree 2k) and for the internal force of a linear law (degree 2k - 2); an integrand that
    /// is only smooth is integrated to order `2k + 2`, above the order `k + 1` of the element
    /// (Ciarlet, *The Finite Element Method for Elliptic Problems*, 1978, section 4.1, asks for
    /// degree 2k - 2).
    pub(super) fn quadrature(self) -> &'static [GaussPoint] {
        match self {
            Self::Linear => &GAUSS_2,
            Self::Quadratic => &GAUSS_3,
        }
    }

    /// `int N_a dxi / 2`: the share of an element that belongs to each of its nodes. For the
    /// quadratic element these are at once the weights of the three-point Gauss-Lobatto rule
    /// (Simpson's), so the sum of a row of the mass matrix and lumping by nodal quadrature are the
    /// same (Hughes 2000, section 7.3.2).
    pub(super) fn shares(self) -> PerNode {
        match self {
            Self::Linear => [0.5, 0.5, 0.0],
            Self::Quadratic => [1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0],
        }
    }
}
