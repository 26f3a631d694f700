//! Boundary conditions, checked at points of every face, and of every part whose motion is given.

use super::friction;
use super::pointwise::{AXES, Event, POINTS, largest, scale, strain};
use crate::exact::formula::Formula;
use crate::exact::motion::{Derivatives, variables};
use crate::exact::problem::{Condition, Face, Problem};
use crate::exact::random::Random;
use crate::exact::violation::Violation;

/// Magnitudes that residuals of boundary conditions are compared with.
struct Magnitudes {
    displacement: f64,
    velocity: f64,
    gradient: f64,
    stress: f64,
}

/// Every face of the body, at random points and times.
pub(crate) fn boundary(problem: &Problem) -> Result<(), Violation> {
    let gradient = strain(problem);
    let sizes = Magnitudes {
        displacement: scale(problem, |_, d| largest(&d.u)),
        velocity: scale(problem, |_, d| largest(&d.velocity)),
        gradient,
        stress: problem.equation.modulus() * gradient,
    };
    let mut random = Random::new(3);
    for face in &problem.faces {
        for _ in 0..POINTS {
            let label = random.on_face(&problem.from, &problem.to, face.axis, face.high);
            let event = Event { label, t: problem.moment(&mut random) };
            on_face(problem, face, &event, &sizes)?;
        }
    }
    Ok(())
}

fn on_face(
    problem: &Problem,
    face: &Face,
    event: &Event,
    sizes: &Magnitudes,
) -> Result<(), Violation> {
    let all = problem.motion.derivatives(&event.label, event.t);
    if let Condition::Periodic(period) = face.condition {
        return periodic(problem, face, event, period, &all, sizes);
    }
    if let Condition::Friction(coefficient) = face.condition {
        let Magnitudes { displacement, velocity, stress, .. } = *sizes;
        let sizes = [displacement, velocity, stress];
        return friction::at_wall(problem, face, event, (coefficient, &all), sizes);
    }
    for i in 0..problem.dimension() {
        match &face.condition {
            Condition::Roller if i != face.axis => {
                let what = "a roller";
                traction(problem, face, event, (i, what, 0.0), &all, sizes)?;
            }
            Condition::Fixed | Condition::Roller => {
                let what =
                    if matches!(face.condition, Condition::Fixed) { "fixed" } else { "a roller" };
                let name =
                    format!("boundary condition: {} is {what}, u_{} = 0", face.name, AXES[i]);
                let allowed = problem.tolerance * sizes.displacement;
                event.judge(allowed, name, (0.0, all.u[i]), "m")?;
            }
            Condition::Velocity(value) => {
                let given = at(&value[i], event);
                let name = format!("boundary condition: velocity of {} in {}", face.name, AXES[i]);
                let allowed = problem.tolerance * sizes.velocity.max(given.abs());
                event.judge(allowed, name, (given, all.velocity[i]), "m/s")?;
            }
            Condition::Traction(value) => {
                let pulled = at(&value[i], event);
                traction(problem, face, event, (i, "loaded", pulled), &all, sizes)?;
            }
            Condition::Pressure(value) => {
                let area = problem.equation.present_area(&all.grad, face.axis, face.high);
                let pressed = -at(value, event) * area[i];
                traction(problem, face, event, (i, "under pressure", pressed), &all, sizes)?;
            }
            Condition::Free => traction(problem, face, event, (i, "free", 0.0), &all, sizes)?,
            Condition::Friction(_) | Condition::Periodic(_) | Condition::Met => {}
        }
    }
    Ok(())
}

fn at(formula: &Formula, event: &Event) -> f64 {
    formula.eval(&variables(&event.label, event.t)[..=event.label.len()])
}

/// `(P n)_i = p0_i`.
fn traction(
    problem: &Problem,
    face: &Face,
    event: &Event,
    (i, what, pulled): (usize, &str, f64),
    all: &Derivatives,
    sizes: &Magnitudes,
) -> Result<(), Violation> {
    let normal = if face.high { 1.0 } else { -1.0 };
    let found = normal * problem.piola(&event.label, event.t, all)[i][face.axis];
    let name = format!("boundary condition: {} is {what}, traction in {}", face.name, AXES[i]);
    let allowed = problem.tolerance * sizes.stress.max(pulled.abs());
    event.judge(allowed, name, (pulled, found), "Pa")
}

/// Opposite points stay one period apart, and grad u is the same in both: then P is, and nothing
/// tells where the seam is.
fn periodic(
    problem: &Problem,
    face: &Face,
    event: &Event,
    period: f64,
    here: &Derivatives,
    sizes: &Magnitudes,
) -> Result<(), Violation> {
    let mut opposite = event.label.clone();
    opposite[face.axis] = if face.high { problem.from[face.axis] } else { problem.to[face.axis] };
    let there = problem.motion.derivatives(&opposite, event.t);
    let condition = |what: String| {
        format!("boundary condition: {} is periodic, {what} the opposite face,", face.name)
    };
    let (high, low) = if face.high { (here, &there) } else { (&there, here) };
    for i in 0..problem.dimension() {
        let allowed = problem.tolerance * sizes.displacement;
        if i == face.axis {
            let length = problem.to[i] - problem.from[i];
            let apart = length + (high.u[i] - low.u[i]);
            let name = condition(format!("x_{} one period away from", AXES[i]));
            event.judge(allowed.max(4.0 * f64::EPSILON * period), name, (period, apart), "m")?;
        } else {
            let name = condition(format!("u_{} as on", AXES[i]));
            event.judge(allowed, name, (there.u[i], here.u[i]), "m")?;
        }
        for j in 0..problem.dimension() {
            let name = condition(format!("du_{}/d{} as on", AXES[i], AXES[j]));
            let allowed = problem.tolerance * sizes.gradient;
            event.judge(allowed, name, (there.grad[i][j], here.grad[i][j]), "")?;
        }
    }
    Ok(())
}

/// `u_t` is the velocity that is given, in every region that has one.
pub(crate) fn driven(problem: &Problem) -> Result<(), Violation> {
    let speed = scale(problem, |_, d| largest(&d.velocity));
    let mut random = Random::new(7);
    for (region, velocity) in problem.terms.iter().filter_map(|term| term.driven()) {
        let (from, to) = region.within((&problem.from, &problem.to));
        for _ in 0..POINTS {
            let label = random.point(&from, &to);
            let event = Event { label, t: problem.moment(&mut random) };
            let now = problem.motion.derivatives(&event.label, event.t);
            for (i, formula) in velocity.iter().enumerate() {
                let given = at(formula, &event);
                let name = format!("given velocity of the set {} in {}", region.name, AXES[i]);
                let allowed = problem.tolerance * speed.max(given.abs());
                event.judge(allowed, name, (given, now.velocity[i]), "m/s")?;
            }
        }
    }
    Ok(())
}
