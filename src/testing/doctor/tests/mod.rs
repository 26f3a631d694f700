//! Tests of the examinations with a solver whose points move as stated. The strength of a defect
//! follows from the formulas of docs/design/doctor.md, so the measured figure is known.

mod motion;
mod quantities;
mod stress;
mod walls;

use super::course::vector;
use super::examination::ALL;
use super::finding::{FindingWeight, SolverFinding};
use super::patient::{Examined, Hindrance, Patient};
use crate::external::{LevelProblem, ProblemNeeds, SolverFactory};
use crate::subject::{Failure, Precision, RunCounters, Samples, Subject, SubjectError};
use nalgebra::{Matrix3, Vector3};

/// State of a point: displacement (m), velocity (m/s), and, if reported, stress (Pa) and F.
#[derive(Default)]
struct PointState {
    u: Vector3<f64>,
    v: Vector3<f64>,
    tensors: Option<[Matrix3<f64>; 2]>,
}

/// Returns the state of a point of a problem with this reference position after a number of steps.
type Motion<'a> = dyn Fn(&LevelProblem, Vector3<f64>, u64) -> PointState + Sync + 'a;

/// A solver whose points move as stated.
struct MadeUp<'a> {
    dimension: usize,
    precision: Precision,
    /// Number of points along the longest axis of a body (see [`lattice`]); 0 for all particles.
    points: usize,
    motion: &'a Motion<'a>,
}

/// Returns labels and weights of a lattice with the moments of the bodies: `n` points with the
/// distance `L/sqrt(n^2 - 1)` along each axis of length L.
fn lattice(problem: &LevelProblem, points: usize) -> (Vec<f64>, Vec<f64>) {
    let (mut labels, mut weights) = (Vec::new(), Vec::new());
    for body in &problem.bodies {
        let length = [0, 1].map(|i| body.to[i] - body.from[i]);
        let longest = length[0].max(length[1]);
        let n = length.map(|l| (libm::round(points as f64 * l / longest) as usize).max(2));
        for k in 0..n[0] * n[1] {
            labels.extend([(0, k % n[0]), (1, k / n[0])].map(|(i, k)| {
                let from_centre = (k as f64 - 0.5 * (n[i] - 1) as f64) * length[i];
                body.from[i] + 0.5 * length[i] + from_centre / libm::sqrt((n[i] * n[i] - 1) as f64)
            }));
            weights.push(length[0] * length[1] / (n[0] * n[1]) as f64);
        }
    }
    (labels, weights)
}

impl SolverFactory for MadeUp<'_> {
    fn name(&self) -> &'static str {
        "made-up"
    }

    fn precision(&self) -> Precision {
        self.precision
    }

    fn lacks(&self, needs: &ProblemNeeds) -> Vec<String> {
        if needs.dimension == self.dimension { Vec::new() } else { vec!["dimension".to_owned()] }
    }

    fn subject(&self, problem: LevelProblem) -> Result<Box<dyn Subject>, SubjectError> {
        let d = problem.dimension;
        let (labels, weights) = match self.points {
            0 => {
                let particles = &problem.particles;
                (particles.reference_position.clone(), particles.reference_volume.clone())
            }
            points => lattice(&problem, points),
        };
        let state = |step: u64| {
            let mut samples = Samples::default();
            for (label, weight) in labels.chunks_exact(d).zip(&weights) {
                let point = (self.motion)(&problem, vector(label), step);
                let [u, v] = [point.u, point.v];
                samples.push(label, &u.as_slice()[..d], &v.as_slice()[..d], *weight);
                let rows = |tensor: Matrix3<f64>| (0..d * d).map(move |k| tensor[(k / d, k % d)]);
                if let Some([stress, f]) = point.tensors {
                    samples.stress.extend(rows(stress));
                    samples.deformation_gradient.extend(rows(f));
                }
            }
            samples
        };
        Ok(Box::new(MadeUpRun { states: (0..=problem.steps).map(state).collect(), step: 0 }))
    }
}

struct MadeUpRun {
    states: Vec<Samples>,
    step: usize,
}

impl Subject for MadeUpRun {
    fn step(&mut self, _: f64) -> Result<(), Failure> {
        self.step += 1;
        Ok(())
    }

    fn sample(&self, samples: &mut Samples) {
        samples.clone_from(&self.states[self.step]);
    }

    fn counters(&self) -> RunCounters {
        RunCounters::new(self.step as u64)
    }
}

fn examine_with(name: &str, solver: &MadeUp<'_>) -> Examined {
    let examination = ALL.iter().find(|one| one.name == name).expect("an examination");
    match (examination.examine)(&Patient { solver, built_in: None }) {
        Ok(examined) => examined,
        Err(Hindrance::Lacks(why) | Hindrance::Masked(why) | Hindrance::Broke(why)) => {
            panic!("{name}: {why}")
        }
    }
}

/// Asserts the names of the findings, with remarks in parentheses. The text of the first finding,
/// or of the measured values without a finding, must contain the figure.
#[track_caller]
pub(in crate::testing::doctor) fn assert_found(examined: &Examined, names: &str, figure: &str) {
    let name = |finding: &SolverFinding| match finding.weight {
        FindingWeight::Defect => finding.name.to_owned(),
        FindingWeight::Remark => format!("({})", finding.name),
    };
    let found = examined.findings.iter().map(name).collect::<Vec<_>>().join(", ");
    let first = examined.findings.first();
    let text =
        first.map_or(examined.measured.clone(), |one| format!("{}. {}", one.seen, one.cause));
    assert_eq!(found, names, "{text}");
    assert!(text.contains(figure), "no `{figure}` in\n{text}");
}

/// Reads rows of `numbers | names | figure`.
pub(in crate::testing::doctor) fn rows<const N: usize>(table: &str) -> Vec<([f64; N], &str, &str)> {
    let row = |line| {
        let parts: Vec<&str> = str::splitn(line, 3, '|').map(str::trim).collect();
        let numbers = parts[0].split_whitespace().map(|number| number.parse().expect(number));
        let numbers: Vec<f64> = numbers.collect();
        (numbers.try_into().expect(line), parts[1], parts[2])
    };
    table.trim().lines().map(row).collect()
}

/// Examines a solver of double precision in two dimensions with the motions for the numbers of each
/// row of a table (see [`rows`]).
#[track_caller]
fn check<const N: usize, M>(points: usize, name: &str, motion: impl Fn([f64; N]) -> M, table: &str)
where
    M: Fn(&LevelProblem, Vector3<f64>, u64) -> PointState + Sync,
{
    for (numbers, names, figure) in rows(table) {
        let motion = &motion(numbers);
        let solver = MadeUp { dimension: 2, precision: Precision::Double, points, motion };
        assert_found(&examine_with(name, &solver), names, figure);
    }
}
