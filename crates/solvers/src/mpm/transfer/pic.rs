//! PIC: the interpolated grid velocity replaces the particle velocity.
//!
//! `v_p = sum_i v_i N_i(x_p)` (Harlow 1964). In each step, the velocity is averaged by one transfer
//! to the grid and back, which damps variations within a cell.

use super::contract::Transfer;
use crate::mpm::kernel::contract::G2pRequest;

/// Particle in cell (PIC).
#[derive(Debug, Clone, Copy)]
pub struct Pic;

impl<const D: usize> Transfer<D> for Pic {
    fn g2p_request(&mut self, _: f64) -> G2pRequest<'_, D> {
        G2pRequest { mix: Some((0.0, 1.0)), ..G2pRequest::default() }
    }
}
