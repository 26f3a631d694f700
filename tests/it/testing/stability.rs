//! Stability studies of an external solver.

use super::own_solver::OwnSolver;
use super::own_solver::solver::Bar;
use crate::common::valid_suite;
use mpm_verify::prelude::*;
use mpm_verify::study::lacking;
use mpm_verify::verify::StabilityRow;
use rstest::rstest;

/// A bar whose particles move through cells and start with random velocities and stresses. It uses
/// linear functions, FLIP and MUSL.
const MOVING_BAR: &str = "\
suite: moving-bar
study: stability
title: A bar in motion
source: none
parameters: {E: 100, rho: 4, c: \"sqrt(E/rho)\", C: 0.2}
scene:
  dimension: 1
  body: {box: {from: [0], to: [4]}}
  material: {linear_elastic: {young: E, poisson: 0, density: rho}}
  boundary: {left: fixed}
particles: {cells: 4, ppc: 2}
run: {dt: \"C*h/c\", steps: 100, perturb: 1e-9}
sweep: {C: [0.2, 0.5, 3]}
methods:
  - mpm: {basis: linear, transfer: flip, scheme: musl}
";

/// A bar of the example that also reports the data that a trial observes.
struct WatchedBar(Bar, ProblemParticles);

impl Subject for WatchedBar {
    fn step(&mut self, dt: f64) -> Result<(), Failure> {
        self.0.step(dt).map_err(|p| Failure::External(format!("lost particle {p}")))
    }

    fn sample(&self, samples: &mut Samples) {
        let Self(bar, start) = self;
        samples.restart(1);
        for (p, label) in start.reference_position.iter().enumerate() {
            samples.push(&[*label], &[bar.x[p] - label], &[bar.v[p]], start.reference_volume[p]);
        }
        samples.stress.clone_from(&bar.stress);
    }

    fn counters(&self) -> RunCounters {
        RunCounters::new(self.0.visits)
    }

    fn totals(&self) -> Option<Totals> {
        let mut totals = Totals::default();
        for (mass, v) in self.0.mass.iter().zip(&self.0.v) {
            totals.add(*mass, [*v, 0.0, 0.0], [0.0; 3]);
        }
        Some(totals)
    }
}

/// Creates watched bars.
struct WatchedSolver;

impl SolverFactory for WatchedSolver {
    fn name(&self) -> &'static str {
        "watched"
    }

    fn lacks(&self, needs: &ProblemNeeds) -> Vec<String> {
        let mut able = Capabilities::of(&[1], &["linear_elastic"], &["free", "fixed"], &[]);
        able.columns = vec!["stress".to_owned()];
        able.lacking(needs)
    }

    fn subject(&self, problem: LevelProblem) -> Result<Box<dyn Subject>, SubjectError> {
        let (grid, start) = (problem.grid, problem.particles);
        for (name, column) in start.columns() {
            assert_eq!(column.len(), start.len(), "{name}");
        }
        let bar = Bar {
            grid: (grid.origin[0], grid.h, grid.cells[0] as usize),
            held: [true, false],
            modulus: problem.materials[0].parameter("young"),
            x: start.position.clone(),
            v: start.velocity.clone(),
            mass: start.mass.clone(),
            volume: start.volume.clone(),
            stress: start.stress.clone(),
            visits: 0,
        };
        Ok(Box::new(WatchedBar(bar, start)))
    }
}

/// A solver that does not report its missing capabilities in advance.
struct Silent;

impl SolverFactory for Silent {
    fn name(&self) -> &'static str {
        "silent"
    }

    fn subject(&self, problem: LevelProblem) -> Result<Box<dyn Subject>, SubjectError> {
        OwnSolver.subject(problem)
    }
}

fn judged(text: &str, solver: &dyn SolverFactory) -> CaseOutcome {
    let theirs = under(&valid_suite(text), solver, true).expect("a study of a solver");
    Runner::new(&theirs).judging(solver).case(0, &|| ())
}

fn rows(outcome: &CaseOutcome) -> &[StabilityRow] {
    &outcome.stability().expect("a stability study").rows
}

#[test]
fn equal_algorithms_have_equal_growth() {
    let ours = Runner::new(&valid_suite(MOVING_BAR)).case(0, &|| ());
    let theirs = judged(MOVING_BAR, &WatchedSolver);
    assert_eq!((theirs.case.as_str(), theirs.result().name()), ("watched", "explored"));
    let verdicts: Vec<&str> =
        rows(&theirs).iter().map(|row| row.trial.as_ref().unwrap().verdict.name()).collect();
    assert_eq!(verdicts, ["stable", "stable", "unstable"]);
    for (ours, theirs) in rows(&ours).iter().zip(rows(&theirs)) {
        let [ours, theirs] = [ours, theirs].map(|row| row.trial.as_ref().unwrap());
        assert_eq!((ours.verdict, ours.steps), (theirs.verdict, theirs.steps));
        let off = (theirs.energy / ours.energy - 1.0).abs();
        assert!(off <= 1e-6, "{} and not {}", theirs.energy, ours.energy);
    }
}

#[test]
fn limit_is_found_by_runs() {
    let text = MOVING_BAR.replace(
        "sweep: {C: [0.2, 0.5, 3]}",
        "sweep: {rho: [1, 4]}\ncritical: {parameter: C, from: 0.1, to: 4}",
    );
    let ours = Runner::new(&valid_suite(&text)).case(0, &|| ());
    let theirs = judged(&text, &WatchedSolver);
    let limits = |outcome: &CaseOutcome| -> Vec<_> {
        rows(outcome).iter().map(|row| row.critical.as_ref().unwrap().observed).collect()
    };
    assert_eq!(limits(&theirs), limits(&ours));
    assert_eq!(limits(&theirs).len(), 2);
}

#[test]
fn solver_without_stress_or_totals_is_not_applicable() {
    let outcome = judged(MOVING_BAR, &OwnSolver);
    assert_eq!(outcome.result().name(), "not applicable");
    assert_eq!(outcome.lacks, ["columns: stress"]);
    let outcome = judged(MOVING_BAR, &Silent);
    assert_eq!(
        (outcome.result().name(), outcome.verdict.as_str()),
        ("not applicable", "not applicable")
    );
    assert!(outcome.reason.contains("sends no totals"), "{}", outcome.reason);
}

#[rstest]
#[case::a_held_configuration(
    "perturb: 1e-9",
    "frozen: true",
    "a configuration that no step changes"
)]
#[case::steps_in_turn("perturb: 1e-9", "alternate: \"C*h/(2*c)\"", "steps of two lengths")]
fn study_beyond_the_protocol_is_listed_as_lacking(
    #[case] from: &str,
    #[case] to: &str,
    #[case] words: &str,
) {
    let suite = valid_suite(&MOVING_BAR.replace(from, to));
    let lacks = lacking(&suite, &WatchedSolver);
    assert_eq!(lacks, [format!("{words}, which the protocol does not support")]);
}
