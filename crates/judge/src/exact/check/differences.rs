//! Compares automatic differentiation with central differences.

use super::event::{AXES, Event, greatest};
use super::survey::{Magnitudes, Survey};
use crate::exact::motion::Derivatives;
use crate::exact::problem::Problem;
use crate::exact::violation::Violation;

/// Maximum relative difference between automatic differentiation and finite differences, which are
/// accurate to about 1e-6.
pub(crate) const DIFFERENCE_TOLERANCE: f64 = 1e-4;

const PLACES: usize = 32;

/// Maximum difference step, relative to the size of the body or the duration of the run.
const STEP: f64 = 1e-5;

/// Maximum difference step, relative to the length or time over which the motion varies.
const SHARE: f64 = 1e-3;

/// Returns the difference step (s or m) for a run or body of size `extent`. Element i of `largest`
/// is the largest magnitude of the i-th derivative of a quantity.
pub(crate) fn step(extent: f64, largest: &[f64]) -> f64 {
    let scales = largest.windows(2).map(|pair| SHARE * (pair[0] / pair[1]));
    scales.filter(|scale| *scale > 0.0).fold(STEP * extent, f64::min)
}

/// Reports a violation only if `check` fails at three successive events: at kinks, such as wave
/// fronts, finite differences are wrong.
pub(crate) fn away_from_kinks<'a>(
    events: impl ExactSizeIterator<Item = &'a Event>,
    check: impl Fn(&Event) -> Result<(), Violation>,
) -> Result<(), Violation> {
    let stride = (events.len() / (3 * PLACES)).max(1);
    let events: Vec<&Event> = events.step_by(stride).collect();
    for three in events.chunks_exact(3) {
        let mut last = Ok(());
        for event in three {
            last = check(event).map_err(|found| Violation { allowed: None, ..found });
            if last.is_ok() {
                break;
            }
        }
        last?;
    }
    Ok(())
}

pub(crate) fn differentiation(problem: &Problem, survey: &Survey) -> Result<(), Violation> {
    let events = survey.points.iter().map(|point| &point.event);
    away_from_kinks(events, |event| differences(problem, event, &survey.largest))
}

fn differences(problem: &Problem, event: &Event, sizes: &Magnitudes) -> Result<(), Violation> {
    let Magnitudes { displacement, velocity: speed, acceleration, .. } = *sizes;
    let step = step(problem.until, &[displacement, speed, acceleration]);
    let all = problem.derivatives(&event.label, event.t);
    let largest_coordinate = greatest(event.label.iter().map(|x| x.abs()));
    for i in 0..problem.dimension() {
        let u = |t: f64| problem.motion.component(i, &event.label, t);
        let (low, mid, high) = (u(event.t - step), u(event.t), u(event.t + step));
        let name = format!("two differentiations of u_{} in time disagree", AXES[i]);
        let allowed = DIFFERENCE_TOLERANCE * speed;
        let slope = (high - low) / (2.0 * step);
        event.judge(allowed, name.clone(), (slope, all.velocity[i]), "m/s")?;
        // The second difference divides the rounding error of u by step^2.
        let known = 1e-13 * (low.abs() + mid.abs() + high.abs()) + 1e-15 * largest_coordinate;
        let rounding = known / (step * step);
        let allowed = DIFFERENCE_TOLERANCE * acceleration + rounding;
        let curvature = (high - 2.0 * mid + low) / (step * step);
        event.judge(allowed, name, (curvature, all.acceleration[i]), "m/s2")?;
    }
    stress_differences(problem, event, &all, sizes)
}

fn stress_differences(
    problem: &Problem,
    event: &Event,
    all: &Derivatives,
    sizes: &Magnitudes,
) -> Result<(), Violation> {
    let d = problem.dimension();
    let scales = [sizes.displacement, sizes.gradient, sizes.curvature];
    let exact = problem.divergence(&event.label, event.t, all);
    let (mut divergence, mut size) = (problem.hoop_force(&event.label, event.t, all), 0.0);
    for axis in 0..d {
        let step = step(problem.to[axis] - problem.from[axis], &scales);
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
        let name = format!("two computations of Div P in {} disagree", AXES[i]);
        let allowed = DIFFERENCE_TOLERANCE * sizes.divergence + 1e-9 * size;
        event.judge(allowed, name, (divergence[i], exact[i]), "N/m3")?;
    }
    Ok(())
}
