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

#[cfg(test)]
#[path = "../../../../tests/it/common/vtk.rs"]
mod vtk_file;

#[cfg(test)]
mod tests {
    use super::vtk_file::{numbers, parts};
    use super::*;
    use crate::subject::{Failure, RunCounters};
    use crate::vtk::{TensorRank, points};

    /// Three particles in a plane, in two bodies (two particles and one) or without bodies. Their
    /// velocities are (1, -10), (2, -20) and (3, -30) m/s. Step number `last` fails.
    struct Plane {
        has_bodies: bool,
        t: f64,
        steps: u64,
        last: u64,
    }

    fn field(name: &str, components: usize, numbers: &[f64]) -> StateField {
        StateField { name: name.to_owned(), components, numbers: numbers.to_vec() }
    }

    impl Subject for Plane {
        fn step(&mut self, dt: f64) -> Result<(), Failure> {
            (self.t, self.steps) = (self.t + dt, self.steps + 1);
            if self.steps < self.last { Ok(()) } else { Err(Failure::NotOfDeformation) }
        }

        fn sample(&self, samples: &mut Samples) {
            samples.restart(2);
            for (k, label) in [(1.0, [1.0, 2.0]), (2.0, [3.0, 5.0]), (3.0, [8.0, 4.0])] {
                let v = [k, -10.0 * k];
                samples.push(&label, &v.map(|v| v * self.t), &v, 0.5 * k);
                samples.stress.extend([1.0, 2.0, 3.0, 4.0].map(|s| 10.0 * k + s));
                samples.stress_across.push(10.0 * k - 5.0);
                samples.deformation_gradient.extend([5.0, 6.0, 7.0, 8.0].map(|f| f + k));
                samples.temperature.push(300.0 + k);
            }
        }

        fn counters(&self) -> RunCounters {
            RunCounters::new(0)
        }

        fn fields(&self) -> Vec<BodyFields> {
            let mass = [21.0, 22.0, 23.0, 24.0, 25.0, self.t];
            let body = |masses: &[f64]| BodyFields {
                particles: masses.len(),
                of_particles: vec![field("mass", 1, masses)],
                ..BodyFields::default()
            };
            let first = BodyFields {
                origin: vec![-1.5, 0.25],
                h: 0.5,
                counts: vec![3, 2],
                of_nodes: vec![field("f", 2, &TWELVE), field("mass", 1, &mass)],
                ..body(&[2.0, 3.0])
            };
            if self.has_bodies { vec![first, body(&[5.0])] } else { Vec::new() }
        }
    }

