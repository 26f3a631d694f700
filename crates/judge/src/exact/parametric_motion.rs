//! A motion as a function of one formula parameter.

use super::formula::{Formula, Jet};
use super::gauss::points;

/// Number of quadrature panels along each axis, by dimension.
const PANELS: [usize; 3] = [16, 8, 3];

/// Maximum derivative `q/v dv/dq` of a velocity v that counts as rounding error of the parameter q.
const ROUNDING: f64 = 1e-14;

/// A displacement whose formulas contain a parameter as a variable.
#[derive(Debug, Clone)]
pub struct ParametricMotion {
    /// Lowest corner of the body (m).
    pub from: Vec<f64>,
    /// Highest corner of the body (m).
    pub to: Vec<f64>,
    /// Components of the displacement (m), formulas of the coordinates, t and the parameter.
    pub displacement: Vec<Formula>,
    /// Value of the parameter.
    pub value: f64,
}

/// Displacement and velocity at one position and time, with their derivatives with respect to the
/// parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct ParametricState {
    /// Displacement (m).
    pub displacement: Vec<f64>,
    /// Derivative of the displacement with respect to the parameter.
    pub displacement_slope: Vec<f64>,
    /// Velocity (m/s).
    pub velocity: Vec<f64>,
    /// Derivative of the velocity with respect to the parameter.
    pub velocity_slope: Vec<f64>,
}

impl ParametricMotion {
    /// Computes the state at the reference position `label` (m) and time `t` (s).
    pub fn at(&self, label: &[f64], t: f64) -> ParametricState {
        let mut variables: Vec<Jet<2>> = label.iter().map(|x| Jet::from(*x)).collect();
        variables.extend([Jet::variable(t, 0), Jet::variable(self.value, 1)]);
        let components: Vec<Jet<2>> =
            self.displacement.iter().map(|formula| formula.eval(&variables)).collect();
        let all = |of: &dyn Fn(&Jet<2>) -> f64| components.iter().map(of).collect();
        ParametricState {
            displacement: all(&Jet::value),
            displacement_slope: all(&|u| u.d(1)),
            velocity: all(&|u| u.d(0)),
            velocity_slope: all(&|u| u.dd(0, 1)),
        }
    }

    /// Computes states at time `t` (s) at quadrature points of the body, with weights (m^D).
    pub fn states(&self, t: f64) -> Vec<(ParametricState, f64)> {
        self.places().iter().map(|(label, weight)| (self.at(label, t), *weight)).collect()
    }

    /// Returns the factor c in `dv/dq = c v` for the initial velocity v, `None` if there is none.
    pub fn velocity_factor(&self) -> Option<f64> {
        let states = self.states(0.0);
        let sum = |product: &dyn Fn(&ParametricState) -> f64| -> f64 {
            states.iter().map(|(state, weight)| weight * product(state)).sum()
        };
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        let squares = sum(&|s| dot(&s.velocity, &s.velocity));
        let slopes = sum(&|s| dot(&s.velocity_slope, &s.velocity_slope));
        // In v0/w*w, for instance, the derivatives of w cancel except for rounding.
        let noise = ROUNDING / self.value;
        if slopes <= noise * noise * squares {
            return Some(0.0);
        }
        let factor = sum(&|s| dot(&s.velocity_slope, &s.velocity)) / squares;
        let rest = sum(&|s| {
            let parts = s.velocity_slope.iter().zip(&s.velocity);
            parts.map(|(slope, v)| slope - factor * v).map(|rest| rest * rest).sum()
        });
        (rest <= 1e-20 * slopes).then_some(factor)
    }

    /// Whether the displacement is zero at t = 0.
    pub fn starts_at_rest_position(&self) -> bool {
        self.states(0.0).iter().all(|(state, _)| state.displacement.iter().all(|u| *u == 0.0))
    }

