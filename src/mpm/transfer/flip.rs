//! FLIP: the particle keeps its velocity and takes only the change from the grid.
//!
//! `v_p += dt sum_i a_i N_i(x_p)` (Brackbill & Ruppel 1986; step 3 of the original MPM in Wobbes &
//! Tielen 2015).

use super::{
    contract::{Transfer, add_acceleration},
    wanted::Recipe,
};
use crate::mpm::{boundary::Boundary, grid::Grid, kernel::contract::Kernel, particles::Particles};

/// The transfer of the original MPM.
#[derive(Debug, Clone, Copy)]
pub struct Flip;

impl<const D: usize> Transfer<D> for Flip {
    fn reads_grid_velocity(&self) -> bool {
        false
    }

    fn recipe(&self) -> Option<Recipe> {
        Some(Recipe { change: true, mix: None })
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
        1
    }
}
