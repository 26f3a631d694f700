//! Initial states of bodies.
//!
//! If the exact solution is a motion and the stress depends on the deformation only, the initial
//! state is the exact motion at t = 0: `x = X + u(X, 0)`, `F = I + grad u`, `v = u_t`. Otherwise
//! the scene describes the initial state; by default it is at rest and undeformed. The initial
//! stress always comes from the scene.

use crate::exact::formula::Formula;
use crate::exact::{Derivatives, InitialStress, Motion};
use crate::mpm::input::{InitialState, StateInput, StressAt};
use crate::suite::model::{ConvergencePlan, Scene};

#[derive(Clone)]
pub(crate) struct Initial {
    motion: Option<Motion>,
    displacement: Option<Motion>,
    velocity: Option<Motion>,
    stress: InitialStress,
}

impl Initial {
    pub(crate) fn of_body(plan: &ConvergencePlan, body: &Scene) -> Self {
        let exact = plan.exact.as_ref().filter(|problem| problem.follows_motion);
        Self { motion: exact.map(|problem| problem.motion.clone()), ..Self::stated(body) }
    }

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

    pub(crate) fn is_displaced(&self) -> bool {
        self.motion.is_some() || self.displacement.is_some()
    }

    pub(crate) fn input(self) -> InitialState<'static> {
        let is_displaced = self.is_displaced();
        let stress = self.stress.clone();
        InitialState {
            motion: Box::new(move |label| {
                let Derivatives { u, grad, velocity, grad_rate, .. } = self.at(label);
                StateInput { u, grad, velocity, grad_rate }
            }),
            is_displaced,
            stress: (!stress.is_none())
                .then(|| -> StressAt<'_> { Box::new(move |x| stress.at(x)) }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::formula::{Expr, Scope};
    use crate::mpm::MaterialPlan;
    use crate::mpm::input::initial_stress;
    use crate::subject::PlaneState;
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

    /// The gradient of v = (X Y, 3 Y) is (Y, X; 0, 3).
    #[test]
    fn stated_velocity_has_its_gradient() {
        let component = |text: &str| {
            Formula::bind(&Expr::parse(text).unwrap(), &Scope::new(), &["X", "Y", "t"]).unwrap()
        };
        let velocity = Some(Motion::new(["X*Y", "3*Y"].map(component).into()));
        let stress = InitialStress::default();
        let initial = Initial { motion: None, displacement: None, velocity, stress };
        let StateInput { velocity, grad_rate, .. } = (initial.input().motion)(&[2.0, 5.0]);
        assert_eq!(velocity, [10.0, 15.0, 0.0]);
        assert_eq!(grad_rate, [[5.0, 2.0, 0.0], [0.0, 3.0, 0.0], [0.0; 3]]);
    }

    /// The solver and the exact solution must add the same initial stress to the stress of the law.
    #[rstest]
    #[case(MaterialPlan::LinearElastic { young: 100.0, poisson: 0.3 })]
    #[case(MaterialPlan::NeoHookean { young: 100.0, poisson: 0.3 })]
    #[case(MaterialPlan::Hencky { young: 100.0, poisson: 0.3 })]
    fn solver_and_exact_solution_have_the_same_initial_stress(#[case] plan: MaterialPlan) {
        let is_finite = plan.properties().depends_on_deformation_alone().is_ok();
        let grad = [[0.1, 0.2, 0.0], [-0.3, 0.05, 0.0], [0.0; 3]];
        let labels = [[0.25, 0.25], [0.75, 0.25], [0.25, 0.75], [0.75, 0.75]].map(Vec::from);
        let computed = |stress: InitialStress| {
            let initial = Initial { motion: None, displacement: None, velocity: None, stress };
            let mut initial = initial.input();
            initial.motion = Box::new(move |_| StateInput { grad, ..StateInput::default() });
            initial.is_displaced = true;
            initial_stress(&labels, PlaneState::Strain, &plan, &initial, &[1.0; 4]).unwrap()
        };
        let (with, without) = (computed(stress()), computed(InitialStress::default()));
        for (p, label) in labels.iter().enumerate() {
            let expected = stress().cauchy(label, &grad, is_finite);
            for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let added = with[4 * p + 2 * i + j] - without[4 * p + 2 * i + j];
                assert_relative_eq!(added, expected[i][j], epsilon = 1e-12);
            }
        }
    }
}
