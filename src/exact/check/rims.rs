//! The rims of a body that is no box: free of traction, P n = 0.

use super::event::{AXES, Event};
use super::survey::Survey;
use crate::exact::linearised::share;
use crate::exact::problem::Problem;
use crate::exact::random::Random;
use crate::exact::violation::{LargestViolation, Violation};

/// Holds the traction on every rim against zero, and returns the largest that is left, relative to
/// the stress.
pub(crate) fn free(problem: &Problem, survey: &Survey) -> Result<f64, Violation> {
    let Some(outline) = &problem.outline else { return Ok(0.0) };
    let size = survey.largest.stress;
    let (allowed, mut left) = (problem.law_tolerance() * size, 0.0);
    let mut random = Random::new(7);
    for (number, rim) in outline.rims().into_iter().enumerate() {
        let mut found = LargestViolation::default();
        for sample in 0..survey.face_events {
            let (label, normal) = outline.on_rim(number, &mut random);
            let t = (sample as f64 + random.unit()) / survey.face_events as f64 * problem.until;
            let event = Event { label, t: problem.loaded(t) };
            let now = problem.derivatives(&event.label, event.t);
            let piola = problem.piola(&event.label, event.t, &now);
            for i in 0..problem.dimension() {
                let traction: f64 = piola[i].iter().zip(&normal).map(|(p, n)| p * n).sum();
                let name = format!("boundary condition: {rim} is free, traction in {}", AXES[i]);
                found.add(event.judge(allowed, name, (0.0, traction), "Pa"));
                left = f64::max(left, share(traction, size));
            }
        }
        found.into_result()?;
    }
    Ok(left)
}
