//! What an effect is to the rest of the solver.

use super::name::EffectName;
use crate::{
    mpm::{grid::Grid, kernel::contract::Kernel, material::Material, particles::Particles},
    subject::{Checkpoint, Column, Failure},
};

/// A pass between stages. Hooks are empty unless an effect fills them.
pub trait Effect<const D: usize>: Send {
    /// Its name, as suites write it.
    fn name(&self) -> EffectName;

    /// What it keeps for particles or nodes.
    fn columns(&self) -> Vec<Column> {
        Vec::new()
    }

    /// Shows what it remembers from step to step.
    fn checkpoint(&mut self, _: &mut Checkpoint<'_>) {}

    /// Whether it reads F: the column exists only then, or if a basis or a material asks for it.
    fn reads_deformation(&self) -> bool {
        false
    }

    /// Adds external forces at time `t` (s) to `grid.force`; the masses of the grid are up to date.
    /// Returns the particle-node pairs visited.
    fn add_force(
        &mut self,
        _t: f64,
        _particles: &Particles<D>,
        _kernel: &dyn Kernel<D>,
        _grid: &mut Grid<D>,
    ) -> u64 {
        0
    }

    /// Whether [`Effect::modify_force`] reads the velocities of the grid: schemes map them before the
    /// forces only if somebody does.
    fn reads_grid_velocity(&self) -> bool {
        false
    }

    /// Changes `grid.force`, the sum of all forces, in the light of `grid.velocity`, that which
    /// particles bring to the step. Called once all effects have added their forces.
    fn modify_force(&self, _grid: &mut Grid<D>) {}

    /// Gives particles a velocity that is not the grid's; `t` (s) is the time that velocities stand
    /// for, and `dt` (s) what they have advanced by. Called whenever velocities have been taken from
    /// the grid, and at the start of a run with `dt` = 0.
    fn modify_velocity(&self, _t: f64, _dt: f64, _particles: &mut Particles<D>) {}

    /// Moves particles otherwise than the grid did, over `dt` (s). Called after the grid has moved
    /// all of them.
    fn modify_position(&mut self, _dt: f64, _particles: &mut Particles<D>) {}

    /// Completes the initial state of the particles, once their columns are there.
    fn start(&mut self, _material: &mut dyn Material<D>, _particles: &mut Particles<D>) {}

    /// Called before the material makes stresses of strains.
    fn before_stress(&mut self, _particles: &mut Particles<D>) {}

    /// Called after it.
    fn after_stress(&mut self, _particles: &mut Particles<D>) {}

    /// Takes what the effect itself keeps of the particles from `t` to `t + dt` (s). Called once a
    /// step, with the particles at their places at `t` and the masses of the grid up to date. Returns
    /// the particle-node pairs visited.
    ///
    /// # Errors
    /// What became of the first particle that cannot go on.
    fn integrate_state(
        &mut self,
        _t_and_dt: (f64, f64),
        _particles: &mut Particles<D>,
        _kernel: &dyn Kernel<D>,
        _grid: &Grid<D>,
    ) -> Result<u64, Failure> {
        Ok(0)
    }
}
