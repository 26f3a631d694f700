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
mod tests {
    use super::*;
    use crate::subject::{Failure, RunCounters};
    use crate::vtk::{TensorRank, points};

    /// Three labels of a plane, in bodies of two and one particles or without bodies. The label
    /// number k has the velocity (k + 1) (1, -10) m/s, and fails in step `last`.
    struct Plane {
        has_bodies: bool,
        t: f64,
        steps: u64,
        last: u64,
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
            let field = |name: &str, components, numbers: &[f64]| StateField {
                name: name.to_owned(),
                components,
                numbers: numbers.to_vec(),
            };
            let first = BodyFields {
                particles: 2,
                of_particles: vec![field("mass", 1, &[2.0, 3.0])],
                origin: vec![-1.5, 0.25],
                h: 0.5,
                counts: vec![3, 2],
                of_nodes: vec![
                    field("f", 2, &[1., 2., 3., 4., 5., 6., 7., 8., 9., 10., 11., 12.]),
                    field("mass", 1, &[21.0, 22.0, 23.0, 24.0, 25.0, self.t]),
                ],
            };
            let of_particles = vec![field("mass", 1, &[5.0])];
            let second = BodyFields { particles: 1, of_particles, ..BodyFields::default() };
            if self.has_bodies { vec![first, second] } else { Vec::new() }
        }
    }

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

    fn written(subject: Plane, level: &str, dt: &[f64], steps: u64) -> Vec<(String, Vec<u8>)> {
        let (name, truth, mut files) = (level.to_owned(), Some(&Exact as &dyn Truth), Vec::new());
        let run = ShownRun { name, subject: Box::new(subject), dt: dt.to_vec(), steps, truth };
        let write = &mut |file: &SeriesFile| {
            files.push((file.path.clone(), file.bytes.clone()));
            Ok(())
        };
        time_series("suite/bar", run, write).expect("files");
        files
    }

    /// Returns the text of a file before its numbers, and the numbers after it.
    fn parts(file: &[u8]) -> (&str, &str) {
        let text = std::str::from_utf8(file).expect("text");
        text.split_once("<AppendedData encoding=\"base64\">\n_").unwrap_or((text, ""))
    }

    /// Decodes the array called `name`, which begins with the number of its bytes.
    fn numbers(file: &[u8], name: &str) -> Vec<f64> {
        let (xml, appended) = parts(file);
        let (_, line) = xml.split_once(&format!("Name=\"{name}\"")).expect(name);
        let offset = line.split("offset=\"").nth(1).and_then(|rest| rest.split('"').next());
        let digits = appended[offset.and_then(|at| at.parse().ok()).expect("an offset")..].bytes();
        let (mut bits, mut count, mut bytes) = (0_u32, 0, Vec::new());
        for digit in digits.take_while(|c| *c != b'=' && *c != b'\n') {
            let value = match digit {
                b'A'..=b'Z' => digit - b'A',
                b'a'..=b'z' => digit - b'a' + 26,
                b'0'..=b'9' => digit - b'0' + 52,
                _ => {
                    if digit == b'+' {
                        62
                    } else {
                        63
                    }
                }
            };
            (bits, count) = (bits << 6 | u32::from(value), count + 6);
            if count >= 8 {
                count -= 8;
                bytes.push((bits >> count) as u8);
            }
        }
        let word = |at: usize| bytes[at..at + 8].try_into().expect("eight bytes");
        let end = 8 + u64::from_le_bytes(word(0)) as usize;
        (8..end).step_by(8).map(|at| f64::from_le_bytes(word(at))).collect()
    }

    /// With steps of 1/4 and 1/2 s the labels have moved for 3/4 s at the second instant.
    #[test]
    fn each_body_has_its_own_particles_grid_and_errors_at_each_instant() {
        let plane = Plane { has_bodies: true, t: 0.0, steps: 0, last: 9 };
        let files = written(plane, "dt = 0.25 s", &[0.25, 0.5], 2);
        let (mut list, mut paths) = (String::new(), Vec::new());
        for (number, t) in ["0", "0.25", "0.75"].iter().enumerate() {
            let names = ["particles-#.body-1.vtu", "grid-#.body-1.vti", "particles-#.body-2.vtu"];
            for (part, name) in names.iter().enumerate() {
                let file = format!("bar.dt-0.25-s/{}", name.replace('#', &format!("000{number}")));
                list += &format!("<DataSet timestep=\"{t}\" part=\"{part}\" file=\"{file}\"/>\n");
                paths.push(format!("suite/{file}"));
            }
        }
        paths.extend(["svg", "pvd"].map(|end| format!("suite/bar.dt-0.25-s.{end}")));
        assert!(files.iter().map(|(path, _)| path).eq(&paths), "{paths:?}");
        let head = |kind: &str, attributes: &str| {
            let version = "version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\"";
            let root = format!("<VTKFile type=\"{kind}\" {version}>\n<{kind}{attributes}>\n");
            format!("<?xml version=\"1.0\"?>\n{root}")
        };
        let pvd = head("Collection", "") + &list + "</Collection>\n</VTKFile>\n";
        assert_eq!(parts(&files[10].1).0, pvd);
        let [first, grid, second] = [6, 7, 8].map(|k| files[k].1.as_slice());
        for (file, name, expected) in [
            (first, "position", &[1.75, -5.5, 0.0, 4.5, -10.0, 0.0][..]),
            (first, "u", &[0.75, -7.5, 0.0, 1.5, -15.0, 0.0]),
            (first, "mass", &[2.0, 3.0]),
            (first, "p", &[-10.0, -20.0]),
            (first, "error of displacement", &[0.5625, -6.0, 0.0, 0.9375, -11.25, 0.0]),
            (first, "error of velocity", &[0.75, -8.0, 0.0, 1.25, -15.0, 0.0]),
            (second, "position", &[10.25, -18.5, 0.0]),
            (second, "u", &[2.25, -22.5, 0.0]),
            (second, "mass", &[5.0]),
            (second, "error of displacement", &[0.75, -19.5, 0.0]),
            (second, "error of stress", &[30.0, 12.0, 0.0, -267.0, -3966.0, 0.0, 0.0, 0.0, 0.0]),
            (grid, "mass", &[21.0, 22.0, 23.0, 24.0, 25.0, 0.75]),
        ] {
            assert_eq!(numbers(file, name), expected, "{name}");
        }
        let f = (1..=6).flat_map(|k| [f64::from(2 * k - 1), f64::from(2 * k), 0.0]);
        assert!(numbers(grid, "f").into_iter().eq(f));
        let extent = "Extent=\"0 2 0 1 0 0\"";
        let place = format!(" Whole{extent} Origin=\"-1.5 0.25 0\" Spacing=\"0.5 0.5 0.5\"");
        let array = |name: &str, count: usize, offset: usize| {
            format!(
                "<DataArray Name=\"{name}\" type=\"Float64\" NumberOfComponents=\"{count}\" \
                 format=\"appended\" offset=\"{offset}\"/>\n"
            )
        };
        // 18 numbers and their length take 152 bytes, or 204 digits in base64.
        let data = array("f", 3, 0) + &array("mass", 1, 204);
        let tail = "</PointData>\n</Piece>\n</ImageData>\n";
        let vti = format!("<Piece {extent}>\n<PointData>\n{data}{tail}");
        assert_eq!(parts(grid).0, head("ImageData", &place) + &vti);
    }

    #[test]
    fn samples_of_a_failing_run_are_written_at_twenty_instants_up_to_the_failure() {
        let plane = Plane { has_bodies: false, t: 0.0, steps: 0, last: 31 };
        let files = written(plane, "12 cells", &[0.1], 40);
        let times: Vec<f64> =
            (0..=15).map(|k| 2 * k).chain([31]).map(|k| f64::from(k) * 0.1).collect();
        let list = parts(&files[18].1).0.lines().filter(|line| line.starts_with("<DataSet"));
        for ((number, t), line) in times.iter().enumerate().zip(list) {
            let file = format!("bar.12-cells/particles-{number:04}.vtu");
            assert_eq!(line, format!("<DataSet timestep=\"{t}\" part=\"0\" file=\"{file}\"/>"));
        }
        assert_eq!((files.len(), times.len()), (19, 17));
        for (name, expected) in [
            ("X", &[1.0, 2.0, 0.0, 3.0, 5.0, 0.0, 8.0, 4.0, 0.0][..]),
            ("v", &[1.0, -10.0, 0.0, 2.0, -20.0, 0.0, 3.0, -30.0, 0.0]),
            ("V0", &[0.5, 1.0, 1.5]),
            ("sigma33", &[5.0, 15.0, 25.0]),
            ("T", &[301.0, 302.0, 303.0]),
        ] {
            assert_eq!(numbers(&files[16].1, name), expected, "{name}");
        }
        let tensors = |name: &str| numbers(&files[16].1, name)[9..18].to_vec();
        assert_eq!(tensors("sigma"), [21.0, 22.0, 0.0, 23.0, 24.0, 0.0, 0.0, 0.0, 0.0]);
        assert_eq!(tensors("F"), [7.0, 8.0, 0.0, 9.0, 10.0, 0.0, 0.0, 0.0, 0.0]);
    }

    /// In 1-D the number of components does not determine the rank, and in 3-D nothing is added.
    #[test]
    fn ranks_determine_the_components_in_every_dimension() {
        let field = |rank, components, numbers: &[f64]| {
            let name = format!("{rank:?}");
            (rank, StateField { name, components, numbers: numbers.to_vec() })
        };
        let nine = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0];
        let space = points(3, &[1.0, 2.0, 3.0], &[field(TensorRank::Tensor, 9, &nine)]);
        assert_eq!(numbers(&space, "position"), [1.0, 2.0, 3.0]);
        assert_eq!(numbers(&space, "Tensor"), nine);
        let fields = [TensorRank::Scalar, TensorRank::Vector, TensorRank::Tensor]
            .map(|rank| field(rank, 1, &[6.0, 7.0]));
        let line = points(1, &[4.0, 5.0], &fields);
        assert_eq!(numbers(&line, "position"), [4.0, 0.0, 0.0, 5.0, 0.0, 0.0]);
        assert_eq!(numbers(&line, "Scalar"), [6.0, 7.0]);
        assert_eq!(numbers(&line, "Vector"), [6.0, 0.0, 0.0, 7.0, 0.0, 0.0]);
        let tensors = [6.0, 7.0].map(|x| [x, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        assert_eq!(numbers(&line, "Tensor"), tensors.concat());
        for (name, expected) in [("connectivity", [0, 1]), ("offsets", [1, 2])] {
            assert!(numbers(&line, name).into_iter().map(f64::to_bits).eq(expected), "{name}");
        }
        let xml = parts(&line).0;
        assert!(
            xml.contains("<Piece NumberOfPoints=\"2\" NumberOfCells=\"2\">\n<Points>\n"),
            "{xml}"
        );
    }
}
