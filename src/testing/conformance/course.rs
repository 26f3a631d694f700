//! The course of a run: order of labels, finite numbers, counters and sums.

use super::breach::Breach;
use super::record::{RunState, columns};
use super::start::ROUNDING;
use crate::external::LevelProblem;
use crate::mpm::det_of_rows;
use crate::subject::Samples;

/// Labels, weights and sizes that change, and numbers that are none.
pub(super) fn samples(states: &[RunState]) -> Vec<Breach> {
    let first = &states[0].samples;
    let mut breaches = Vec::new();
    for (step, state) in states.iter().enumerate().skip(1) {
        let now = &state.samples;
        for ((name, before, _), (_, after, _)) in columns(first).into_iter().zip(columns(now)) {
            if before.len() != after.len() {
                let wanted = format!("{} numbers in `{name}` at all times", before.len());
                let seen = format!("{} after {step} steps", after.len());
                breaches.push(Breach::new("counts", wanted, seen));
            } else if let Some(at) = after.iter().position(|number| !number.is_finite()) {
                let wanted = "finite numbers, or a step that fails and says where";
                let seen = format!("{name}[{at}] = {} after {step} steps", after[at]);
                breaches.push(Breach::new("finite numbers", wanted, seen));
            } else if ["label", "weight"].contains(&name)
                && let Some(at) = before.iter().zip(after).position(|(a, b)| a != b)
            {
                let wanted = format!("{name}[{at}] = {:e} at all times", before[at]);
                let seen = format!("{:e} after {step} steps", after[at]);
                let about = if name == "label" { "order of labels" } else { "weights" };
                breaches.push(Breach::new(about, wanted, seen));
            }
        }
        // The first step that breaks the contract is enough.
        if !breaches.is_empty() {
            break;
        }
    }
    breaches
}

/// Work that does not grow with each step.
pub(super) fn work(states: &[RunState]) -> Option<Breach> {
    let work: Vec<u64> = states.iter().map(|state| state.counters.transfers).collect();
    let step = (1..work.len()).find(|step| work[*step] <= work[step - 1])?;
    let wanted = "a `transfers` that grows by the pairs of particle and node of each step";
    let seen =
        format!("{} after step {}, {} after step {step}", work[step - 1], step - 1, work[step]);
    Some(Breach::new("work counters", wanted, seen))
}

/// Other counters that do not count the run so far.
pub(super) fn counters(problem: &LevelProblem, states: &[RunState]) -> Vec<Breach> {
    let given = problem.particles.len() as u64;
    let volumes = problem.particles.volume.iter().zip(&problem.particles.reference_volume);
    let mut smallest = volumes.map(|(now, before)| now / before).fold(f64::INFINITY, f64::min);
    let mut breaches = Vec::new();
    for (step, state) in states.iter().enumerate() {
        let now = &state.counters;
        let before = states[step.saturating_sub(1)].counters;
        let mut note = |wanted: String, seen: String| {
            let seen = format!("{seen} after {step} steps");
            breaches.push(Breach::new("run counters", wanted, seen));
        };
        if let Some(count) = now.particles.filter(|count| *count != given) {
            note(format!("`particles` = {given}, or none"), count.to_string());
        }
        if now.crossings < before.crossings {
            let wanted = "a count of `crossings` so far, which never falls".to_owned();
            note(wanted, format!("{:?} and then {:?}", before.crossings, now.crossings));
        }
        if let Some(count) = now.left_domain.filter(|count| *count > given) {
            note(format!("a `left_domain` of at most {given}"), count.to_string());
        }
        if !now.min_j.is_nan() {
            smallest = smallest.min(smallest_j(&state.samples)).min(before.min_j);
            if !(0.0 < now.min_j && now.min_j <= smallest * (1.0 + ROUNDING)) {
                let wanted = format!("0 < `min_j` <= {smallest:e}, the smallest det F so far");
                note(wanted, format!("{:e}", now.min_j));
            }
        }
        // The first step that breaks the contract is enough.
        if !breaches.is_empty() {
            break;
        }
    }
    breaches
}

/// A mass of all that is not that of the particles.
pub(super) fn totals(problem: &LevelProblem, states: &[RunState]) -> Option<Breach> {
    let mass: f64 = problem.particles.mass.iter().sum();
    let is_off = |seen: f64| !((seen - mass).abs() <= ROUNDING * mass);
    let seen = states.iter().find_map(|state| state.totals.map(|totals| totals.mass));
    let seen = seen.filter(|seen| is_off(*seen))?;
    Some(Breach::new(
        "totals",
        format!("`mass` = {mass:e} kg, or no totals"),
        format!("{seen:e} kg"),
    ))
}

/// The smallest det F of the points; infinite where F is not given.
fn smallest_j(samples: &Samples) -> f64 {
    let d = samples.dimension;
    let all = samples.deformation_gradient.chunks_exact(d * d);
    all.map(|f| det_of_rows(d, f)).fold(f64::INFINITY, f64::min)
}
