//! Exact values of the functionals and of their derivatives.

use crate::exact::{ParametricMotion, ParametricState};
use crate::external::LevelProblem;
use crate::subject::{Functional, GradientParameter};
use crate::suite::model::gradient::{Differentiated, GradientPlan};

/// A value and its derivative.
type Dual = (f64, f64);

/// Exact derivative, at the end of the run, of the functional with respect to a parameter of the
/// problem. It is total: where the suite's initial velocity follows the parameter, so does that of
/// the exact motion.
pub(super) fn derivative(plan: &GradientPlan, one: &Differentiated, problem: &LevelProblem) -> f64 {
    let slope = slope(plan.of, one, problem);
    match one.parameter {
        // The parameter of the problem is a factor on the parameter of the suite.
        GradientParameter::InitialVelocity => one.motion.value * slope,
        _ => slope,
    }
}

/// Derivative of the functional with respect to the parameter of the suite.
fn slope(of: Functional, one: &Differentiated, problem: &LevelProblem) -> f64 {
    let (motion, t) = (&one.motion, problem.until);
    match of {
        Functional::MeanDisplacement { axis } => {
            mean(motion, t, &|state| (state.displacement[axis], state.displacement_slope[axis])).1
        }
        Functional::MeanSquareDisplacement => {
            mean(motion, t, &|state| square(&state.displacement, &state.displacement_slope)).1
        }
        Functional::KineticEnergy => {
            let density = problem.materials.first().map_or(f64::NAN, |one| one.density);
            let (integral, slope) =
                integral(motion, t, &|state| square(&state.velocity, &state.velocity_slope));
            let mass =
                if one.parameter == GradientParameter::Density { 0.5 * integral } else { 0.0 };
            0.5 * density * slope + mass
        }
        Functional::PositionOf { particle, axis } => {
            let d = problem.dimension;
            let label = problem.particles.reference_position.get(particle * d..(particle + 1) * d);
            label.map_or(f64::NAN, |label| motion.at(label, t).displacement_slope[axis])
        }
    }
}

/// Square of a vector, with its derivative.
fn square(vector: &[f64], slope: &[f64]) -> Dual {
    let both = vector.iter().zip(slope);
    both.fold((0.0, 0.0), |(sum, rise), (x, dx)| (sum + x * x, rise + 2.0 * x * dx))
}

/// Integral over the body, with its derivative.
fn integral(motion: &ParametricMotion, t: f64, of: &dyn Fn(&ParametricState) -> Dual) -> Dual {
    let states = motion.states(t);
    states.iter().fold((0.0, 0.0), |(sum, rise), (state, weight)| {
        let (value, slope) = of(state);
        (sum + weight * value, rise + weight * slope)
    })
}

/// Mean over the body, with its derivative.
fn mean(motion: &ParametricMotion, t: f64, of: &dyn Fn(&ParametricState) -> Dual) -> Dual {
    let (sum, slope) = integral(motion, t, of);
    let volume: f64 = motion.from.iter().zip(&motion.to).map(|(from, to)| to - from).product();
    (sum / volume, slope / volume)
}
