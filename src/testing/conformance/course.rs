//! Checks of the initial state, of the later states, and of the repeatability of a run.

use super::record::{Breach, RunState, columns, difference, largest, record};
use crate::external::LevelProblem;
use crate::mpm::det_of_rows;
use crate::subject::{Samples, Subject, SubjectError};

/// Maximum relative rounding error of numbers passed to a solver.
const ROUNDING: f64 = 1e-9;

/// Maximum relative difference between the body volume and the sum of all sample weights. The
/// tolerance is wide, because solvers resolve the edge of the body differently.
const RIM: f64 = 0.1;

pub(super) fn counts(problem: &LevelProblem, samples: &Samples) -> Vec<Breach> {
    let (d, n) = (problem.dimension, samples.len());
    if samples.dimension != d {
        let wanted = format!("`dimension` = {d}, as in the problem");
        return vec![Breach::new("dimension", wanted, samples.dimension.to_string())];
    }
    if n == 0 {
        let wanted = "at least one point, and a weight for each point";
        return vec![Breach::new("counts", wanted, "`weight` is empty")];
    }
    let mut breaches = Vec::new();
    for (name, column, width) in columns(samples) {
        let may_be_empty =
            ["mass", "stress", "deformation_gradient", "temperature"].contains(&name);
        if column.len() != n * width && !(may_be_empty && column.is_empty()) {
            let or_none = if may_be_empty { " or none" } else { "" };
            let wanted = format!("{} numbers in `{name}` ({width} per point){or_none}", n * width);
            breaches.push(Breach::new("counts", wanted, column.len().to_string()));
        } else if let Some(at) = column.iter().position(|number| !number.is_finite()) {
            let seen = format!("{name}[{at}] = {}", column[at]);
            breaches.push(Breach::new("finite numbers", "finite numbers at the start", seen));
        }
    }
    breaches
}

pub(super) fn start(problem: &LevelProblem, samples: &Samples) -> Vec<Breach> {
    let mut breaches = Vec::from_iter(weights(problem, samples));
    breaches.extend(labels(problem, samples));
    if is_of_particles(problem, samples) {
        breaches.extend(motion(problem, samples));
    }
    breaches
}

/// Whether the labels are the reference positions of the particles in the same order.
fn is_of_particles(problem: &LevelProblem, samples: &Samples) -> bool {
    let (wanted, near) = (&problem.particles.reference_position, ROUNDING * problem.grid.h);
    let mut pairs = wanted.iter().zip(&samples.label);
    wanted.len() == samples.label.len() && pairs.all(|(a, b)| (a - b).abs() <= near)
}

fn labels(problem: &LevelProblem, samples: &Samples) -> Option<Breach> {
    let (grid, d) = (&problem.grid, problem.dimension);
    let near = ROUNDING * grid.h;
    let is_outside = |(k, x): (usize, &f64)| {
        let (low, axis) = (grid.origin[k % d], k % d);
        let high = low + grid.h * grid.cells[axis] as f64;
        !(low - near <= *x && *x <= high + near)
    };
    let at = samples.label.iter().enumerate().position(is_outside)?;
    let wanted = "labels (reference positions) inside the grid of the problem";
    Some(Breach::new("labels", wanted, format!("label[{at}] = {:e}", samples.label[at])))
}

fn weights(problem: &LevelProblem, samples: &Samples) -> Option<Breach> {
    let given = &problem.particles.reference_volume;
    if let Some(at) = samples.weight.iter().position(|weight| !(*weight > 0.0)) {
        let seen = format!("weight[{at}] = {:e}", samples.weight[at]);
        return Some(Breach::new("weights", "positive weights (reference volumes)", seen));
    }
    if is_of_particles(problem, samples) {
        let mut pairs = given.iter().zip(&samples.weight);
        let at = pairs.position(|(a, b)| !((a - b).abs() <= ROUNDING * a))?;
        let wanted = format!("weight[{at}] = {:e}, the reference volume", given[at]);
        return Some(Breach::new("weights", wanted, format!("{:e}", samples.weight[at])));
    }
    let (volume, sum): (f64, f64) = (given.iter().sum(), samples.weight.iter().sum());
    let wanted = format!("weights that sum to the volume of the body, {volume:e} m^D");
    let is_near = (sum - volume).abs() <= RIM * volume;
    (!is_near).then(|| Breach::new("weights", wanted, format!("{sum:e} m^D")))
}

