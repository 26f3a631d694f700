//! The rounding error of the built-in solver in single precision, compared with its prediction.
//!
//! ```console
//! cargo test --test it rounding_errors_of_suites -- --ignored --nocapture
//! ```
//!
//! The first MPM case of each suite with an exact motion of one body runs in double and in single
//! precision. It runs on the finest usual level on which no particle changes its cell and
//! displacements are large enough. The measured error is the root mean square over particles of the
//! difference of their displacements at the end. `docs/single-precision.md` derives the prediction
//! and contains the table.

use crate::common::built_in_suite;
use mpm_verify::embedded;
use mpm_verify::prelude::{Extent, Suite};
use mpm_verify::study::{TimeStep, subject, time_steps};
use mpm_verify::subject::{Precision, Samples};
use mpm_verify::suite::{Against, ConvergencePlan, Method};
use mpm_verify::verify::{NormName, rounding_bound, single_precision_spacing};
use rayon::prelude::*;

/// Maximum ratio of measured and predicted error, in both directions. The predicted error is a
/// seventh of its upper bound.
const FACTOR: f64 = 7.0;

/// Minimum RMS displacement, divided by the upper bound of its rounding error. For smaller
/// displacements, steps are too short to be represented, and the error has no lower bound.
const LEAST_SIZE: f64 = 20.0;

/// Maximum number of particle steps of a level. The test then ends within minutes.
const MOST_WORK: f64 = 3e5;

/// State at the end of a run.
struct End {
    samples: Samples,
    /// Rounding error (m) of the initial position of each particle along each axis.
    initial: Vec<f64>,
    /// Path of each particle along each axis, particle by particle.
    paths: Vec<Path>,
    crossings: u64,
}

#[derive(Clone, Default)]
struct Path {
    /// Largest absolute coordinate (m) on the path.
    reach: f64,
    /// Length of the path (m).
    length: f64,
}

fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0), |(sum, count), x| (sum + x * x, count + 1));
    (sum / f64::from(count)).sqrt()
}

fn run(plan: &ConvergencePlan, method: Method, step: &TimeStep) -> Option<End> {
    let mut subject = subject(plan, method, step.level).ok()?;
    let mut samples = Samples::default();
    subject.sample(&mut samples);
    let mut last = samples.displacement.clone();
    let start = samples.label.iter().zip(&last).map(|(label, u)| label + u);
    let initial = start.map(|x| x - f64::from(x as f32)).collect();
    let mut paths = vec![Path::default(); last.len()];
    for _ in 0..step.clock.steps {
        subject.step(step.clock.dt()).ok()?;
        subject.sample(&mut samples);
        let now = samples.label.iter().zip(&samples.displacement);
        for ((path, last), (label, u)) in paths.iter_mut().zip(&last).zip(now) {
            path.reach = path.reach.max((label + u).abs());
            path.length += (u - last).abs();
        }
        last.clone_from(&samples.displacement);
    }
    Some(End { samples, initial, paths, crossings: subject.counters().crossings.unwrap_or(0) })
}

/// Returns the upper bound of the RMS rounding error (m) of a run of `steps` steps. On each axis,
/// it is the rounding error of the initial positions, and of each step by at most half a spacing
/// and at most its own length.
fn upper_end(steps: u64, double: &End, d: usize) -> f64 {
    let on_axis = |axis: usize| {
        let initial = rms(double.initial.iter().skip(axis).step_by(d).copied());
        let paths = || double.paths.iter().skip(axis).step_by(d);
        let reach = paths().fold(0.0_f64, |most, path| most.max(path.reach));
        let spacing = single_precision_spacing(reach).unwrap_or(0.0);
        let bound = rounding_bound(steps, spacing, NormName::Rms);
        initial + bound.min(rms(paths().map(|path| path.length)))
    };
    (0..d).map(|axis| on_axis(axis) * on_axis(axis)).sum::<f64>().sqrt()
}

