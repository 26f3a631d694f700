//! What a transfer is to the rest of the solver.

use crate::mpm::algebra::Vector;

/// How a particle gives its velocity to nodes and takes it back.
pub trait Transfer: Sized + Sync + Send + 'static {
    /// The velocity that a particle with velocity `v` shows to the nodes it sees (P2G).
    fn shown<const D: usize>(v: &Vector<D>) -> Vector<D>;

    /// The particle's new velocity from its old one and the weighted sum of the nodes' velocity
    /// changes, `dv` = sum_i dt a_i N_i (G2P).
    fn taken<const D: usize>(v: &Vector<D>, dv: &Vector<D>) -> Vector<D>;
}
