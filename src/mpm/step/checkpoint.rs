//! State of a solver between two steps.
//!
//! Every field is named, so that the compiler asks after a new one. The grid and the advected
//! positions are computed anew in each step.

use super::perturbation::affine_state_mut;
use super::setup::Setup;
use super::solver::Solver;
use crate::mpm::boundary::Advance;
use crate::mpm::foundation::algebra::Vector;
use crate::mpm::foundation::particles::Particles;
use crate::subject::{Checkpoint, Memory};
use nalgebra::SMatrix;

/// Vectors and matrices, column after column.
impl<const R: usize, const C: usize> Memory for SMatrix<f64, R, C> {
    fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        f64::visit_each(self.as_mut_slice(), checkpoint);
    }
}

/// Columns that are there from the start, but for those that never change.
impl<const D: usize> Memory for Particles<D> {
    fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        let Self {
            x0: _,
            x,
            current_position,
            v,
            mass: _,
            vol0: _,
            vol,
            sigma,
            def_grad,
            across,
            rate_across,
            stress_across,
            domain,
            domain0: _,
            grad_v,
            temperature,
            spacing: _,
        } = self;
        for column in [x, current_position, v] {
            checkpoint.visit::<[Vector<D>]>(column);
        }
        for column in [vol, across, rate_across, stress_across, temperature] {
            checkpoint.visit::<[f64]>(column);
        }
        for column in [sigma, def_grad, domain, grad_v] {
            checkpoint.visit(&mut column[..]);
        }
    }
}

impl Memory for Advance {
    fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        let Self { from, to, dt } = self;
        for time in [from, to, dt] {
            checkpoint.visit(time);
        }
    }
}

impl<const D: usize> Memory for Setup<D> {
    fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        let Self {
            grid: _,
            particles,
            kernel: _,
            transfer,
            // Assembled in each step.
            mass: _,
            frame: _,
            material,
            effects,
            boundary,
            scheme: _,
            start: _,
        } = self;
        checkpoint.visit(particles);
        checkpoint.visit(affine_state_mut(transfer.as_mut()));
        material.checkpoint(checkpoint);
        for effect in effects {
            effect.checkpoint(checkpoint);
        }
        for condition in boundary {
            condition.checkpoint(checkpoint);
        }
    }
}

impl<const D: usize> Memory for Solver<D> {
    fn visit(&mut self, checkpoint: &mut Checkpoint<'_>) {
        let Self {
            setup,
            schedule: _,
            time,
            velocity_time,
            advance,
            started,
            transfers,
            min_j,
            cell_tracker,
            advected: _,
        } = self;
        checkpoint.visit(setup);
        for number in [time, velocity_time, min_j] {
            checkpoint.visit(number);
        }
        checkpoint.visit(advance);
        checkpoint.visit(started);
        checkpoint.visit(transfers);
        checkpoint.visit(cell_tracker);
    }
}
