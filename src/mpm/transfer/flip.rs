//! FLIP: the particle keeps its velocity and takes only the change from the grid.
//!
//! `v_p += dt sum_i a_i N_i(x_p)` (Brackbill & Ruppel 1986; step 3 of the original MPM in Wobbes &
//! Tielen 2015).

use super::contract::Transfer;
use crate::mpm::algebra::Vector;

/// The transfer of the original MPM.
#[derive(Debug, Clone, Copy)]
pub struct Flip;

impl Transfer for Flip {
    #[inline]
    fn shown<const D: usize>(v: &Vector<D>) -> Vector<D> {
        *v
    }

    #[inline]
    fn taken<const D: usize>(v: &Vector<D>, dv: &Vector<D>) -> Vector<D> {
        v + dv
    }
}