/// Compares the errors on the finest level of a suite without cell changes, and prints them as a
/// row of the table. Returns whether the measured error lies within the predicted range.
fn is_within(suite: &Suite) -> Option<bool> {
    let plan = suite.convergence()?;
    if plan.exact.as_ref().is_none_or(|exact| exact.at_rest) || plan.scene.bodies.len() > 1 {
        return None;
    }
    let case = plan
        .cases
        .iter()
        .find(|case| case.against == Against::Exact && matches!(case.method, Method::Mpm(_)))?;
    let mut single = case.method;
    if let Method::Mpm(method) = &mut single {
        method.precision = Precision::Single;
    }
    let steps = time_steps(suite, Extent::Usual);
    let mut all: Vec<&TimeStep> = steps.iter().filter(|step| step.case == case.name).collect();
    all.reverse();
    let d = plan.scene.dimension();
    let work = |step: &TimeStep| {
        let length: f64 = plan
            .scene
            .to
            .iter()
            .zip(&plan.scene.from)
            .map(|(a, b)| (a - b).abs() / step.level.h)
            .product();
        length * step.level.ppc.unwrap_or(1) as f64 * step.clock.steps as f64
    };
    all.iter().filter(|step| work(step) <= MOST_WORK).find_map(|step| {
        let double = run(plan, case.method, step)?;
        let upper = upper_end(step.clock.steps, &double, d);
        let size = rms(double.samples.displacement.iter().copied()) * (d as f64).sqrt();
        if double.crossings > 0 || !(size > LEAST_SIZE * upper) {
            return None;
        }
        let end = run(plan, single, step)?;
        if end.crossings > 0 {
            return None;
        }
        let pairs = double.samples.displacement.iter().zip(&end.samples.displacement);
        let measured = rms(pairs.map(|(a, b)| a - b)) * (d as f64).sqrt();
        let predicted = upper / FACTOR;
        let ratio = measured / predicted;
        println!(
            "| `{}` | {} | {} | {} | {predicted:.1e} | {measured:.1e} | {ratio:.2} |",
            suite.name, case.name, step.level.cells, step.clock.steps
        );
        Some((1.0 / FACTOR..=FACTOR).contains(&ratio))
    })
}

#[test]
#[ignore = "runs many suites twice: a few minutes"]
fn rounding_errors_of_suites_lie_within_the_predicted_range() {
    let names: Vec<&str> = embedded::names().collect();
    let load = |name: &&str| Suite::load(&embedded::source(name)?.ok()?).ok();
    let rows = names.par_iter().filter_map(load).filter_map(|suite| is_within(&suite));
    let rows: Vec<bool> = rows.collect();
    let (within, count) = (rows.iter().filter(|within| **within).count(), rows.len());
    assert!(count >= 20 && within * 20 >= count * 19, "{within} of {count}");
}

/// State of the particles and nodes of a bar after three steps.
#[test]
fn state_is_rounded_only_if_single_precision_is_stated() {
    let suite = built_in_suite("single-precision-bar");
    let plan = suite.convergence().expect("a convergence study");
    let is_rounded = |index: usize| {
        let case = &plan.cases[index];
        let mut subject = subject(plan, case.method, plan.refine.levels[1]).expect("a solver");
        for _ in 0..3 {
            subject.step(1e-3).expect("a step");
        }
        let fields = subject.fields();
        let columns = fields.iter().flat_map(|body| body.of_particles.iter().chain(&body.of_nodes));
        let names = ["x", "v", "sigma", "F", "V", "velocity", "force"];
        let values: Vec<f64> = columns
            .filter(|column| names.contains(&column.name.as_str()))
            .flat_map(|column| column.numbers.clone())
            .collect();
        assert!(values.len() > 100, "{}", values.len());
        values.iter().all(|value| f64::from(*value as f32).to_bits() == value.to_bits())
    };
    assert!(plan.cases[1].method.is_single_precision());
    assert_eq!([is_rounded(0), is_rounded(1)], [false, true]);
}
