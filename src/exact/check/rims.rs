//! The rims of a body that is no box: free of traction, P n = 0.

use super::pointwise::{AXES, Event, POINTS, stress};
use crate::exact::linearised::share;
use crate::exact::problem::Problem;
use crate::exact::random::Random;
use crate::exact::violation::Violation;

/// Holds the traction on every rim against zero, and returns the largest that is left, relative to
/// the stress.
pub(crate) fn free(problem: &Problem) -> Result<f64, Violation> {
    let Some(outline) = &problem.outline else { return Ok(0.0) };
    let size = stress(problem);
    let (allowed, mut left) = (problem.law_tolerance() * size, 0.0);
    let mut random = Random::new(7);
    for (number, rim) in outline.rims().into_iter().enumerate() {
        for _ in 0..POINTS {
            let (label, normal) = outline.on_rim(number, &mut random);
            let event = Event { label, t: problem.moment(&mut random) };
            let now = problem.derivatives(&event.label, event.t);
            let piola = problem.piola(&event.label, event.t, &now);
            for i in 0..problem.dimension() {
                let traction: f64 = piola[i].iter().zip(&normal).map(|(p, n)| p * n).sum();
                let name = format!("boundary condition: {rim} is free, traction in {}", AXES[i]);
                event.judge(allowed, name, (0.0, traction), "Pa")?;
                left = f64::max(left, share(traction, size));
            }
        }
    }
    Ok(left)
}
