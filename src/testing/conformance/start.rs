//! The state before the first step.

use super::breach::Breach;
use super::record::{columns, largest};
use crate::external::LevelProblem;
use crate::subject::Samples;

/// Share by which numbers that are handed over may be off.
pub(super) const ROUNDING: f64 = 1e-9;

/// Share by which the weights of places of the subject's own may miss the volume of the body, whose
/// rim they may see otherwise.
const RIM: f64 = 0.1;

/// Columns of the wrong size, and numbers that are none.
pub(super) fn counts(problem: &LevelProblem, samples: &Samples) -> Vec<Breach> {
    let (d, n) = (problem.dimension, samples.len());
    if samples.dimension != d {
        let wanted = format!("`dimension` = {d}, that of the problem");
        return vec![Breach::new("dimension", wanted, samples.dimension.to_string())];
    }
    if n == 0 {
        let wanted = "at least one point, each with its weight";
        return vec![Breach::new("counts", wanted, "no number in `weight`")];
    }
    let mut breaches = Vec::new();
    for (name, column, width) in columns(samples) {
        let may_be_empty = ["stress", "deformation_gradient", "temperature"].contains(&name);
        if column.len() != n * width && !(may_be_empty && column.is_empty()) {
            let or_none = if may_be_empty { ", or none" } else { "" };
            let wanted = format!("{} numbers in `{name}`, {width} a point{or_none}", n * width);
            breaches.push(Breach::new("counts", wanted, column.len().to_string()));
        } else if let Some(at) = column.iter().position(|number| !number.is_finite()) {
            let seen = format!("{name}[{at}] = {}", column[at]);
            breaches.push(Breach::new("finite numbers", "finite numbers at the start", seen));
        }
    }
    breaches
}

/// Places, weights and motion at the start.
pub(super) fn start(problem: &LevelProblem, samples: &Samples) -> Vec<Breach> {
    let mut breaches = weights(problem, samples);
    breaches.extend(labels(problem, samples));
    if is_of_particles(problem, samples) {
        breaches.extend(motion(problem, samples));
    }
    breaches
}

/// Whether the labels are the reference positions of the particles, in their order.
fn is_of_particles(problem: &LevelProblem, samples: &Samples) -> bool {
    let (wanted, near) = (&problem.particles.reference_position, ROUNDING * problem.grid.h);
    let mut pairs = wanted.iter().zip(&samples.label);
    wanted.len() == samples.label.len() && pairs.all(|(a, b)| (a - b).abs() <= near)
}

/// Labels outside of the grid.
fn labels(problem: &LevelProblem, samples: &Samples) -> Option<Breach> {
    let (grid, d) = (&problem.grid, problem.dimension);
    let near = ROUNDING * grid.h;
    let is_outside = |(k, x): (usize, &f64)| {
        let (low, axis) = (grid.origin[k % d], k % d);
        let high = low + grid.h * grid.cells[axis] as f64;
        !(low - near <= *x && *x <= high + near)
    };
    let at = samples.label.iter().enumerate().position(is_outside)?;
    let wanted = "reference positions X on the grid of the problem";
    Some(Breach::new("labels", wanted, format!("label[{at}] = {:e}", samples.label[at])))
}

fn weights(problem: &LevelProblem, samples: &Samples) -> Vec<Breach> {
    let given = &problem.particles.reference_volume;
    if let Some(at) = samples.weight.iter().position(|weight| !(*weight > 0.0)) {
        let seen = format!("weight[{at}] = {:e}", samples.weight[at]);
        return vec![Breach::new("weights", "weights above zero: reference volumes", seen)];
    }
    if is_of_particles(problem, samples) {
        let pairs = given.iter().zip(&samples.weight);
        let at = pairs.clone().position(|(a, b)| !((a - b).abs() <= ROUNDING * a));
        return Vec::from_iter(at.map(|at| {
            let wanted = format!("weight[{at}] = {:e}, the reference volume", given[at]);
            Breach::new("weights", wanted, format!("{:e}", samples.weight[at]))
        }));
    }
    let (volume, sum): (f64, f64) = (given.iter().sum(), samples.weight.iter().sum());
    if (sum - volume).abs() <= RIM * volume {
        return Vec::new();
    }
    let wanted = format!("weights that sum to the volume of the body, {volume:e} m^D");
    vec![Breach::new("weights", wanted, format!("{sum:e} m^D"))]
}

/// Displacements and velocities that are not those of the particles. Velocities may stand half a
/// step before the start, which changes them by less than half of the largest.
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
