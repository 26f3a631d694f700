//! The continuum problem that an exact solution is held to.

use super::{
    equation::Equation,
    formula::Formula,
    motion::{Derivatives, Motion},
};

/// A boundary condition on one face of the body.
#[derive(Debug, Clone)]
pub enum Condition {
    /// u = 0.
    Fixed,
    /// P n = p0(t), one formula of t for each component (Pa).
    Traction(Vec<Formula>),
    /// P n = 0.
    Free,
}

/// One face of a box-shaped body.
#[derive(Debug, Clone)]
pub struct Face {
    /// Name that a suite gives it.
    pub name: &'static str,
    /// Axis of its normal.
    pub axis: usize,
    /// Whether it is the face with the larger coordinate.
    pub high: bool,
    /// What holds there.
    pub condition: Condition,
}

/// An initial-boundary-value problem on a box, with the motion that claims to solve it.
#[derive(Debug, Clone)]
pub struct Problem {
    /// Lowest corner of the body (m).
    pub from: Vec<f64>,
    /// Highest corner (m).
    pub to: Vec<f64>,
    /// Reference density (kg/m^D).
    pub density: f64,
    /// The equation of motion.
    pub equation: Equation,
    /// Uniform body force per unit mass (m/s2), one formula of t for each component; empty where
    /// there is none.
    pub gravity: Vec<Formula>,
    /// Whether a further body force is added that makes the motion a solution: the method of
    /// manufactured solutions (Roache 2002).
    pub manufactured: bool,
    /// Every face of the body.
    pub faces: Vec<Face>,
    /// Initial velocity (m/s), formulas of the coordinates and t (= 0); empty: at rest.
    pub initial_velocity: Vec<Formula>,
    /// End of the run (s).
    pub until: f64,
    /// The claimed solution.
    pub motion: Motion,
    /// Largest residual that passes, relative to the terms of the condition.
    pub tolerance: f64,
}

impl Problem {
    /// Number of space dimensions.
    pub fn dimension(&self) -> usize {
        self.from.len()
    }

    /// The manufactured body force (m/s2): `b = u_tt - Div P / rho0`, less gravity.
    pub fn manufactured_force(&self, label: &[f64], t: f64) -> [f64; 3] {
        let balance = self.balance(&self.motion.derivatives(label, t));
        std::array::from_fn(|i| balance[i] - self.gravity(i, t))
    }

    /// The whole body force (m/s2) where the motion's derivatives are `now`.
    pub(super) fn force(&self, now: &Derivatives, t: f64) -> [f64; 3] {
        if self.manufactured {
            self.balance(now)
        } else {
            std::array::from_fn(|i| self.gravity(i, t))
        }
    }

    /// The body force that the motion needs, `u_tt - Div P / rho0`.
    fn balance(&self, now: &Derivatives) -> [f64; 3] {
        let stress = self.equation.divergence(self.dimension(), &now.grad, &now.second);
        std::array::from_fn(|i| now.acceleration[i] - stress[i] / self.density)
    }

    fn gravity(&self, i: usize, t: f64) -> f64 {
        self.gravity.get(i).map_or(0.0, |formula| formula.eval(&[t]))
    }
}
