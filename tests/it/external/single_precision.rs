//! Verdicts on solvers in single precision: levels below the rounding bound must not count.

use crate::common::folder::assert_contains;
use crate::common::solver::{Solver, solver};
use crate::common::{edited, levels, valid_suite};
use mpm_verify::external::LevelProblem;
use mpm_verify::report;
use mpm_verify::study::{Runner, under};
use mpm_verify::subject::{Failure, Precision, RunCounters, Samples, Subject};
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

/// Runs the bar with the declared precision. The largest velocity is 3 m/s, and the equation is
/// linear, so displacements may be large. Steps are at half the Courant limit of the differences.
/// The errors reach from above the rounding bound to far below it.
fn run(precision: Precision) -> SuiteOutcome {
    let single = solver("single", |problem| {
        let material = &problem.materials[0];
        let stiffness = (material.parameters[0].1 / material.density) as f32;
        let single = |values: &[f64]| values.iter().map(|x| *x as f32).collect::<Vec<f32>>();
        let reference = single(&problem.particles.reference_position);
        let (x, v) = (reference.clone(), single(&problem.particles.velocity));
        Ok(Box::new(Differences { problem, reference, x, v, stiffness }))
    });
    let solver = Solver { precision, ..single };
    let edits = [
        ("1e-3*sin", "3*sin"),
        ("dt: 1e-3", "dt: \"h/80\""),
        ("[4, 6, 8, 12]", "[3, 4, 6, 8, 12, 32, 64, 128]"),
        ("1e-3*sin", "3*sin"),
    ];
    let suite = valid_suite(&edited(crate::cli::BAR, &edits));
    let suite = under(&suite, &solver, false).expect("a convergence study");
    Runner::over(&suite, Extent::Usual).judging(&solver).run(&|| ())
}

#[test]
fn a_solver_of_second_order_converges_down_to_rounding() {
    let found = run(Precision::Single);
    let case = &found.cases[0];
    let figures: Vec<_> =
        levels(case).iter().map(|level| (level.error, level.rounding_bound)).collect();
    assert_eq!(case.verdict, "converging", "{}: {figures:?}", case.reason);
    let words = "down to rounding: from 32 cells on the error lies below the rounding bound";
    assert!(case.reason.contains(words), "{}: {figures:?}", case.reason);
    let exclusions: Vec<_> = levels(case).iter().map(LevelOutcome::exclusion).collect();
    assert_eq!(exclusions[..5], [None; 5]);
    assert_eq!(exclusions[5..], [Some(Exclusion::Rounding); 3]);
    let json = report::json(std::slice::from_ref(&found));
    let keys = [r#""excluded_by": "rounding""#, r#""counts": false"#, r#""rounding_bound": "#];
    assert_contains(&json, &keys);
}

#[test]
fn the_same_levels_do_not_converge_if_double_precision_is_declared() {
    let found = run(Precision::Double);
    let case = &found.cases[0];
    let possible = ["too low", "pre-asymptotic", "at floor", "divergent"];
    assert!(possible.contains(&case.verdict.as_str()), "{}: {}", case.verdict, case.reason);
    for level in levels(case) {
        assert_eq!((level.rounding_bound, level.exclusion()), (None, None));
    }
}
