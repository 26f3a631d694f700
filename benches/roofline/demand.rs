//! Lower bounds of the work of a pass per particle, counted from the formulas.

/// A pass over particles and nodes of products of K functions along each of D axes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Demand {
    /// Sums and products.
    pub(crate) flops: f64,
    /// Bytes of the particle that are read from or written to memory.
    pub(crate) bytes: f64,
    /// Nodes of four numbers that are read, added to and written back.
    pub(crate) updates: f64,
}

/// K polynomials of degree K - 1 by Horner's rule, and as many derivatives.
fn weights(d: f64, k: f64) -> f64 {
    // Where the particle is in its cell takes a difference, a product and a floor.
    d * (3.0 + k * 2.0 * (k - 1.0) + k * 2.0 * (k - 2.0).max(0.0))
}

/// Nodes, and rows of nodes along the first axis.
fn nodes(d: f64, k: f64) -> (f64, f64) {
    (libm::pow(k, d), libm::pow(k, d - 1.0))
}

/// P2G: mass, momentum of an affine field or of a velocity, and internal force.
pub(crate) fn p2g((d, k): (f64, f64), is_affine: bool) -> Demand {
    let (n, rows) = nodes(d, k);
    let field = if is_affine { 2.0 * d * d + d } else { 0.0 };
    // A lane of a node: a product and the sum with the node; an affine field has one more of each.
    // Of the force, the product along the row, and that across it where there is one.
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

/// G2P: velocity, its gradient and, of an affine field, its first moment; FLIP takes accelerations
/// too.
pub(crate) fn g2p((d, k): (f64, f64), is_affine: bool) -> Demand {
    let (n, rows) = nodes(d, k);
    // Sums along rows of two of value, slope and arm, with one product that both share; those
    // across from the sums of rows.
    let along = 3.0;
    let across = if d > 1.0 { along + 2.0 * (d - 1.0) } else { 0.0 };
    let columns = 3.0 * d + d * d + if is_affine { d * d } else { d };
    Demand {
        flops: weights(d, k) + 2.0 * d * (n * along + rows * across),
        bytes: 8.0 * columns,
        updates: 0.0,
    }
}
