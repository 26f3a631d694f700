//! State of a solver, without its configuration, as a row of numbers.
//!
//! A step reads and changes velocities, stresses, volumes, F where it is a column, and the affine
//! state of the transfer. The grid keeps nothing from step to step. State of a material alone
//! (plastic flow) is left out, and positions and domains are the configuration.

use super::schedule::{Coupled, StepSchedule};
use super::solver::Solver;
use crate::mpm::foundation::algebra::Matrix;
use crate::mpm::foundation::particles::Particles;
use crate::mpm::kernel::request::{Affine, G2pRequest};
use crate::mpm::transfer::Transfer;
use crate::subject::Perturbable;

/// The columns of matrices of the particles, in their order in the state.
fn matrices<const D: usize>(particles: &Particles<D>) -> impl Iterator<Item = &Matrix<D>> {
    [&particles.sigma, &particles.def_grad].into_iter().flatten()
}

/// Affine velocity field of the particles, if the transfer has one.
fn affine<const D: usize>(solver: &Solver<D>) -> Option<Affine<'_, D>> {
    solver.setup.transfer.p2g_request(&solver.setup.particles).momentum?.affine
}

/// State of the affine velocity field; empty if the transfer has none.
pub(super) fn affine_state_mut<const D: usize>(transfer: &mut dyn Transfer<D>) -> &mut [Matrix<D>] {
    let G2pRequest { moment, gradient, .. } = transfer.g2p_request(0.0);
    moment.or(gradient).unwrap_or_default()
}

impl<const D: usize> Perturbable for Solver<D> {
    fn fix_configuration(&mut self) {
        self.schedule = StepSchedule::new(&mut self.setup, Coupled::default(), true);
    }

    fn state(&self, state: &mut Vec<f64>) {
        let particles = &self.setup.particles;
        state.clear();
        state.extend(particles.v.iter().flatten());
        state.extend(matrices(particles).flatten());
        state.extend(&particles.vol);
        state.extend(particles.across.iter().chain(&particles.stress_across));
        state.extend(affine(self).into_iter().flat_map(Affine::state).flatten());
    }

    fn set_state(&mut self, state: &[f64]) {
        let Particles { v, sigma, def_grad, vol, across, stress_across, .. } =
            &mut self.setup.particles;
        let affine_state = affine_state_mut(self.setup.transfer.as_mut());
        let numbers = v
            .iter_mut()
            .flatten()
            .chain(sigma.iter_mut().flatten())
            .chain(def_grad.iter_mut().flatten())
            .chain(vol.iter_mut())
            .chain(across.iter_mut())
            .chain(stress_across.iter_mut())
            .chain(affine_state.iter_mut().flatten());
        for (number, value) in numbers.zip(state) {
            *number = *value;
        }
    }

    fn sizes(&self, speed: f64, modulus: f64, sizes: &mut Vec<f64>) {
        let particles = &self.setup.particles;
        sizes.clear();
        let mut same = |size: f64, count: usize| sizes.extend(std::iter::repeat_n(size, count));
        same(speed, D * particles.len());
        same(modulus, D * D * particles.sigma.len());
        same(1.0, D * D * particles.def_grad.len());
        for vol in &particles.vol0 {
            same(*vol, 1);
        }
        same(1.0, particles.across.len());
        same(modulus, particles.stress_across.len());
        if let Some(affine) = affine(self) {
            same(affine.size(speed, self.setup.grid.h), D * D * affine.state().len());
        }
    }
}
