//! Interface between an effect and the rest of the solver, and the stress update with its hooks.

use crate::mpm::foundation::algebra::Vector;
use crate::mpm::foundation::grid::Grid;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::kernel::contract::Kernel;
use crate::mpm::material::{Material, StressUpdate};
use mpm_subject::{Column, Failure};
use std::any::Any;

/// A body and the grid that receives its external forces.
pub struct BodyOnGrid<'a, const D: usize> {
    /// The particles.
    pub particles: &'a Particles<D>,
    /// Passes over the particles.
    pub kernel: &'a dyn Kernel<D>,
    /// The grid, whose masses are up to date.
    pub grid: &'a mut Grid<D>,
}

impl<const D: usize> BodyOnGrid<'_, D> {
    /// Adds a `force` (N) on particle `p` to the nodes of the particle.
    pub fn add_point_force(&mut self, p: usize, force: &Vector<D>) {
        self.kernel.p2g_point_force(self.particles, p, force, self.grid);
    }

    /// Returns the number of particle-node pairs in `visits` visits of a particle.
    pub fn pairs(&self, visits: usize) -> u64 {
        visits as u64 * self.kernel.support()
    }
}

/// An addition to the equations of motion, with hooks between the passes of a step.
pub trait Effect<const D: usize>: Send {
    /// Returns the name of the effect in suite files.
    fn name(&self) -> &'static str;

    /// Returns the columns that the effect stores per particle or node.
    fn columns(&self) -> Vec<Column<'_>> {
        Vec::new()
    }

    /// Returns a copy of the state that a stress update changes; `None` if the effect has no such
    /// state.
    fn state(&self) -> Option<Box<dyn Any>> {
        None
    }

    /// Replaces the state by `state`, which [`state`](Self::state) returned.
    fn set_state(&mut self, _: &dyn Any) {}

    /// Whether the effect reads F. The column of F exists only if an effect, a basis or a material
    /// reads F.
    fn reads_deformation(&self) -> bool {
        false
    }

    /// Whether the effect contributes to the stresses, and therefore affects the stable time step.
    fn makes_stress(&self) -> bool {
        false
    }

    /// Returns the stiffness per unit mass (1/s2) at the start, for loads that depend on the
    /// displacement. A stiffness reduces the stable time step.
    fn stiffness(&self) -> f64 {
        0.0
    }

    /// Requests that forces at a surface are integrated over the ends of the particle domains, as
    /// the balance of a load step requires. Explicit solvers do not call this method.
    fn integrate_over_domain_ends(&mut self) {}

    /// Adds external forces at time `t` (s) to the grid of `body`. Returns the number of visited
    /// particle-node pairs.
    fn add_force(&mut self, _t: f64, _body: &mut BodyOnGrid<'_, D>) -> u64 {
        0
    }

    /// Whether [`Effect::modify_force`] reads the grid velocities. Schemes map velocities before
    /// forces only in this case.
    fn reads_grid_velocity(&self) -> bool {
        false
    }

    /// Modifies `grid.force`, the sum of all forces. May read `grid.velocity`, the mapped
    /// velocities before their advance. This function is called after all effects have added their
    /// forces.
    fn modify_force(&self, _grid: &mut Grid<D>) {}

    /// Modifies the particle velocities at time `t` (s), after an advance by `dt` (s). This
    /// function is called after G2P of velocities, and at the start of a run with `dt` = 0.
    fn modify_velocity(&self, _t: f64, _dt: f64, _particles: &mut Particles<D>) {}

    /// Modifies the particle positions after the grid has moved the particles over `dt` (s).
    fn modify_position(&mut self, _dt: f64, _particles: &mut Particles<D>) {}

    /// Completes the initial state of the particles, after their columns have been created.
    fn start(&mut self, _material: &mut dyn Material<D>, _particles: &mut Particles<D>) {}

    /// Runs before the strain update. The velocities of the grid are those that strain the
    /// particles over the time step (s). Returns the number of visited particle-node pairs.
    fn map_velocity(
        &mut self,
        _dt: f64,
        _kernel: &dyn Kernel<D>,
        _grid: &Grid<D>,
        _particles: &mut Particles<D>,
    ) -> u64 {
        0
    }

    /// Runs before the stress update, if [`Effect::makes_stress`].
    fn before_stress(&mut self, _particles: &mut Particles<D>) {}

    /// Runs after the stress update, if [`Effect::makes_stress`].
    fn after_stress(&mut self, _particles: &mut Particles<D>) {}

    /// Returns the names of the passes of [`Effect::integrate_state`] in order, for reports.
    fn state_passes(&self) -> &'static [&'static str] {
        &[]
    }

    /// Integrates the effect's own state from `t` to `t + dt` (s). This function is called once per
    /// step, with particle positions at `t` and up-to-date grid masses. Returns the number of
    /// visited particle-node pairs.
    ///
    /// # Errors
    /// The failure of the first particle whose state cannot be integrated.
    fn integrate_state(
        &mut self,
        _t: f64,
        _dt: f64,
        _particles: &mut Particles<D>,
        _kernel: &dyn Kernel<D>,
        _grid: &Grid<D>,
    ) -> Result<u64, Failure> {
        Ok(0)
    }
}

/// Updates the stresses with the hooks of the effects; returns [`StressUpdate::least_j`].
pub(in crate::mpm) fn strain<const D: usize>(
    effects: &mut [Box<dyn Effect<D>>],
    material: &mut dyn Material<D>,
    mut body: StressUpdate<'_, D>,
) -> Option<f64> {
    for effect in effects.iter_mut().filter(|effect| effect.makes_stress()) {
        effect.before_stress(body.particles());
    }
    material.update(&mut body);
    // After the update, the effects run in reverse order. Thermal expansion, for example, restores
    // the volume before artificial viscosity computes the density.
    for effect in effects.iter_mut().rev().filter(|effect| effect.makes_stress()) {
        effect.after_stress(body.particles());
    }
    body.least_j()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mpm::{ArtificialViscosity, Block, Hencky, Matrix, ThermalExpansion};
    use approx::assert_relative_eq;

    /// A hot bar in compression has Hencky's stress for the elastic stretch 1.5/1.2 and E = 50,
    /// minus `q = rho (l D)^2` with l D = 0.3 and the density at the total stretch, 3/1.5.
    #[test]
    fn a_viscosity_has_the_density_of_the_expanded_body() {
        let block = Block { from: Vector::zeros(), to: Vector::<1>::new(1.0), density: 3.0 };
        let mut bar = Particles::fill(&block, 1.0, 1);
        bar.track_deformation();
        bar.temperature = vec![30.0];
        bar.def_grad[0] = Matrix::<1>::new(1.5);
        let (linear, quadratic, length, speed) = (0.0, 1.0, 0.1, 1.0);
        let viscosity = ArtificialViscosity { linear, quadratic, length, speed, q: Vec::new() };
        let mut expansion = ThermalExpansion::of_deformation(0.02, 20.0);
        let mut law = Hencky::new(50.0, 0.0);
        expansion.start(&mut law, &mut bar);
        bar.grad_v[0] = Matrix::<1>::new(-3.0);
        let mut effects: Vec<Box<dyn Effect<1>>> = vec![Box::new(viscosity), Box::new(expansion)];
        strain(&mut effects, &mut law, StressUpdate::new(0.0, &mut bar));
        let expected = 50.0 * libm::log(1.25) / 1.25 - 2.0 * 0.09;
        assert_relative_eq!(bar.sigma[0][(0, 0)], expected, max_relative = 1e-14);
        assert_relative_eq!(bar.vol[0], 1.5, max_relative = 1e-14);
    }
}
