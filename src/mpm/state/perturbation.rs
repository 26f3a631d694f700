//! The state of a solver, without its configuration, as a row of numbers.
//!
//! A step reads and changes velocities, stresses, volumes, F where it is kept, and what the transfer
//! carries. The grid keeps nothing from step to step. What only a material remembers (plastic flow) is
//! not among them, and positions and domains are the configuration.

use crate::{
    mpm::{algebra::Matrix, particles::Particles, solver::Solver},
    subject::Perturbable,
};

/// The columns of matrices of the particles, in their order in the state.
fn matrices<const D: usize>(particles: &Particles<D>) -> impl Iterator<Item = &Matrix<D>> {
    [&particles.sigma, &particles.def_grad].into_iter().flatten()
}

impl<const D: usize> Perturbable for Solver<D> {
    fn freeze(&mut self) {
        self.frozen = true;
    }

    fn state(&self, state: &mut Vec<f64>) {
        let particles = &self.setup.particles;
        state.clear();
        state.extend(particles.v.iter().flatten());
        state.extend(matrices(particles).flatten());
        state.extend(&particles.vol);
        state.extend(self.setup.transfer.carried().iter().flatten());
    }

    fn set_state(&mut self, state: &[f64]) {
        let Particles { v, sigma, def_grad, vol, .. } = &mut self.setup.particles;
        let carried = self.setup.transfer.carried_mut();
        let numbers = v
            .iter_mut()
            .flatten()
            .chain(sigma.iter_mut().flatten())
            .chain(def_grad.iter_mut().flatten())
            .chain(vol.iter_mut())
            .chain(carried.iter_mut().flatten());
        for (number, value) in numbers.zip(state) {
            *number = *value;
        }
    }

    fn sizes(&self, speed: f64, modulus: f64, sizes: &mut Vec<f64>) {
        let particles = &self.setup.particles;
        let carried = self.setup.transfer.carried_size(speed, self.setup.grid.h);
        sizes.clear();
        let mut same = |size: f64, count: usize| sizes.extend(std::iter::repeat_n(size, count));
        same(speed, D * particles.len());
        same(modulus, D * D * particles.sigma.len());
        same(1.0, D * D * particles.def_grad.len());
        for vol in &particles.vol0 {
            same(*vol, 1);
        }
        same(carried, D * D * self.setup.transfer.carried().len());
    }
}
