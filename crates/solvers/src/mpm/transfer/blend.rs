//! A blend of FLIP and PIC.
//!
//! `v_p <- s (v_p + dt sum_i a_i N_i) + (1 - s) sum_i v_i N_i` (Zhu & Bridson 2005; Stomakhin et
//! al. 2013, with s = 0.95).

use super::contract::Transfer;
use crate::mpm::kernel::contract::G2pRequest;

/// A weighted mean of FLIP and PIC.
#[derive(Debug, Clone, Copy)]
pub struct Blend {
    flip: f64,
}

impl Blend {
    /// Creates a blend with the fraction `flip` of FLIP, from 0 to 1.
    pub fn new(flip: f64) -> Self {
        Self { flip }
    }
}

impl<const D: usize> Transfer<D> for Blend {
    fn g2p_request(&mut self, dt: f64) -> G2pRequest<'_, D> {
        let mix = Some((self.flip, 1.0 - self.flip));
        G2pRequest { change: Some(dt), mix, ..G2pRequest::default() }
    }
}
