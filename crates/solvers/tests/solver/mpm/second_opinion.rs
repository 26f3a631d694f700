//! Compares the solver with an independent implementation, `tests/second_opinion`: errors and
//! fields on some levels of the suites must agree to 1e-9.

use mpm_judge::verify::{Clock, Quantity};
use mpm_solvers::mpm::input::MpmMethod;
use mpm_solvers::mpm::{
    BasisName, FrameName, MassName, SchemeName, TransferChoice, TransferName, VolumeName,
};
use mpm_subject::{Failure, Precision, Samples, Start, Subject};
use mpm_suites::study;
use mpm_suites::suite::{ConvergencePlan, Method};
use rstest::rstest;
use std::fs;
use std::path::PathBuf;

/// Maximum difference, relative to the error or to the field.
const TOLERANCE: f64 = 1e-9;

/// Relative rounding error of a position or of F in a run. Errors and strains are small differences
/// of these numbers.
const ROUNDING: f64 = 1e-14;

/// A level of a case, with the results of the independent implementation.
struct Level {
    method: Method,
    cells: u64,
    steps: u64,
    end: End,
}

/// End of a run, with its results.
enum End {
    /// A particle is inverted in this step.
    Inverted(u64),
    /// `figures` are the rms error at the end (m), the largest error of all instants, and the
    /// largest rms of each field. `particles` are fields of particles at the end, by the numbers of
    /// the particles.
    Sound { figures: Vec<f64>, particles: Vec<(usize, Vec<f64>)> },
}

fn named<T: Copy>(all: &[T], name: impl Fn(T) -> &'static str, wanted: &str) -> T {
    let found = all.iter().copied().find(|member| name(*member) == wanted);
    found.unwrap_or_else(|| panic!("`{wanted}` is not known"))
}

fn method(words: &[&str]) -> Method {
    let [basis, scheme, start] = words else { panic!("{words:?}") };
    let starts = [Start::AtZero, Start::HalfStepBack];
    Method::Mpm(MpmMethod {
        basis: named(BasisName::ALL, BasisName::name, basis),
        transfer: TransferChoice::Named(TransferName::Flip),
        scheme: named(SchemeName::ALL, SchemeName::name, scheme),
        start: named(&starts, Start::name, start),
        mass: MassName::Lumped,
        frame: FrameName::Updated,
        volume: VolumeName::Particle,
        precision: Precision::Double,
    })
}

/// Reads the levels in a file, each with the method of its case.
fn read(text: &str) -> Vec<Level> {
    let numbers = |words: &[&str]| -> Vec<f64> {
        words.iter().map(|word| word.parse().expect("a number")).collect()
    };
    let count = |word: &str| -> u64 { word.parse().expect("a count") };
    let (mut levels, mut of_case): (Vec<Level>, _) = (Vec::new(), None);
    for line in text.lines().filter(|line| !line.starts_with('#')) {
        let words: Vec<&str> = line.split(' ').collect();
        match (&words[..], levels.last_mut().map(|level| &mut level.end)) {
            (["case", names @ ..], _) => of_case = Some(method(names)),
            (["level", cells, steps, found @ ..], _) => {
                let end = match found {
                    ["inverted", step] => End::Inverted(count(step)),
                    _ => End::Sound { figures: numbers(found), particles: Vec::new() },
                };
                let (method, cells, steps) = (of_case.expect("a case"), count(cells), count(steps));
                levels.push(Level { method, cells, steps, end });
            }
            ([number, fields @ ..], Some(End::Sound { particles, .. })) => {
                particles.push((count(number) as usize, numbers(fields)));
            }
            _ => panic!("unexpected: {line}"),
        }
    }
    levels
}

/// Returns displacement, velocity, stress and F - I of all particles. The last one is empty if no
/// part of the solver uses F.
fn fields(samples: &Samples) -> [Vec<f64>; 4] {
    let Samples { displacement, velocity, stress, deformation_gradient, .. } = samples;
    let d = samples.dimension;
    let identity = |k: usize| if k / d % d == k % d { 1.0 } else { 0.0 };
    let strain = deformation_gradient.iter().enumerate().map(|(k, f)| f - identity(k));
    [displacement.clone(), velocity.clone(), stress.clone(), strain.collect()]
}

