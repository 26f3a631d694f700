//! Textbook loops of P2G and G2P: particle by particle and node by node, directly from the
//! equations.
//!
//! ```text
//! m_i     =  sum_p m_p N_i(x_p)                                    (Sulsky, Chen & Schreyer 1994)
//! (m v)_i =  sum_p m_p (v_p + C_p (x_i - x_p - mean_p)) N_i(x_p)   (APIC: Jiang et al. 2015)
//! f_i     = -sum_p V_p sigma_p grad N_i(x_p)                       (Sulsky, Chen & Schreyer 1994)
//! f_i     = -sum_p V_p sigma_p D_p^-1 (x_i - x_p - mean_p) N_i(x_p)       (MLS: Hu et al. 2018)
//! v_p     =  sum_i v_i N_i(x_p)
//! B_p     =  sum_i v_i (x) (x_i - x_p - mean_p) N_i(x_p)           (APIC: Jiang et al. 2015)
//! L_p     =  sum_i v_i (x) grad N_i(x_p)
//! ```
//!
//! with `mean_p = sum_i (x_i - x_p) N_i(x_p)`, zero except for domains that a wall cuts off. Tests
//! compare the fast loops with these sums. The slow loops document the fast ones and have no other
//! use.

use super::alone;
use mpm_solvers::mpm::{Grid, Kernel, Matrix, Particles, Vector, dyad};

/// Results of P2G, one entry for each node.
pub(super) struct NodeSums<const D: usize> {
    /// m_i (kg).
    pub(super) mass: Vec<f64>,
    /// Momentum (kg m/s).
    pub(super) momentum: Vec<Vector<D>>,
    /// Internal force (N).
    pub(super) force: Vec<Vector<D>>,
}

/// Results of G2P, one entry for each particle.
pub(super) struct ParticleSums<const D: usize> {
    /// v_p (m/s).
    pub(super) velocity: Vec<Vector<D>>,
    /// B_p (m^2/s).
    pub(super) moment: Vec<Matrix<D>>,
    /// L_p (1/s).
    pub(super) gradient: Vec<Matrix<D>>,
}

/// Weight, offset and gradient of one node at a particle.
struct NodeWeight<const D: usize> {
    node: usize,
    /// N_i(x_p).
    weight: f64,
    /// (x_i - x_p) N_i(x_p) (m).
    offset: Vector<D>,
    /// grad N_i(x_p) (1/m).
    gradient: Vector<D>,
}

/// Returns the nodes of particle `p`. They are computed from passes that are textbook loops in the
/// kernel too: a unit force at the particle gives N_i, a unit moment grad N_i, and the position as
/// a scalar `(x_i - x_p) N_i`.
fn node_weights<const D: usize>(
    kernel: &dyn Kernel<D>,
    (grid, particles): (&Grid<D>, &Particles<D>),
    p: usize,
) -> Vec<NodeWeight<D>> {
    let one = Particles { mass: vec![1.0], ..alone(particles, p) };
    let mut empty = grid.clone();
    empty.force.fill(Vector::zeros());
    let (mut weight, mut gradient) = (empty.clone(), empty);
    kernel.p2g_point_force(&one, 0, &Vector::from_element(1.0), &mut weight);
    kernel.p2g_point_moment(&one, 0, &Matrix::identity(), &mut gradient);
    let offset: [Vec<f64>; D] = std::array::from_fn(|axis| {
        let slope = Vector::from_fn(|i, _| if i == axis { 1.0 } else { 0.0 });
        let mut column = vec![0.0; grid.nodes()];
        kernel.p2g_scalar(&one, &[0.0], &[slope], grid, &mut column);
        column
    });
    let node = |node: usize| NodeWeight {
        node,
        weight: weight.force[node][0],
        offset: Vector::from_fn(|axis, _| offset[axis][node]),
        gradient: gradient.force[node],
    };
    (0..grid.nodes()).map(node).filter(|i| i.weight != 0.0 || i.gradient.norm() != 0.0).collect()
}

/// Returns `sum_i (x_i - x_p) N_i(x_p)` (m).
fn mean<const D: usize>(nodes: &[NodeWeight<D>]) -> Vector<D> {
    nodes.iter().map(|i| i.offset).sum()
}

/// Computes mass, momentum of the field `v_p + C_p (x - x_p - mean_p)`, and internal force.
pub(super) fn p2g<const D: usize>(
    kernel: &dyn Kernel<D>,
    particles: &Particles<D>,
    c: &[Matrix<D>],
    grid: &Grid<D>,
) -> NodeSums<D> {
    let zero = vec![Vector::zeros(); grid.nodes()];
    let (mut mass, mut momentum, mut force) = (vec![0.0; grid.nodes()], zero.clone(), zero);
    for p in 0..particles.len() {
        let (m, flux) = (particles.mass[p], particles.flux(p));
        let nodes = node_weights(kernel, (grid, particles), p);
        let mean = mean(&nodes);
        for i in nodes {
            mass[i.node] += m * i.weight;
            let affine = c[p] * (i.offset - mean * i.weight);
            momentum[i.node] += (particles.v[p] * i.weight + affine) * m;
            force[i.node] -= flux * i.gradient;
        }
    }
    NodeSums { mass, momentum, force }
}

/// Computes the internal force by a fit, for particles whose `V_p sigma_p D_p^-1` is `c`.
pub(super) fn force_by_fit<const D: usize>(
    kernel: &dyn Kernel<D>,
    particles: &Particles<D>,
    c: &[Matrix<D>],
    grid: &Grid<D>,
) -> Vec<Vector<D>> {
    let mut force = vec![Vector::zeros(); grid.nodes()];
    for (p, c) in c.iter().enumerate() {
        let nodes = node_weights(kernel, (grid, particles), p);
        let mean = mean(&nodes);
        for i in nodes {
            force[i.node] -= c * (i.offset - mean * i.weight);
        }
    }
    force
}

/// Computes velocity, first moment and gradient from the nodal velocities `v`.
pub(super) fn g2p<const D: usize>(
    kernel: &dyn Kernel<D>,
    grid: &Grid<D>,
    v: &[Vector<D>],
    particles: &Particles<D>,
) -> ParticleSums<D> {
    let zero = vec![Matrix::zeros(); particles.len()];
    let velocity = vec![Vector::zeros(); particles.len()];
    let mut sums = ParticleSums { velocity, moment: zero.clone(), gradient: zero };
    for p in 0..particles.len() {
        let nodes = node_weights(kernel, (grid, particles), p);
        let mean = mean(&nodes);
        for i in nodes {
            let v = &v[i.node];
            sums.velocity[p] += v * i.weight;
            sums.moment[p] += dyad(v, &(i.offset - mean * i.weight));
            sums.gradient[p] += dyad(v, &i.gradient);
        }
    }
    sums
}
