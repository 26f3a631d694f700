//! Repeatability checks: repeated sampling, a half-length step, a repeated run.

use super::course::ROUNDING;
use super::record::{Breach, RunState, difference, largest, record};
use crate::subject::{Samples, Subject, SubjectError};

pub(super) type Make<'a> = &'a dyn Fn() -> Result<Box<dyn Subject>, SubjectError>;

/// Reports a breach if a second call of `sample` changes the given samples or appends to them.
pub(super) fn sample(subject: &dyn Subject, first: &Samples) -> Option<Breach> {
    let mut second = first.clone();
    subject.sample(&mut second);
    let seen = difference(first, &second, 0.0)?;
    let wanted = "`sample` to replace the contents of the samples, and a second call to give the \
                  same samples";
    Some(Breach::new("sample", wanted, seen))
}

/// Reports a breach if the solver ignores the step length: in half a step, points must move half as
/// far. Returns `None` for a body that starts at rest.
pub(super) fn step_length(make: Make<'_>, states: &[RunState], dt: f64) -> Option<Breach> {
    let [first, second, ..] = states else { return None };
    let fastest = largest(&first.samples.velocity);
    let mut halved = Vec::new();
    let stepped = record(make().ok()?.as_mut(), 1, 0.5 * dt, &mut halved);
    if !(fastest > 0.0) || stepped.is_err() {
        return None;
    }
    let moved = |to: &Samples| -> Vec<f64> {
        let pairs = to.displacement.iter().zip(&first.samples.displacement);
        pairs.map(|(now, before)| now - before).collect()
    };
    let (whole, half) = (moved(&second.samples), moved(&halved[0].samples));
    let far = largest(&whole);
    // In a stable step, forces reduce the distance `dt * fastest` at most to a quarter.
    if !(far >= 0.25 * dt * fastest) {
        let wanted = format!("points to move by about {:e} m in a step of {dt:e} s", dt * fastest);
        return Some(Breach::new("step", wanted, format!("at most {far:e} m")));
    }
    let pairs = whole.iter().zip(&half);
    let off = pairs.map(|(whole, half)| (2.0 * half - whole).abs()).fold(0.0, f64::max);
    (!(off <= 0.5 * far)).then(|| {
        let wanted = format!("half the motion in a step of half the length, {:e} s", 0.5 * dt);
        Breach::new("step", wanted, format!("{:e} m, and {far:e} m in a full step", largest(&half)))
    })
}

/// Reports a breach if a second subject of the same problem gives a run that differs beyond
/// rounding.
pub(super) fn repeat(make: Make<'_>, states: &[RunState], dt: f64) -> Option<Breach> {
    let mut subject = make().ok()?;
    let mut again = vec![RunState::from_subject(subject.as_ref())];
    let wanted = "two subjects of the same problem to give the same results";
    if let Err(failure) = record(subject.as_mut(), states.len() - 1, dt, &mut again) {
        return Some(Breach::new("repeat", wanted, format!("the second subject fails: {failure}")));
    }
    let pairs = states.iter().zip(&again).enumerate();
    let mut off = pairs.filter_map(|(step, (a, b))| {
        Some(format!("{} after {step} steps", difference(&a.samples, &b.samples, ROUNDING)?))
    });
    Some(Breach::new("repeat", wanted, off.next()?))
}
