//! Solvers that a user of the library implements in Rust.

use super::bar;
use crate::common::{built_in_suite, valid_suite};
use mpm_verify::embedded;
use mpm_verify::external::{Capabilities, LevelProblem, ProblemNeeds, SolverFactory};
use mpm_verify::study::{Runner, lacking, under};
use mpm_verify::subject::{Failure, RunCounters, Samples, Subject, SubjectError};
use mpm_verify::suite::{Extent, Suite};
use mpm_verify::verify::{CaseOutcome, CaseResult};
use rayon::prelude::*;
use rstest::rstest;

/// Second-order finite differences with one unknown at each particle: `u_tt = c^2 u_XX`.
struct Differences {
    problem: LevelProblem,
    u: Vec<f64>,
    v: Vec<f64>,
}

impl Subject for Differences {
    fn step(&mut self, dt: f64) -> Result<(), Failure> {
        let material = &self.problem.materials[0];
        let c2 = material.parameters[0].1 / material.density;
        let x = &self.problem.particles.reference_position;
        let (n, dx) = (self.u.len(), x[1] - x[0]);
        for (u, v) in self.u.iter_mut().zip(&self.v) {
            *u += 0.5 * dt * v;
        }
        // Values half a spacing outside the ends: u is odd about the fixed end and even about the
        // free one.
        let at = |i: isize| match i {
            -1 => -self.u[0],
            i if i as usize == n => self.u[n - 1],
            i => self.u[i as usize],
        };
        for i in 0..n as isize {
            self.v[i as usize] += dt * c2 * (at(i + 1) - 2.0 * at(i) + at(i - 1)) / (dx * dx);
        }
        for (u, v) in self.u.iter_mut().zip(&self.v) {
            *u += 0.5 * dt * v;
        }
        Ok(())
    }

    fn sample(&self, samples: &mut Samples) {
        samples.restart(1);
        samples.label.clone_from(&self.problem.particles.reference_position);
        samples.weight.clone_from(&self.problem.particles.reference_volume);
        samples.displacement.clone_from(&self.u);
        samples.velocity.clone_from(&self.v);
    }

    fn counters(&self) -> RunCounters {
        RunCounters::new(0)
    }
}

pub(super) struct Maker(pub(super) &'static str);

impl SolverFactory for Maker {
    fn name(&self) -> &str {
        self.0
    }

    fn subject(&self, problem: LevelProblem) -> Result<Box<dyn Subject>, SubjectError> {
        if problem.faces[0].condition != "fixed" {
            return Err("a left end that is not held".into());
        }
        let u = vec![0.0; problem.particles.len()];
        let v = problem.particles.velocity.clone();
        Ok(Box::new(Differences { problem, u, v }))
    }
}

fn outcome(text: &str) -> CaseOutcome {
    let maker = Maker("differences");
    let suite = under(&valid_suite(text), &maker, true).expect("a convergence study");
    Runner::over(&suite, Extent::Usual).judging(&maker).case(0, &|| ())
}

#[test]
fn solver_of_a_few_lines_has_the_theoretical_order() {
    let found = outcome(&bar());
    assert!(found.passed() && found.verdict.contains("converging"), "{}", found.reason);
}

#[test]
fn refused_problem_is_not_applicable() {
    let free = bar().replace("sin(pi*X/2)", "cos(pi*X/2)").replace("left: fixed", "right: fixed");
    let found = outcome(&free);
    assert_eq!(
        (found.result().name(), found.verdict.as_str()),
        ("not applicable", "not applicable")
    );
    assert!(found.reason.contains("a left end that is not held"), "{}", found.reason);
}

/// A maker whose solver fails while it is set up.
struct Failing;

impl SolverFactory for Failing {
    fn name(&self) -> &'static str {
        "failing"
    }

    fn subject(&self, _: LevelProblem) -> Result<Box<dyn Subject>, SubjectError> {
        Err(Failure::External("out of memory".to_owned()).into())
    }
}

#[test]
fn a_solver_that_fails_in_its_setup_fails_the_case() {
    for name in ["vibrating-bar", "crossing-energy"] {
        let suite = built_in_suite(name);
        let suite = under(&suite, &Failing, true).expect("a study of solvers");
        let found = Runner::over(&suite, Extent::Usual).judging(&Failing).case(0, &|| ());
        assert!(!found.passed(), "{name}: {} {}", found.verdict, found.reason);
        assert!(found.unmet.iter().any(|unmet| unmet.text.contains("out of memory")), "{name}");
    }
}

