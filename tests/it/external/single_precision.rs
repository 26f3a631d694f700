//! Verdicts on solvers in single precision: levels below the rounding bound must not count.

use crate::common::folder::assert_contains;
use crate::common::valid_suite;
use mpm_verify::external::{LevelProblem, SolverFactory};
use mpm_verify::report;
use mpm_verify::study::{Runner, under};
use mpm_verify::subject::{Failure, Precision, RunCounters, Samples, Subject, SubjectError};
use mpm_verify::suite::Extent;
use mpm_verify::verify::{Exclusion, LevelOutcome, SuiteOutcome};

/// Finite differences in space with velocity Verlet in time. Every operation is in single
/// precision. Positions are stored, and displacements are computed from them.
struct Differences {
    problem: LevelProblem,
    reference: Vec<f32>,
    x: Vec<f32>,
    v: Vec<f32>,
    stiffness: f32,
}

impl Differences {
    fn acceleration(&self) -> Vec<f32> {
        let n = self.x.len();
        let u = |i: usize| self.x[i] - self.reference[i];
        let dx = self.reference[1] - self.reference[0];
        // Values half a spacing outside the ends: u is odd about the fixed end and even about the
        // free one.
        let at = |i: isize| match i {
            -1 => -u(0),
            i if i as usize == n => u(n - 1),
            i => u(i as usize),
        };
        let second = |i: isize| (at(i + 1) - 2.0 * at(i) + at(i - 1)) / (dx * dx);
        (0..n as isize).map(|i| self.stiffness * second(i)).collect()
    }

    fn kick(&mut self, dt: f32) {
        let a = self.acceleration();
        self.v.iter_mut().zip(a).for_each(|(v, a)| *v += dt * a);
    }
}

impl Subject for Differences {
    fn step(&mut self, dt: f64) -> Result<(), Failure> {
        let dt = dt as f32;
        self.kick(0.5 * dt);
        self.x.iter_mut().zip(&self.v).for_each(|(x, v)| *x += dt * v);
        self.kick(0.5 * dt);
        Ok(())
    }

    fn sample(&self, samples: &mut Samples) {
        samples.restart(1);
        samples.label.clone_from(&self.problem.particles.reference_position);
        samples.weight.clone_from(&self.problem.particles.reference_volume);
        let u = |(x, label): (&f32, &f64)| f64::from(*x) - label;
        samples.displacement = self.x.iter().zip(&samples.label).map(u).collect();
        samples.velocity = self.v.iter().map(|v| f64::from(*v)).collect();
    }

    fn counters(&self) -> RunCounters {
        RunCounters::new(0)
    }
}

/// Creates `Differences`. The stiffness has the relative error `defect` h, which causes order 1.
struct Single {
    precision: Precision,
    defect: f64,
}

impl SolverFactory for Single {
    fn name(&self) -> &'static str {
        "single"
    }

    fn precision(&self) -> Precision {
        self.precision
    }

    fn subject(&self, problem: LevelProblem) -> Result<Box<dyn Subject>, SubjectError> {
        let material = &problem.materials[0];
        let c2 = material.parameters[0].1 / material.density;
        let stiffness = (c2 * (1.0 + self.defect * problem.grid.h)) as f32;
        let single = |values: &[f64]| values.iter().map(|x| *x as f32).collect::<Vec<f32>>();
        let reference = single(&problem.particles.reference_position);
        let (x, v) = (reference.clone(), single(&problem.particles.velocity));
        Ok(Box::new(Differences { problem, reference, x, v, stiffness }))
    }
}

/// Creates the bar with this amplitude of the velocity (m/s). Steps are at half the Courant limit
/// of the differences. The equation is linear, so displacements may be large.
fn bar(amplitude: &str, cells: &str) -> String {
    crate::cli::BAR
        .replace("1e-3*sin", &format!("{amplitude}*sin"))
        .replace("until: 0.05, dt: 1e-3", "until: 0.05, dt: \"h/80\"")
        .replace("[4, 6, 8, 12]", cells)
}

fn run(solver: &Single, text: &str) -> SuiteOutcome {
    let suite = under(&valid_suite(text), solver, false).expect("a convergence study");
    Runner::over(&suite, Extent::Usual).judging(solver).run(&|| ())
}

fn levels(found: &SuiteOutcome) -> &[LevelOutcome] {
    &found.cases[0].convergence().expect("a convergence study").levels
}

/// Numbers of cells for errors from above the rounding bound to far below it.
const DOWN: &str = "[3, 4, 6, 8, 12, 32, 64, 128]";

#[test]
fn a_solver_of_second_order_converges_down_to_rounding() {
    let solver = Single { precision: Precision::Single, defect: 0.0 };
    let found = run(&solver, &bar("3", DOWN));
    let case = &found.cases[0];
    let figures: Vec<_> =
        levels(&found).iter().map(|level| (level.error, level.rounding_bound)).collect();
    assert_eq!(case.verdict, "converging", "{}: {figures:?}", case.reason);
    let words = "down to rounding: from 32 cells on the error lies below the rounding bound";
    assert!(case.reason.contains(words), "{}: {figures:?}", case.reason);
    let exclusions: Vec<_> = levels(&found).iter().map(LevelOutcome::exclusion).collect();
    assert_eq!(exclusions[..5], [None; 5]);
    assert_eq!(exclusions[5..], [Some(Exclusion::Rounding); 3]);
    let json = report::json(std::slice::from_ref(&found));
    assert_contains(
        &json,
        &[r#""excluded_by": "rounding""#, r#""counts": false"#, r#""rounding_bound": "#],
    );
}

#[test]
fn the_same_levels_do_not_converge_if_double_precision_is_declared() {
    let solver = Single { precision: Precision::Double, defect: 0.0 };
    let found = run(&solver, &bar("3", DOWN));
    let case = &found.cases[0];
    let possible = ["too low", "pre-asymptotic", "at floor", "divergent"];
    assert!(possible.contains(&case.verdict.as_str()), "{}: {}", case.verdict, case.reason);
    for level in levels(&found) {
        assert_eq!((level.rounding_bound, level.exclusion()), (None, None));
    }
}

#[test]
fn a_first_order_defect_above_the_bound_is_too_low() {
    let solver = Single { precision: Precision::Single, defect: 0.3 };
    let found = run(&solver, &bar("3", DOWN));
    let case = &found.cases[0];
    assert_eq!(case.verdict, "too low", "{}", case.reason);
}

#[test]
fn too_few_levels_above_the_bound_ask_for_a_larger_amplitude() {
    let solver = Single { precision: Precision::Single, defect: 0.0 };
    let found = run(&solver, &bar("0.3", "[8, 12, 32, 64]"));
    let case = &found.cases[0];
    assert_eq!(case.verdict, "too few levels", "{}", case.reason);
    assert_contains(&case.reason, &["rounding bound of single precision", "a larger amplitude"]);
}
