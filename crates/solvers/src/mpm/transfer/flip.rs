//! FLIP: only the change of the grid velocity is added to the particle velocity.
//!
//! `v_p += dt sum_i a_i N_i(x_p)` (Brackbill & Ruppel 1986; step 3 of the original MPM in Wobbes &
//! Tielen 2015).

use super::contract::Transfer;
use crate::mpm::kernel::contract::G2pRequest;

/// The transfer of the original MPM.
#[derive(Debug, Clone, Copy)]
pub struct Flip;

impl<const D: usize> Transfer<D> for Flip {
    fn g2p_request(&mut self, dt: f64) -> G2pRequest<'_, D> {
        G2pRequest { change: Some(dt), ..G2pRequest::default() }
    }
}
