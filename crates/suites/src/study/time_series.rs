//! Writes a run as files for ParaView: particles and grid nodes at several instants, and a list of
//! these files. An animated picture shows the particles without ParaView.

use super::particle_motion::ParticleMotion;
use crate::exact::Truth;
use crate::subject::{BodyFields, Samples, StateField, Subject, SubjectError};
use crate::verify::{Quantity, is_instant};
use crate::vtk;
use std::io;
use thiserror::Error;

/// Maximum number of instants of a series, in addition to its start.
const INSTANTS: u64 = 20;

pub(crate) struct ShownRun<'a> {
    pub(crate) name: String,
    pub(crate) subject: Box<dyn Subject>,
    /// Lengths of the steps (s), used cyclically.
    pub(crate) dt: Vec<f64>,
    pub(crate) steps: u64,
    pub(crate) truth: Option<&'a dyn Truth>,
}

/// A file of a time series.
#[derive(Debug, Clone, PartialEq)]
pub struct SeriesFile {
    /// Path relative to the folder of all series. The file name ends in `.vtu` (particles), `.vti`
    /// (grid nodes), `.svg` (animated particles) or `.pvd` (list of all files).
    pub path: String,
    /// Contents of the file.
    pub bytes: Vec<u8>,
}

/// Reason why the time series of a case was not written completely.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SeriesError {
    /// The case has no run to write.
    #[error(transparent)]
    NoRun(#[from] SubjectError),
    /// A file could not be written.
    #[error("{path}: {error}")]
    Write {
        /// Path relative to the folder of all series.
        path: String,
        /// Error of the operating system.
        error: io::Error,
    },
}

impl From<&str> for SeriesError {
    fn from(reason: &str) -> Self {
        Self::NoRun(reason.into())
    }
}

/// Runs `run` and writes up to [`INSTANTS`] states, a picture, and last the list `NAME.RUN.pvd`.
pub(super) fn time_series(
    name: &str,
    run: ShownRun<'_>,
    write: &mut dyn FnMut(&SeriesFile) -> io::Result<()>,
) -> Result<(), SeriesError> {
    let ShownRun { name: level, mut subject, dt, steps, truth } = run;
    let name = format!("{name}.{}", file_name(&level));
    let folder = name.rsplit('/').next().unwrap_or(&name).to_owned();
    let mut listed: Vec<(f64, usize, String)> = Vec::new();
    let mut motion = ParticleMotion::default();
    let mut write = |path: String, bytes: Vec<u8>| {
        let file = SeriesFile { path, bytes };
        write(&file).map_err(|error| SeriesError::Write { path: file.path, error })
    };
    let mut frame = |subject: &dyn Subject, number: u64, t: f64| -> Result<(), SeriesError> {
        let written = files(subject, truth, t, &mut motion);
        for (part, (file, bytes)) in written.into_iter().enumerate() {
            let file = file.replace('#', &format!("{number:04}"));
            write(format!("{name}/{file}"), bytes)?;
            listed.push((t, part, format!("{folder}/{file}")));
        }
        Ok(())
    };
    frame(subject.as_ref(), 0, 0.0)?;
    let equal = dt.len() == 1;
    let (mut lengths, mut t, mut number) = (dt.iter().cycle(), 0.0, 0);
    for step in 1..=steps {
        let dt = *lengths.next().unwrap_or(&f64::NAN);
        let failed = subject.step(dt).is_err();
        // If steps are equal, the time is computed without accumulated rounding errors.
        t = if equal { dt * step as f64 } else { t + dt };
        if failed || is_instant(step, steps, INSTANTS) {
            number += 1;
            frame(subject.as_ref(), number, t)?;
        }
        if failed {
            break;
        }
    }
    if let Some(svg) = motion.to_svg(&name) {
        write(format!("{name}.svg"), svg.into_bytes())?;
    }
    let list = vtk::series(&listed);
    write(format!("{name}.pvd"), list.into_bytes())
}

