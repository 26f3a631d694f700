//! Checks Coulomb friction at a point of a face. The wall exerts pressure but no tension, the face
//! does not penetrate the wall, and the friction stress against sliding is mu times the pressure.
//!
//! Forces are per reference area, which does not affect Coulomb's law.

use super::event::{AXES, Event};
use crate::exact::condition::Face;
use crate::exact::motion::Derivatives;
use crate::exact::problem::Problem;
use crate::exact::violation::Violation;

/// Checks the motion `now` of a point of `face` at a frictional wall. The last argument contains
/// the scales of the residuals: the largest displacement (m), velocity (m/s) and stress (Pa).
pub(crate) fn at_wall(
    problem: &Problem,
    face: &Face,
    event: &Event,
    coefficient: f64,
    now: &Derivatives,
    [displacement, velocity, stress]: [f64; 3],
) -> Result<(), Violation> {
    let (axis, d, tolerance) = (face.axis, problem.dimension(), problem.tolerance);
    let wall = format!("the friction wall `{}`", face.name);
    let name = format!("boundary condition: u_{} = 0 on {wall}", AXES[axis]);
    event.judge_condition(tolerance * displacement, name, (0.0, now.u[axis]), "m")?;

    let outwards = if face.high { 1.0 } else { -1.0 };
    let piola = problem.piola(&event.label, event.t, now);
    let traction: [f64; 3] = std::array::from_fn(|i| outwards * piola[i][axis]);
    let pressure = -outwards * traction[axis];
    let allowed = problem.law_tolerance() * stress;
    let name = format!("boundary condition: {wall} pulls the body");
    event.judge_most(allowed, name, 0.0, -pressure, "Pa")?;

    let rub = InterfaceTraction { traction, velocity: now.velocity, pressure, coefficient };
    coulomb(event, axis, d, &rub, [allowed, tolerance * velocity], &wall)
}

pub(crate) struct InterfaceTraction {
    /// Traction that the other surface exerts (Pa).
    pub(crate) traction: [f64; 3],
    /// Velocity relative to the other surface (m/s).
    pub(crate) velocity: [f64; 3],
    pub(crate) pressure: f64,
    pub(crate) coefficient: f64,
}

/// Checks Coulomb's law on a surface with the normal `axis`, up to tolerances (Pa and m/s).
pub(crate) fn coulomb(
    event: &Event,
    axis: usize,
    d: usize,
    rub: &InterfaceTraction,
    [stress, velocity]: [f64; 2],
    surface: &str,
) -> Result<(), Violation> {
    let most = rub.coefficient * rub.pressure;
    let along = |vector: &[f64; 3]| {
        let squares = (0..d).filter(|i| *i != axis).map(|i| vector[i] * vector[i]);
        squares.sum::<f64>().sqrt()
    };
    let speed = along(&rub.velocity);
    if speed <= velocity {
        let name = format!("at rest, the traction along {surface} exceeds mu times the pressure");
        return event.judge_most(stress, name, most, along(&rub.traction), "Pa");
    }
    for i in (0..d).filter(|i| *i != axis) {
        let name = format!(
            "the traction in {} on {surface} does not have the value that opposes the velocity",
            AXES[i]
        );
        let expected = -most * rub.velocity[i] / speed;
        event.judge(stress, name, (expected, rub.traction[i]), "Pa")?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exact::tests::{Demands, assert_outcome, bind, face, free, held, weight};
    use crate::exact::{Motion, SmallStrainLaw};
    use rstest::rstest;

    /// Creates a layer of height 1 under gravity (3, -4), with shear modulus 100, density 1 and
    /// lambda = 0, that sticks to the wall or slides. Shear and pressure increase towards the wall.
    fn layer(coefficient: f64, motion: [&str; 2]) -> Problem {
        let wall = Demands::condition(move |point| point.friction(coefficient));
        Problem {
            density: 1.0.into(),
            equation: SmallStrainLaw::new(200.0, 0.0).into(),
            terms: weight(&["3", "-4"]),
            manufactured: false,
            faces: vec![face("bottom", 1, false, wall), face("top", 1, true, free())],
            motion: Motion::new(motion.map(|u| bind(u, &["X", "Y", "t"])).to_vec()),
            ..held(2)
        }
    }

    /// Vertical displacement of a layer settled under its own weight; the wall pressure is 4.
    const SETTLED: &str = "4/200*(Y^2/2 - Y)";
    /// Displacement along the wall of a sliding layer. The force is 3, the friction 2 (mu = 1/2).
    const SLIDES: &str = "t^2/2 - 2/100*(Y^2/2 - Y)";
    const STAYS: &str = "-3/100*(Y^2/2 - Y)";

    #[rstest]
    #[case::slides(0.5, [SLIDES, SETTLED], "")]
    #[case::stays(0.8, [STAYS, SETTLED], "")]
    #[case::too_little_friction(0.45, [SLIDES, SETTLED], "opposes the velocity")]
    #[case::too_much_friction(0.6, [SLIDES, SETTLED], "opposes the velocity")]
    #[case::stays_without_friction(0.7, [STAYS, SETTLED], "at rest")]
    #[case::slides_uphill(
        0.5,
        ["5/2*t^2 + 2/100*(Y^2/2 - Y)", SETTLED],
        "opposes the velocity"
    )]
    #[case::hangs(0.5, [SLIDES, "-4/200*(Y^2/2 - Y)"], "pulls the body")]
    #[case::sinks_in(0.5, [SLIDES, "4/200*(Y^2/2 - Y) - 1e-3"], "u_Y = 0")]
    fn a_layer_on_a_slope(
        #[case] coefficient: f64,
        #[case] motion: [&str; 2],
        #[case] violated: &str,
    ) {
        assert_outcome(layer(coefficient, motion).check(), violated);
    }
}