/// Returns breaches due to initial displacements and velocities other than those of the particles.
/// Leapfrog solvers may report velocities half a step early, so half the largest one is allowed.
fn motion(problem: &LevelProblem, samples: &Samples) -> Vec<Breach> {
    let particles = &problem.particles;
    let mut breaches = Vec::new();
    let moved = particles.position.iter().zip(&particles.reference_position);
    let moved: Vec<f64> = moved.map(|(x, label)| x - label).collect();
    let fastest = largest(&particles.velocity);
    for (name, wanted, seen, most) in [
        ("displacement", &moved, &samples.displacement, ROUNDING * problem.grid.h),
        ("velocity", &particles.velocity, &samples.velocity, 0.5 * fastest),
    ] {
        if name == "velocity" && fastest == 0.0 {
            continue;
        }
        let off = wanted.iter().zip(seen).position(|(a, b)| !((a - b).abs() <= most));
        breaches.extend(off.map(|at| {
            let wanted = format!("{name}[{at}] = {:e} at the start", wanted[at]);
            Breach::new("initial state", wanted, format!("{:e}", seen[at]))
        }));
    }
    breaches
}

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
                let wanted = "finite numbers, or a step that returns an error with the location";
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
        if !breaches.is_empty() {
            break;
        }
    }
    breaches
}

pub(super) fn work(states: &[RunState]) -> Option<Breach> {
    let work: Vec<u64> = states.iter().map(|state| state.counters.transfers).collect();
    let step = (1..work.len()).find(|step| work[*step] <= work[step - 1])?;
    let wanted = "`transfers` to increase in each step by the number of particle-node pairs";
    let seen =
        format!("{} after step {}, {} after step {step}", work[step - 1], step - 1, work[step]);
    Some(Breach::new("work counters", wanted, seen))
}

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
            let wanted =
                "`crossings` to count all crossings so far, and never to decrease".to_owned();
            note(wanted, format!("{:?}, then {:?}", before.crossings, now.crossings));
        }
        if let Some(count) = now.left_domain.filter(|count| *count > given) {
            note(format!("`left_domain` of at most {given}"), count.to_string());
        }
        if !now.min_j.is_nan() {
            let d = state.samples.dimension;
            let f = state.samples.deformation_gradient.chunks_exact(d * d);
            smallest = f.map(|f| det_of_rows(d, f)).fold(smallest, f64::min).min(before.min_j);
            if !(0.0 < now.min_j && now.min_j <= smallest * (1.0 + ROUNDING)) {
                let wanted = format!("0 < `min_j` <= {smallest:e}, the smallest det F so far");
                note(wanted, format!("{:e}", now.min_j));
            }
        }
        if !breaches.is_empty() {
            break;
        }
    }
    breaches
}

pub(super) fn totals(problem: &LevelProblem, states: &[RunState]) -> Option<Breach> {
    let mass: f64 = problem.particles.mass.iter().sum();
    let is_off = |seen: f64| !((seen - mass).abs() <= ROUNDING * mass);
    let seen = states.iter().find_map(|state| state.totals.map(|totals| totals.mass));
    let seen = seen.filter(|seen| is_off(*seen))?;
    let wanted = format!("`mass` = {mass:e} kg, or no totals");
    Some(Breach::new("totals", wanted, format!("{seen:e} kg")))
}

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

/// Reports a breach if points do not move half as far in half a step; `None` for a body at rest.
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

/// Reports a breach if a second subject of the problem gives another run, up to rounding.
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
