//! Initial states of bodies.
//!
//! If the exact solution is a motion and the stress depends on the deformation only, the initial
//! state is the exact motion at t = 0: `x = X + u(X, 0)`, `F = I + grad u`, `v = u_t`. Otherwise
//! the scene describes the initial state; by default it is at rest and undeformed. The initial
//! stress always comes from the scene.

use crate::exact::formula::Formula;
use crate::exact::{Derivatives, InitialStress, Motion};
use crate::mpm::{Material, Matrix, Particles, Prestressed, Vector, inverse};
use crate::subject::Failure;
use crate::suite::model::{ConvergencePlan, Scene};

pub(crate) struct Initial {
    /// Exact motion from which the initial state is computed, if any.
    motion: Option<Motion>,
    displacement: Option<Motion>,
    velocity: Option<Motion>,
    stress: InitialStress,
}

impl Initial {
    /// Creates the initial state of one of the bodies of `plan`.
    pub(crate) fn of_body(plan: &ConvergencePlan, body: &Scene) -> Self {
        let exact = plan.exact.as_ref().filter(|problem| problem.follows_motion);
        Self { motion: exact.map(|problem| problem.motion.clone()), ..Self::stated(body) }
    }

    /// Creates the initial state that the scene describes.
    pub(crate) fn stated(scene: &Scene) -> Self {
        let Scene { initial_stress, initial_displacement, initial_velocity, .. } = scene;
        let formulas = |all: &Vec<Formula>| (!all.is_empty()).then(|| Motion::new(all.clone()));
        Self {
            motion: None,
            displacement: formulas(initial_displacement),
            velocity: formulas(initial_velocity),
            stress: initial_stress.clone(),
        }
    }

    /// Returns displacement, velocity and their gradients at `label`.
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

    /// Adds the initial stress of `particles`, if any, to `law`.
    ///
    /// # Errors
    /// [`Failure::OutsideYieldSurface`] for a stress that violates the yield condition of `law`.
    pub(crate) fn stressed<const D: usize>(
        &self,
        law: Box<dyn Material<D>>,
        particles: &mut Particles<D>,
    ) -> Result<Box<dyn Material<D>>, Failure> {
        if self.stress.is_none() {
            return Ok(law);
        }
        let stress = particles.x0.iter().map(|x0| {
            let stress = self.stress.at(x0.as_slice());
            Matrix::from_fn(|i, j| stress[i][j])
        });
        let stress: Vec<Matrix<3>> = stress.collect();
        Ok(Box::new(Prestressed::new(law, &stress, particles)?))
    }

    pub(crate) fn put<const D: usize>(&self, particles: &mut Particles<D>) {
        let states: Vec<Derivatives> =
            particles.x0.iter().map(|x0| self.at(x0.as_slice())).collect();
        for (v, now) in particles.v.iter_mut().zip(&states) {
            *v = Vector::from_fn(|i, _| now.velocity[i]);
        }
        for (grad_v, now) in particles.grad_v.iter_mut().zip(&states) {
            let f: Matrix<D> = Matrix::from_fn(|i, j| now.grad[i][j]) + Matrix::identity();
            let rate = Matrix::from_fn(|i, j| now.grad_rate[i][j]);
            // If F has no inverse, the solver rejects the initial state.
            *grad_v = inverse(&f).map_or_else(Matrix::zeros, |inverse| rate * inverse);
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::formula::{Expr, Scope};
    use crate::mpm::{Block, MaterialPlan};
    use approx::assert_relative_eq;
    use rstest::rstest;

    fn stress() -> InitialStress {
        let component = |(i, j, text): (usize, usize, &str)| {
            let expr = Expr::parse(text).unwrap();
            (i, j, Formula::bind(&expr, &Scope::new(), &["X", "Y"]).unwrap())
        };
        let stated = [(0, 0, "2*X"), (1, 1, "3 + Y"), (0, 1, "X*Y")].map(component);
        InitialStress::new(stated.into())
    }

    /// The solver and the exact solution must add the same initial stress to the stress of the law.
    #[rstest]
    #[case(MaterialPlan::LinearElastic { young: 100.0, poisson: 0.3 })]
    #[case(MaterialPlan::NeoHookean { young: 100.0, poisson: 0.3 })]
    #[case(MaterialPlan::Hencky { young: 100.0, poisson: 0.3 })]
    fn solver_and_exact_solution_have_the_same_initial_stress(#[case] plan: MaterialPlan) {
        let is_finite = plan.properties().depends_on_deformation_alone().is_ok();
        let f = Matrix::<2>::new(1.1, 0.2, -0.3, 1.05);
        let grad = [[0.1, 0.2, 0.0], [-0.3, 0.05, 0.0], [0.0; 3]];
        let started = |stress: InitialStress| {
            let (from, to) = (Vector::zeros(), Vector::from_element(1.0));
            let mut body = Particles::fill(&Block { from, to, density: 1.0 }, 1.0, 2);
            let initial = Initial { motion: None, displacement: None, velocity: None, stress };
            let mut law = initial.stressed(plan.build(), &mut body).unwrap();
            body.deform(|_| (Vector::zeros(), f));
            law.start_deformed(&mut body).unwrap();
            body
        };
        let (with, without) = (started(stress()), started(InitialStress::default()));
        for (p, label) in with.x0.iter().enumerate() {
            let expected = stress().cauchy(label.as_slice(), &grad, is_finite);
            let expected = Matrix::<2>::from_fn(|i, j| expected[i][j]);
            let found = with.sigma[p] - without.sigma[p];
            assert_relative_eq!(found, expected, epsilon = 1e-12);
        }
    }
}
