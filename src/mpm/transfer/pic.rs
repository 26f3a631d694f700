//! PIC: the particle takes the velocity of the grid, and forgets its own.
//!
//! `v_p = sum_i v_i N_i(x_p)` (Harlow 1964). Every step filters the velocity once through the
//! grid, which damps all that varies within a cell.

use super::{
    contract::{Transfer, mix_velocity},
    wanted::Recipe,
};
use crate::mpm::{boundary::Boundary, grid::Grid, kernel::contract::Kernel, particles::Particles};

/// Particle in cell.
#[derive(Debug, Clone, Copy)]
pub struct Pic;

impl<const D: usize> Transfer<D> for Pic {
    fn reads_grid_velocity(&self) -> bool {
        true
    }

    fn recipe(&self) -> Option<Recipe> {
        Some(Recipe { change: false, mix: Some((0.0, 1.0)) })
    }

    fn g2p_velocity(
        &mut self,
        kernel: &dyn Kernel<D>,
        grid: &Grid<D>,
        _: &[Box<dyn Boundary<D>>],
        _: f64,
        particles: &mut Particles<D>,
    ) -> u64 {
        mix_velocity(kernel, grid, (0.0, 1.0), particles);
        1
    }
}
