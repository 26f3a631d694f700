//! Lower bounds of the work of a pass per particle, counted from the formulas.

/// Work per particle of a pass, for basis functions that are products of K functions along each of
/// D axes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Demand {
    /// Number of additions and multiplications.
    pub(crate) flops: f64,
    /// Bytes of the particle that are read from or written to memory.
    pub(crate) bytes: f64,
    /// Number of updates (read, add, write) of nodes with four numbers.
    pub(crate) updates: f64,
}

/// Counts the operations for K polynomials of degree K - 1 and their derivatives, by Horner's rule.
fn weights(d: f64, k: f64) -> f64 {
    // The position in the cell takes a subtraction, a multiplication and a floor.
    d * (3.0 + k * 2.0 * (k - 1.0) + k * 2.0 * (k - 2.0).max(0.0))
}

/// Returns the number of nodes, and of rows of nodes along the first axis.
fn nodes(d: f64, k: f64) -> (f64, f64) {
    (libm::pow(k, d), libm::pow(k, d - 1.0))
}

/// Counts the work of P2G: mass, momentum of an affine field or of a velocity, and internal force.
pub(crate) fn p2g((d, k): (f64, f64), is_affine: bool) -> Demand {
    let (n, rows) = nodes(d, k);
    let field = if is_affine { 2.0 * d * d + d } else { 0.0 };
    // Each component of a node takes a multiplication and an addition, and an affine field one more
    // of each. The force takes both along the row, and in 2-D and 3-D also across the row.
    let lane = if is_affine { 4.0 } else { 2.0 };
    let force = if d > 1.0 { 4.0 } else { 2.0 };
    let per_row = if is_affine { 2.0 * d * (d - 1.0) } else { d } + 2.0 * d * (d - 1.0);
    Demand {
        flops: weights(d, k)
            + field
            + d * d
            + d
            + n * (d * lane + 2.0 + d * force)
            + rows * per_row,
        bytes: 8.0 * (2.0 * d + d * d + 2.0 + if is_affine { d * d } else { 0.0 }),
        updates: 2.0 * n,
    }
}

/// Counts the work of G2P: velocity and its gradient, and either the first moment of an affine
/// field or the acceleration for FLIP.
pub(crate) fn g2p((d, k): (f64, f64), is_affine: bool) -> Demand {
    let (n, rows) = nodes(d, k);
    // Along a row, two sums (of value, slope or arm) share one product. Sums across rows use the
    // sums along rows.
    let along = 3.0;
    let across = if d > 1.0 { along + 2.0 * (d - 1.0) } else { 0.0 };
    let columns = 3.0 * d + d * d + if is_affine { d * d } else { d };
    Demand {
        flops: weights(d, k) + 2.0 * d * (n * along + rows * across),
        bytes: 8.0 * columns,
        updates: 0.0,
    }
}