/// A solver with one law, which is not asked to run.
struct OfLaw(&'static str);

impl SolverFactory for OfLaw {
    fn name(&self) -> &'static str {
        "of-law"
    }

    fn lacks(&self, needs: &ProblemNeeds) -> Vec<String> {
        Capabilities::of(&[2], &[self.0], &["free"], &[]).lacking(needs)
    }

    fn subject(&self, _: LevelProblem) -> Result<Box<dyn Subject>, SubjectError> {
        Err("nothing runs here".into())
    }
}

/// The suite has the law `linear_elastic`, small strains and `any_law`.
#[rstest]
#[case::isotropic_elastic("hencky", true)]
#[case::plastic("j2", false)]
fn only_isotropic_elastic_laws_replace_a_law_at_small_strains(
    #[case] law: &'static str,
    #[case] replaces: bool,
) {
    let suite = built_in_suite("lame-square");
    let solver = OfLaw(law);
    let judged = under(&suite, &solver, false).expect("a suite for solvers");
    assert_eq!(lacking(&judged, &solver).is_empty(), replaces);
    let plan = judged.convergence().expect("a convergence study");
    let own = suite.convergence().expect("a convergence study").scene.material.parameters();
    assert_eq!(plan.scene.material.parameters(), own);
    assert_eq!(plan.scene.material.name(), if replaces { law } else { "linear_elastic" });
}

/// A solver whose state never changes.
struct Motionless;

struct InitialState(Samples);

impl SolverFactory for Motionless {
    fn name(&self) -> &'static str {
        "motionless"
    }

    fn subject(&self, problem: LevelProblem) -> Result<Box<dyn Subject>, SubjectError> {
        let start = &problem.particles;
        let displaced = start.position.iter().zip(&start.reference_position);
        let samples = Samples {
            dimension: problem.dimension,
            label: start.reference_position.clone(),
            displacement: displaced.map(|(x, label)| x - label).collect(),
            velocity: start.velocity.clone(),
            weight: start.reference_volume.clone(),
            stress: start.stress.clone(),
            ..Samples::default()
        };
        Ok(Box::new(InitialState(samples)))
    }
}

impl Subject for InitialState {
    fn step(&mut self, _: f64) -> Result<(), Failure> {
        Ok(())
    }

    fn sample(&self, samples: &mut Samples) {
        samples.clone_from(&self.0);
    }

    fn counters(&self) -> RunCounters {
        RunCounters::new(0)
    }
}

/// Suites whose judged quantity does not change, or has its initial value at the end.
const UNCHANGED: [&str; 16] = [
    "geostatic-column",
    "geostatic-drucker-prager",
    "geostatic-mohr-coulomb",
    "geostatic-slope",
    "geostatic-slope-3d",
    "load-steps-geostatic-drucker-prager",
    "pressurised-cylinder",
    "pressurised-cylinder-in-plane",
    "rotating-block",
    "spinning-disk",
    "sticking-block",
    "sticking-layers",
    "time-step-auto",
    "translating-stressed-bar",
    "translating-stressed-plate",
    "vibrating-bar-long",
];

/// A suite whose displacement vanishes at the end would accept a solver that does nothing.
#[test]
fn motionless_solver_passes_no_other_suite() {
    let passes = |name: &&str| {
        let source = embedded::source(name).expect("a suite").expect("a text").trusted();
        let suite = Suite::load(&source).expect("a sound suite");
        let Some(judged) = under(&suite, &Motionless, true) else { return false };
        if judged.convergence().is_none() {
            return false;
        }
        let runner = Runner::over(&judged, Extent::Usual).judging(&Motionless);
        let cases = (0..judged.case_names().len()).map(|case| runner.case(case, &|| ()));
        cases.into_iter().any(|case| case.result() == CaseResult::Pass)
    };
    let names: Vec<&str> = embedded::names().collect();
    let found: Vec<&str> = names.into_par_iter().filter(passes).collect();
    assert_eq!(found, UNCHANGED);
}
