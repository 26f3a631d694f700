//! Stability studies of an external solver.

use super::own_solver::OwnSolver;
use super::own_solver::solver::Bar;
use crate::common::solver::{NewSubject, Solver, solver};
use crate::common::valid_suite;
use mpm_verify::prelude::*;
use mpm_verify::study::lacking;
use mpm_verify::verify::StabilityRow;
use rstest::rstest;
use std::sync::Mutex;

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

/// Creates a solver of watched bars.
fn watched() -> Solver<impl Fn(LevelProblem) -> NewSubject + Sync> {
    let mut able = Capabilities::of(&[1], &["linear_elastic"], &["free", "fixed"], &[]);
    able.columns = vec!["stress".to_owned()];
    let solver = solver("watched", |problem| {
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
    });
    Solver { able: Some(able), ..solver }
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
    let theirs = judged(MOVING_BAR, &watched());
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
    let theirs = judged(&text, &watched());
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
    let outcome = judged(MOVING_BAR, &solver("silent", |problem| OwnSolver.subject(problem)));
    let result = (outcome.result().name(), outcome.verdict.as_str());
    assert_eq!(result, ("not applicable", "not applicable"));
    assert!(outcome.reason.contains("sends no totals"), "{}", outcome.reason);
}

/// A plate starts with F = (1.2, -0.3; 0.4, 1.05), with and without random numbers.
#[rstest]
fn problem_of_a_trial_has_its_start_and_its_steps(#[values("", ", perturb: 1e-3")] perturb: &str) {
    let is_random = !perturb.is_empty();
    let size = if is_random { 1e-3 } else { 0.0 };
    let text = MOVING_BAR
        .replace("dimension: 1", "dimension: 2")
        .replace("{from: [0], to: [4]}", "{from: [0, 1], to: [4, 3]}")
        .replace("linear_elastic: {young: E, poisson: 0,", "neo_hookean: {young: E, poisson: 0.25,")
        .replace(
            "  boundary: {left: fixed}\n",
            "  initial_displacement: [\"0.2*X - 0.3*Y\", \"0.4*X + 0.05*Y\"]\n  \
             initial_velocity: [3, X]\n",
        )
        .replace("ppc: 2", "ppc: 4")
        .replace(", perturb: 1e-9", perturb)
        .replace("[0.2, 0.5, 3]", "[0.5]");
    let problems = Mutex::new(Vec::new());
    let recorder = solver("recorder", |problem| {
        problems.lock().expect("a list").push(problem);
        Err("it runs nothing".into())
    });
    judged(&text, &recorder);
    let problems = problems.lock().expect("a list");
    let [problem] = &problems[..] else { panic!("{} problems", problems.len()) };
    // 0.5 h/c with c = sqrt(100/4)
    let steps = (problem.steps, problem.dt, problem.until, problem.load_steps);
    assert_eq!(steps, (100, 0.1, 10.0, None));
    assert!(problem.instants.is_sorted() && problem.instants.last() == Some(&100));
    let start = &problem.particles;
    let (f, j) = ([1.2, -0.3, 0.4, 1.05], 1.2 * 1.05 + 0.3 * 0.4);
    // The velocities have the size of the wave speed, 5.48 m/s.
    let near = |found: f64, expected: f64, scale: f64| -> f64 {
        let error = (found - expected).abs();
        assert!(error <= size * scale + 1e-13, "{found}, not {expected}");
        assert_eq!(error > 1e-12, is_random, "{found}");
        error
    };
    let mut largest = 0.0_f64;
    for (p, label) in start.reference_position.chunks_exact(2).enumerate() {
        for i in 0..2 {
            let x = f[2 * i] * label[0] + f[2 * i + 1] * label[1];
            assert!((start.position[2 * p + i] - x).abs() <= 4.0 * size + 1e-13);
            largest = largest.max(near(start.velocity[2 * p + i], [3.0, label[0]][i], 5.5));
        }
        let gradients = &start.deformation_gradient[4 * p..4 * p + 4];
        gradients.iter().zip(f).for_each(|(found, f)| _ = near(*found, f, 2.0));
        assert_eq!((start.mass[p], start.reference_volume[p]), (1.0, 0.25));
        assert!((start.volume[p] - 0.25 * j).abs() <= size + 1e-13);
    }
    assert!(largest >= 4.0 * size, "velocities are perturbed by up to the wave speed: {largest}");
    let fields = problem.fields.as_ref().expect("fields");
    let at = FieldPlaces::new(&[1.0, 2.0], &[0]);
    let values = |of| fields.values(of, 0.0, &at).ok();
    assert_eq!(values(FieldName::Velocity), (!is_random).then(|| vec![3.0, 1.0]));
    assert_eq!(values(FieldName::DeformationGradient), (!is_random).then(|| f.to_vec()));
    assert_eq!(values(FieldName::Stress).is_none(), is_random);
    assert!(values(FieldName::Displacement).is_some());
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
    let lacks = lacking(&suite, &watched());
    assert_eq!(lacks, [format!("{words}, which the protocol does not support")]);
}
