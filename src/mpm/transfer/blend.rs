//! A blend of FLIP and PIC.
//!
//! `v_p <- s (v_p + dt sum_i a_i N_i) + (1 - s) sum_i v_i N_i` (Zhu & Bridson 2005; Stomakhin et
//! al. 2013, with s = 0.95).

use super::{
    contract::{Transfer, add_acceleration, mix_velocity},
    wanted::Recipe,
};
use crate::mpm::{boundary::Boundary, grid::Grid, kernel::contract::Kernel, particles::Particles};

/// FLIP with a small part of PIC.
#[derive(Debug, Clone, Copy)]
pub struct Blend {
    flip: f64,
}

impl Blend {
    /// A blend with the share `flip` of FLIP, from 0 to 1.
    pub fn new(flip: f64) -> Self {
        Self { flip }
    }
}

impl<const D: usize> Transfer<D> for Blend {
    fn reads_grid_velocity(&self) -> bool {
        true
    }

    fn recipe(&self) -> Option<Recipe> {
        Some(Recipe { change: true, mix: Some((self.flip, 1.0 - self.flip)) })
    }

    fn g2p_velocity(
        &mut self,
        kernel: &dyn Kernel<D>,
        grid: &Grid<D>,
        _: &[Box<dyn Boundary<D>>],
        dt: f64,
        particles: &mut Particles<D>,
    ) -> u64 {
        add_acceleration(kernel, grid, dt, particles);
        mix_velocity(kernel, grid, (self.flip, 1.0 - self.flip), particles);
        2
    }
}