/// Creates the files of one instant. Their names contain `#` in place of its number.
fn files(
    subject: &dyn Subject,
    truth: Option<&dyn Truth>,
    t: f64,
    motion: &mut ParticleMotion,
) -> Vec<(String, Vec<u8>)> {
    let mut samples = Samples::default();
    subject.sample(&mut samples);
    let d = samples.dimension;
    let position: Vec<f64> =
        samples.label.iter().zip(&samples.displacement).map(|(x, u)| x + u).collect();
    let common = common_fields(&samples, truth, t);
    let bodies = match subject.fields() {
        bodies if bodies.is_empty() => vec![BodyFields {
            particles: samples.len(),
            of_particles: sampled_fields(&samples),
            ..BodyFields::default()
        }],
        bodies => bodies,
    };
    motion.add(d, &position, &bodies);
    let (several, mut first, mut files) = (bodies.len() > 1, 0, Vec::new());
    for (number, body) in bodies.into_iter().enumerate() {
        let behind = first + body.particles;
        let own = common.iter().map(|field| part(field, first..behind));
        let fields = vtk::ranked(d, own.chain(body.of_particles).collect());
        let tail = if several { format!(".body-{}", number + 1) } else { String::new() };
        let points = vtk::points(d, &position[first * d..behind * d], &fields);
        files.push((format!("particles-#{tail}.vtu"), points));
        if !body.of_nodes.is_empty() {
            let fields = vtk::ranked(d, body.of_nodes);
            let grid = vtk::grid(&body.origin, body.h, &body.counts, &fields);
            files.push((format!("grid-#{tail}.vti"), grid));
        }
        first = behind;
    }
    files
}

/// Returns the fields that solvers do not store: the displacement and the errors.
fn common_fields(samples: &Samples, truth: Option<&dyn Truth>, t: f64) -> Vec<StateField> {
    let components = samples.dimension;
    let u = StateField { name: "u".to_owned(), components, numbers: samples.displacement.clone() };
    // The components of the stress have no arrays of their own, because the stress has one.
    let is_own = |of: &Quantity| !of.is_sum() && (!of.is_stress() || *of == Quantity::Stress);
    let fields = Quantity::ALL.iter().filter(|of| is_own(of));
    let error = |quantity: &Quantity| {
        let (components, numbers) = quantity.differences(samples, truth?, t)?;
        Some(StateField { name: format!("error of {}", quantity.words()), components, numbers })
    };
    let invariant = |(name, of): (&str, Quantity)| {
        let numbers = of.computed(samples).into_owned();
        let is_known = !numbers.is_empty() && numbers.iter().all(|value| !value.is_nan());
        is_known.then(|| StateField { name: name.to_owned(), components: 1, numbers })
    };
    let invariants = [("p", Quantity::MeanStress), ("q", Quantity::DeviatoricStress)];
    let invariants = invariants.into_iter().filter_map(invariant);
    [u].into_iter().chain(invariants).chain(fields.filter_map(error)).collect()
}

/// Returns the fields of a solver that reports only samples, with the names of the built-in solver.
fn sampled_fields(samples: &Samples) -> Vec<StateField> {
    let all = [
        ("X", &samples.label),
        ("v", &samples.velocity),
        ("V0", &samples.weight),
        ("sigma", &samples.stress),
        ("sigma33", &samples.stress_across),
        ("F", &samples.deformation_gradient),
        ("T", &samples.temperature),
    ];
    let field = |(name, numbers): (&str, &Vec<f64>)| {
        let components = numbers.len().checked_div(samples.len()).filter(|n| *n > 0)?;
        Some(StateField { name: name.to_owned(), components, numbers: numbers.clone() })
    };
    all.into_iter().filter_map(field).collect()
}

fn part(field: &StateField, particles: std::ops::Range<usize>) -> StateField {
    let n = field.components;
    let numbers = field.numbers[particles.start * n..particles.end * n].to_vec();
    StateField { name: field.name.clone(), components: n, numbers }
}

/// Converts the name of a run to a file name, such as `dt = 0.001 s` to `dt-0.001-s`.
fn file_name(run: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || c == '.';
    run.split(|c| !plain(c)).filter(|word| !word.is_empty()).collect::<Vec<_>>().join("-")
}