    const TWELVE: [f64; 12] = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0, 11.0, 12.0];

    /// Moves with the velocity (X/4, -Y) m/s under a uniform stress that is not symmetric.
    struct Exact;

    impl Truth for Exact {
        fn displacement(&self, label: &[f64], t: f64, into: &mut [f64]) {
            into.copy_from_slice(&[0.25 * t * label[0], -t * label[1]]);
        }

        fn velocity(&self, label: &[f64], _: f64, into: &mut [f64]) {
            into.copy_from_slice(&[0.25 * label[0], -label[1]]);
        }

        fn stress(&self, _: &[f64], _: f64, into: &mut [f64]) -> bool {
            into.copy_from_slice(&[1.0, 20.0, 300.0, 4000.0]);
            true
        }
    }

    fn write_series(
        has_bodies: bool,
        level: &str,
        dt: &[f64],
        steps: u64,
    ) -> Vec<(String, Vec<u8>)> {
        let subject = Box::new(Plane { has_bodies, t: 0.0, steps: 0, last: 31 });
        let (name, truth, mut files) = (level.to_owned(), Some(&Exact as &dyn Truth), Vec::new());
        let run = ShownRun { name, subject, dt: dt.to_vec(), steps, truth };
        let write = &mut |file: &SeriesFile| {
            files.push((file.path.clone(), file.bytes.clone()));
            Ok(())
        };
        time_series("suite/bar", run, write).expect("files");
        files
    }

    fn assert_arrays(file: &[u8], expected: &[(&str, &[f64])]) {
        for (name, expected) in expected {
            assert_eq!(numbers(file, name), *expected, "{name}");
        }
    }

    /// With steps of 1/4 and 1/2 s the labels have moved for 3/4 s at the second instant.
    #[test]
    fn each_body_has_its_own_particles_grid_and_errors_at_each_instant() {
        let files = write_series(true, "dt = 0.25 s", &[0.25, 0.5], 2);
        let version = "version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\"";
        let head = |kind: &str, attributes: &str| {
            let root = format!("<VTKFile type=\"{kind}\" {version}>\n<{kind}{attributes}>\n");
            format!("<?xml version=\"1.0\"?>\n{root}")
        };
        let (mut pvd, mut paths) = (head("Collection", ""), Vec::new());
        for (number, t) in ["0", "0.25", "0.75"].iter().enumerate() {
            let names = ["particles-#.body-1.vtu", "grid-#.body-1.vti", "particles-#.body-2.vtu"];
            for (part, name) in names.iter().enumerate() {
                let file = format!("bar.dt-0.25-s/{}", name.replace('#', &format!("000{number}")));
                pvd += &format!("<DataSet timestep=\"{t}\" part=\"{part}\" file=\"{file}\"/>\n");
                paths.push(format!("suite/{file}"));
            }
        }
        paths.extend(["svg", "pvd"].map(|end| format!("suite/bar.dt-0.25-s.{end}")));
        assert!(files.iter().map(|(path, _)| path).eq(&paths), "{paths:?}");
        assert_eq!(files[10].1, (pvd + "</Collection>\n</VTKFile>\n").into_bytes());
        let (first, grid) = (&files[6].1, &files[7].1);
        assert_arrays(first, &[("position", &[1.75, -5.5, 0.0, 4.5, -10.0, 0.0])]);
        assert_arrays(first, &[("u", &[0.75, -7.5, 0.0, 1.5, -15.0, 0.0]), ("mass", &[2.0, 3.0])]);
        assert_arrays(first, &[("p", &[-10.0, -20.0])]);
        assert_arrays(
            first,
            &[("error of displacement", &[0.5625, -6.0, 0.0, 0.9375, -11.25, 0.0])],
        );
        assert_arrays(first, &[("error of velocity", &[0.75, -8.0, 0.0, 1.25, -15.0, 0.0])]);
        let stress = [30.0, 12.0, 0.0, -267.0, -3966.0, 0.0, 0.0, 0.0, 0.0];
        let second = [
            ("position", &[10.25, -18.5, 0.0][..]),
            ("u", &[2.25, -22.5, 0.0]),
            ("mass", &[5.0]),
            ("error of displacement", &[0.75, -19.5, 0.0]),
            ("error of stress", &stress),
        ];
        assert_arrays(&files[8].1, &second);
        let f: Vec<f64> = TWELVE.chunks(2).flat_map(|f| [f[0], f[1], 0.0]).collect();
        assert_arrays(grid, &[("mass", &[21.0, 22.0, 23.0, 24.0, 25.0, 0.75]), ("f", &f)]);
        let extent = "Extent=\"0 2 0 1 0 0\"";
        let place = format!(" Whole{extent} Origin=\"-1.5 0.25 0\" Spacing=\"0.5 0.5 0.5\"");
        // 18 numbers and their length take 152 bytes, or 204 digits in base64.
        let array = |(name, components, offset): (&str, usize, usize)| {
            let kind = format!("type=\"Float64\" NumberOfComponents=\"{components}\"");
            format!("<DataArray Name=\"{name}\" {kind} format=\"appended\" offset=\"{offset}\"/>\n")
        };
        let arrays = [("f", 3, 0), ("mass", 1, 204)].map(array).concat();
        let piece = format!("<Piece {extent}>\n<PointData>\n{arrays}</PointData>\n</Piece>\n");
        assert_eq!(parts(grid).0, head("ImageData", &place) + &piece + "</ImageData>\n");
    }

    #[test]
    fn samples_of_a_failing_run_are_written_at_twenty_instants_up_to_the_failure() {
        let files = write_series(false, "12 cells", &[0.1], 40);
        let times = (0..=15).map(|k| 2 * k).chain([31]).map(|k| f64::from(k) * 0.1);
        let line = |(number, t): (usize, f64)| {
            let file = format!("bar.12-cells/particles-{number:04}.vtu");
            format!("<DataSet timestep=\"{t}\" part=\"0\" file=\"{file}\"/>\n")
        };
        let lines: String = times.enumerate().map(line).collect();
        let pvd = std::str::from_utf8(&files[18].1).expect("text");
        assert!(pvd.contains(&format!("<Collection>\n{lines}</Collection>")), "{pvd}");
        let last = &files[16].1;
        assert_arrays(last, &[("X", &[1.0, 2.0, 0.0, 3.0, 5.0, 0.0, 8.0, 4.0, 0.0])]);
        assert_arrays(last, &[("v", &[1.0, -10.0, 0.0, 2.0, -20.0, 0.0, 3.0, -30.0, 0.0])]);
        assert_arrays(last, &[("V0", &[0.5, 1.0, 1.5]), ("sigma33", &[5.0, 15.0, 25.0])]);
        assert_arrays(last, &[("T", &[301.0, 302.0, 303.0])]);
        for (name, expected) in [("sigma", [21.0, 22.0, 23.0, 24.0]), ("F", [7.0, 8.0, 9.0, 10.0])]
        {
            let [a, b, c, d] = expected;
            let second = &numbers(last, name)[9..18];
            assert_eq!(second, [a, b, 0.0, c, d, 0.0, 0.0, 0.0, 0.0], "{name}");
        }
    }

    /// In 1-D the number of components does not determine the rank, and in 3-D nothing is added.
    #[test]
    fn ranks_determine_the_components_in_every_dimension() {
        let space =
            points(3, &[1.0, 2.0, 3.0], &[(TensorRank::Tensor, field("F", 9, &TWELVE[..9]))]);
        assert_arrays(&space, &[("position", &[1.0, 2.0, 3.0]), ("F", &TWELVE[..9])]);
        let ranks = [TensorRank::Scalar, TensorRank::Vector, TensorRank::Tensor];
        let line = points(
            1,
            &[4.0, 5.0],
            &ranks.map(|rank| (rank, field(&format!("{rank:?}"), 1, &[6.0, 7.0]))),
        );
        let extended =
            |x: [f64; 2], zeros: usize| x.map(|x| [vec![x], vec![0.0; zeros]].concat()).concat();
        assert_arrays(&line, &[("position", &extended([4.0, 5.0], 2)), ("Scalar", &[6.0, 7.0])]);
        assert_arrays(
            &line,
            &[("Vector", &extended([6.0, 7.0], 2)), ("Tensor", &extended([6.0, 7.0], 8))],
        );
        for (name, expected) in [("connectivity", [0, 1]), ("offsets", [1, 2])] {
            assert!(numbers(&line, name).into_iter().map(f64::to_bits).eq(expected), "{name}");
        }
        assert!(
            parts(&line).0.contains("<Piece NumberOfPoints=\"2\" NumberOfCells=\"2\">\n<Points>\n")
        );
    }
}
