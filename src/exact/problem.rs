//! The continuum problem that an exact solution is held to.

use super::{equation::Equation, formula::Formula, motion::Motion};

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
    /// Body force per unit mass (m/s2), formulas of (X, Y, Z, t) as far as there are dimensions;
    /// empty where there is none.
    pub body_force: Vec<Formula>,
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

    /// The manufactured body force (m/s2): `b = u_tt - Div P / rho0`, less what the scene declares.
    pub fn manufactured_force(&self, label: &[f64], t: f64) -> [f64; 3] {
        let all = self.motion.derivatives(label, t);
        let stress = self.equation.divergence(self.dimension(), &all.grad, &all.second);
        let declared = |i| self.declared_force(i, label, t);
        std::array::from_fn(|i| all.acceleration[i] - stress[i] / self.density - declared(i))
    }

    /// Component i of the whole body force (m/s2).
    pub(super) fn force(&self, i: usize, label: &[f64], t: f64) -> f64 {
        let made = if self.manufactured { self.manufactured_force(label, t)[i] } else { 0.0 };
        self.declared_force(i, label, t) + made
    }

    fn declared_force(&self, i: usize, label: &[f64], t: f64) -> f64 {
        let variables = super::motion::variables(label, t);
        self.body_force.get(i).map_or(0.0, |f| f.eval(&variables[..=label.len()]))
    }
}
