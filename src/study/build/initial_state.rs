//! The state in which bodies start.
//!
//! Where the truth is a motion and the material has a stress of the deformation alone, it is that
//! of the motion at t = 0: `x = X + u(X, 0)`, `F = I + grad u`, `v = u_t`. Otherwise it is what the
//! scene states, and where it states nothing the body is at rest and undeformed.

use crate::exact::formula::Formula;
use crate::exact::{Derivatives, Motion};
use crate::mpm::{Matrix, Particles, Vector};
use crate::suite::model::{ConvergencePlan, Scene};

/// An initial state.
pub(crate) struct Initial {
    /// The motion that is followed from t = 0 on.
    motion: Option<Motion>,
    displacement: Option<Motion>,
    velocity: Option<Motion>,
}

impl Initial {
    /// The initial state of a subject of `plan` that is one body.
    pub(crate) fn of(plan: &ConvergencePlan) -> Self {
        Self::of_body(plan, &plan.scene)
    }

    /// The initial state of one of the bodies of `plan`.
    pub(crate) fn of_body(plan: &ConvergencePlan, body: &Scene) -> Self {
        let exact = plan.exact.as_ref().filter(|problem| problem.follows_motion);
        Self { motion: exact.map(|problem| problem.motion.clone()), ..Self::stated(body) }
    }

    /// The stated initial state alone.
    pub(crate) fn stated(scene: &Scene) -> Self {
        let Scene { initial_displacement, initial_velocity, .. } = scene;
        let formulas = |all: &Vec<Formula>| (!all.is_empty()).then(|| Motion::new(all.clone()));
        Self {
            motion: None,
            displacement: formulas(initial_displacement),
            velocity: formulas(initial_velocity),
        }
    }

    /// u, the velocity and their gradients at `label`.
    pub(crate) fn at(&self, label: &[f64]) -> Derivatives {
        if let Some(motion) = &self.motion {
            return motion.derivatives(label, 0.0);
        }
        let still = |motion: &Motion| motion.derivatives(label, 0.0);
        let mut now = self.displacement.as_ref().map_or_else(Derivatives::default, still);
        if let Some(velocity) = &self.velocity {
            let moving = still(velocity);
            (now.velocity, now.grad_rate) = (moving.u, moving.grad);
        }
        now
    }

    /// Puts `particles` into this state.
    pub(crate) fn put<const D: usize>(&self, particles: &mut Particles<D>) {
        let states: Vec<Derivatives> =
            particles.x0.iter().map(|x0| self.at(x0.as_slice())).collect();
        for (v, now) in particles.v.iter_mut().zip(&states) {
            *v = Vector::from_fn(|i, _| now.velocity[i]);
        }
        for (grad_v, now) in particles.grad_v.iter_mut().zip(&states) {
            let f: Matrix<D> = Matrix::from_fn(|i, j| now.grad[i][j]) + Matrix::identity();
            let rate = Matrix::from_fn(|i, j| now.grad_rate[i][j]);
            // Where F has no inverse, the solver refuses the start.
            *grad_v = f.try_inverse().map_or_else(Matrix::zeros, |inverse| rate * inverse);
        }
        if self.motion.is_some() || self.displacement.is_some() {
            particles.deform(|p| {
                let Derivatives { u, grad, .. } = &states[p];
                let grad = Matrix::from_fn(|i, j| grad[i][j]);
                (Vector::from_fn(|i, _| u[i]), Matrix::identity() + grad)
            });
        }
    }
}