/// Results of a run of the solver, as in [`End::Sound`], but with the fields of all particles.
struct Found {
    figures: [f64; 6],
    fields: [Vec<f64>; 4],
}

/// Runs `subject` until its end, or until a step fails.
fn run(
    plan: &ConvergencePlan,
    subject: &mut dyn Subject,
    clock: &Clock,
) -> Result<Found, (u64, Failure)> {
    let truth = plan.exact.as_ref().expect("an exact solution");
    let (mut samples, mut figures) = (Samples::default(), [0.0; 6]);
    for step in 1..=clock.steps {
        subject.step(clock.dt()).map_err(|failure| (step, failure))?;
        if clock.is_instant(step) {
            subject.sample(&mut samples);
            let errors = Quantity::Displacement.errors(&samples, truth, clock.time(step));
            figures[0] = errors.rms;
            figures[1] = figures[0].max(figures[1]);
            for (largest, field) in figures[2..].iter_mut().zip(fields(&samples)) {
                let squares: f64 = field.iter().map(|number| number * number).sum();
                *largest = largest.max((squares / samples.len() as f64).sqrt());
            }
        }
    }
    Ok(Found { figures, fields: fields(&samples) })
}

/// Asserts that `ours` and `theirs` differ by at most `TOLERANCE` times `size`, or by `rounding`.
fn hold(what: &str, ours: f64, theirs: f64, size: f64, rounding: f64) {
    let difference = (ours - theirs).abs();
    let sound = difference <= TOLERANCE * size || difference <= rounding;
    assert!(sound, "{what}: {ours:e}, and {theirs:e} by the second opinion; size {size:e}");
}

/// Compares the run of a level with the results of the independent implementation.
fn hold_level(plan: &ConvergencePlan, level: &Level) {
    let Level { method, cells, steps, end } = level;
    let planned = plan.refine.levels.iter().find(|level| level.cells == *cells);
    let planned = *planned.expect("a level of the suite");
    let mut clocks = plan.cases.iter().filter_map(|case| case.clock(plan, planned.dt));
    let clock = clocks.find(|clock| clock.steps == *steps).expect("steps of the suite");
    let mut subject = study::subject(plan, *method, planned).expect("a subject");
    let what = format!("{method:?} on {cells} cells");
    match (end, run(plan, subject.as_mut(), &clock)) {
        (End::Inverted(step), Err((ours, Failure::Inverted { .. }))) => {
            assert_eq!(ours, *step, "{what}: step of the inversion");
        }
        (End::Sound { figures, particles }, Ok(Found { figures: ours, fields })) => {
            let [_, error, sizes @ ..] = &figures[..] else { panic!("{what}: no figures") };
            for k in 0..2 {
                let what = format!("{what}: error");
                hold(&what, ours[k], figures[k], *error, ROUNDING * sizes[0]);
            }
            let n = fields[0].len() / plan.scene.dimension();
            let mut first = 0;
            for (k, field) in fields.iter().enumerate().filter(|(_, field)| !field.is_empty()) {
                let (each, rounding) = (field.len() / n, if k == 3 { ROUNDING } else { 0.0 });
                hold(&format!("{what}: field {k}"), ours[2 + k], sizes[k], sizes[k], rounding);
                for (p, theirs) in particles {
                    let what = format!("{what}: field {k} of particle {p}");
                    for j in 0..each {
                        hold(&what, field[p * each + j], theirs[first + j], sizes[k], rounding);
                    }
                }
                first += each;
            }
        }
        (_, found) => panic!("{what}: {:?}", found.err()),
    }
}

#[rstest]
fn independent_implementation_agrees(#[files("../../tests/second_opinion/*.txt")] file: PathBuf) {
    let name = file.file_stem().and_then(|stem| stem.to_str()).expect("a name");
    let suite = crate::common::suite(name);
    let plan = suite.convergence().expect("a convergence study");
    let levels = read(&fs::read_to_string(&file).expect("a file"));
    assert!(levels.len() >= 6, "linear, contiguous GIMP and cubic functions, USL and MUSL");
    for level in &levels {
        hold_level(plan, level);
    }
}
