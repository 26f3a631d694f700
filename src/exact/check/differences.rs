//! Two differentiations of one motion: automatic, and by central differences.

use super::pointwise::{AXES, Event, POINTS, largest, scale};
use crate::exact::motion::Derivatives;
use crate::exact::problem::Problem;
use crate::exact::random::Random;
use crate::exact::violation::Violation;

/// Relative agreement asked of automatic differentiation and finite differences. Differences of
/// second order with the steps below reach about 1e-6.
pub(crate) const DIFFERENCE_TOLERANCE: f64 = 1e-4;

/// Holds `check` at random events. A kink (a wave front) that happens to lie within the reach of
/// differences is no fault, so an event is moved twice before it counts.
pub(crate) fn away_from_kinks(
    event: impl Fn(&mut Random) -> Event,
    check: impl Fn(&Event) -> Result<(), Violation>,
) -> Result<(), Violation> {
    let mut random = Random::new(5);
    for _ in 0..POINTS / 4 {
        let mut last = Ok(());
        for _ in 0..3 {
            last = check(&event(&mut random));
            if last.is_ok() {
                break;
            }
        }
        last?;
    }
    Ok(())
}

/// Automatic differentiation against central differences.
pub(crate) fn differentiation(problem: &Problem) -> Result<(), Violation> {
    let speed = scale(problem, |_, d| largest(&d.velocity));
    let acceleration = scale(problem, |_, d| largest(&d.acceleration));
    away_from_kinks(
        |random| Event { label: problem.point(random), t: problem.moment(random) },
        |event| differences(problem, event, speed, acceleration),
    )
}

fn differences(
    problem: &Problem,
    event: &Event,
    speed: f64,
    acceleration: f64,
) -> Result<(), Violation> {
    let step = 1e-5 * problem.until;
    let all = problem.derivatives(&event.label, event.t);
    for i in 0..problem.dimension() {
        let u = |t: f64| problem.motion.component(i, &event.label, t);
        let (low, mid, high) = (u(event.t - step), u(event.t), u(event.t + step));
        let name = format!("agreement of two differentiations of u_{} in time", AXES[i]);
        let allowed = DIFFERENCE_TOLERANCE * speed;
        let slope = (high - low) / (2.0 * step);
        event.judge(allowed, name.clone(), (slope, all.velocity[i]), "m/s")?;
        // The second difference loses digits: u itself, known to 1e-16, is divided by step^2.
        let rounding = 1e-13 * (low.abs() + mid.abs() + high.abs()) / (step * step);
        let allowed = DIFFERENCE_TOLERANCE * acceleration + rounding;
        let curvature = (high - 2.0 * mid + low) / (step * step);
        event.judge(allowed, name, (curvature, all.acceleration[i]), "m/s2")?;
    }
    stress_differences(problem, event, &all)
}

/// Div P, once by automatic differentiation and once from P at neighbouring points.
fn stress_differences(
    problem: &Problem,
    event: &Event,
    all: &Derivatives,
) -> Result<(), Violation> {
    let d = problem.dimension();
    let exact = problem.divergence(&event.label, event.t, all);
    let (mut divergence, mut size) = (problem.hoop_force(&event.label, event.t, all), 0.0);
    for axis in 0..d {
        let step = 1e-5 * (problem.to[axis] - problem.from[axis]);
        let stress = |sign: f64| {
            let mut label = event.label.clone();
            label[axis] += sign * step;
            problem.piola(&label, event.t, &problem.derivatives(&label, event.t))
        };
        let (low, high) = (stress(-1.0), stress(1.0));
        for i in 0..d {
            divergence[i] += (high[i][axis] - low[i][axis]) / (2.0 * step);
            size += (high[i][axis].abs() + low[i][axis].abs()) / step;
        }
    }
    for i in 0..d {
        let name = format!("agreement of two differentiations of Div P in {}", AXES[i]);
        let allowed = DIFFERENCE_TOLERANCE * largest(&exact) + 1e-9 * size;
        event.judge(allowed, name, (divergence[i], exact[i]), "N/m3")?;
    }
    Ok(())
}