    fn places(&self) -> Vec<(Vec<f64>, f64)> {
        let axes: Vec<(f64, f64)> =
            self.from.iter().copied().zip(self.to.iter().copied()).collect();
        points(&axes, PANELS[axes.len().clamp(1, 3) - 1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::tests::bind;
    use approx::assert_abs_diff_eq;

    fn motion(text: &str) -> ParametricMotion {
        let displacement = vec![bind(text, &["X", "t", "q"])];
        ParametricMotion { from: vec![0.0], to: vec![1.0], displacement, value: 2.0 }
    }

    #[test]
    fn derivatives_agree_with_the_formula() {
        let state = motion("X*q^2*sin(q*t)").at(&[0.5], 0.3);
        let (sin, cos) = (libm::sin(0.6), libm::cos(0.6));
        let close = |a: f64, b: f64| (a - b).abs() < 1e-14;
        assert!(close(state.displacement[0], 2.0 * sin));
        assert!(close(state.displacement_slope[0], 2.0 * sin + 0.6 * cos));
        assert!(close(state.velocity[0], 4.0 * cos));
        assert!(close(state.velocity_slope[0], 6.0 * cos - 1.2 * sin));
    }

    #[test]
    fn a_velocity_that_scales_with_the_parameter_has_a_factor() {
        let factor = |text: &str| motion(text).velocity_factor();
        assert_eq!(factor("sin(X)*sin(t)"), Some(0.0));
        assert_eq!(factor("0*t*q"), Some(0.0));
        let scaled = factor("sin(X)*sin(q*t)").expect("a factor");
        assert_abs_diff_eq!(scaled, 0.5, epsilon = 1e-14);
        assert_eq!(factor("sin(q*X)*sin(t)"), None);
    }

    /// A plate of 3 m x 2 m away from the origin, and a parameter of -2e-6 m/s.
    #[test]
    fn motions_in_the_plane_have_derivatives_and_a_volume() {
        let names = ["X", "Y", "t", "q"];
        let displacement = vec![bind("q*t*(X + 2*Y)", &names), bind("-3*q*t*(X + 2*Y)", &names)];
        let (from, to) = (vec![1.0, 5.0], vec![4.0, 7.0]);
        let plate = ParametricMotion { from, to, displacement, value: -2e-6 };
        let state = plate.at(&[2.0, 6.0], 0.5);
        let close = |found: &[f64], expected: [f64; 2]| {
            found.iter().zip(expected).all(|(a, b)| (a / b - 1.0).abs() < 1e-14)
        };
        assert!(close(&state.displacement, [-1.4e-5, 4.2e-5]), "{state:?}");
        assert!(close(&state.displacement_slope, [7.0, -21.0]), "{state:?}");
        assert!(close(&state.velocity, [-2.8e-5, 8.4e-5]), "{state:?}");
        assert!(close(&state.velocity_slope, [14.0, -42.0]), "{state:?}");
        let volume: f64 = plate.states(0.5).iter().map(|(_, weight)| weight).sum();
        assert_abs_diff_eq!(volume, 6.0, epsilon = 1e-13);
        assert_abs_diff_eq!(plate.velocity_factor().expect("a factor"), -5e5, epsilon = 1e-6);
        assert!(plate.starts_at_rest_position());
        let shifted = ParametricMotion { displacement: vec![bind("q*(1 + t)", &names)], ..plate };
        assert!(!shifted.starts_at_rest_position());
    }

    #[test]
    fn rounding_of_a_derivative_that_cancels_is_no_dependence() {
        for k in 1..=60 {
            let value = 0.37 * f64::from(k);
            let motion = motion("1e-5/(pi/2*sqrt(q/0.7))*sin(pi*X/2)*sin(pi/2*sqrt(q/0.7)*t)");
            assert_eq!(
                ParametricMotion { value, ..motion }.velocity_factor(),
                Some(0.0),
                "{value}"
            );
        }
        let weak = motion("(1 + 1e-9*q)*sin(X)*sin(t)").velocity_factor().expect("a factor");
        assert_abs_diff_eq!(weak, 1e-9, epsilon = 1e-14);
        assert_eq!(motion("(X + 1e-9*q*X^2)*t").velocity_factor(), None);
    }
}
