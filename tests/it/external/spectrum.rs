//! Spectrum studies of external solvers.

use crate::common::built_in_suite;
use crate::common::solver::{NewSubject, Solver, prescribed, solver};
use mpm_verify::external::{LevelProblem, SolverFactory};
use mpm_verify::study::{Runner, under};
use mpm_verify::subject::Precision;
use mpm_verify::verify::CaseOutcome;
use std::f64::consts::TAU;

/// Creates a solver whose waves have the angle of FLIP under MUSL with linear functions, times
/// `factor`, and a constant amplitude.
fn waves(name: &'static str, factor: f64) -> Solver<impl Fn(LevelProblem) -> NewSubject + Sync> {
    solver(name, move |problem| {
        assert!(problem.instants.iter().copied().eq(1..=problem.steps), "every step is an instant");
        let largest = problem.particles.velocity.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
        assert!(largest > 0.9e-6 && largest <= 1e-6, "{largest}");
        // The run covers twenty exact periods of h/c = 1 s with C = 0.4.
        let theta = TAU / (problem.steps as f64 * problem.dt / 20.0);
        let lost = 1.0 - libm::cos(theta);
        let (kappa, s) = (2.0 * lost, 1.0 - 0.375 * lost);
        let angle = factor * libm::acos(1.0 - 0.5 * kappa * s * problem.dt * problem.dt);
        Ok(prescribed(problem, move |problem, steps, samples| {
            let kept = libm::cos(angle * steps as f64);
            samples.velocity = problem.particles.velocity.iter().map(|v| v * kept).collect();
        }))
    })
}

fn outcome(solver: &impl SolverFactory, gate: bool) -> CaseOutcome {
    let suite =
        under(&built_in_suite("wave-spectrum"), solver, gate).expect("a study of external solvers");
    assert_eq!(suite.case_names(), [solver.name()]);
    Runner::new(&suite).judging(solver).case(0, &|| ())
}

/// If the method is unknown, there is a measurement but no prediction.
#[test]
fn solver_with_an_unknown_method_is_measured() {
    let found = outcome(&waves("mine", 1.0), false);
    assert_eq!((found.result().name(), found.verdict.as_str()), ("explored", "measured"));
    let study = found.spectrum().expect("a study");
    let errors: Vec<f64> = study
        .rows
        .iter()
        .map(|row| {
            assert!(row.predicted.is_none() && row.limit.is_none());
            row.measured.as_ref().expect("figures").phase_error.expect("a phase")
        })
        .collect();
    // The values of docs/dispersion.md for eight and sixteen cells.
    for (error, expected) in errors.iter().zip([-0.077_351, -0.019_729]) {
        assert!((error - expected).abs() < 1e-6, "{error} against {expected}");
    }
    assert_eq!(outcome(&waves("mine", 1.0), true).result().name(), "explored");
}

/// The method is known from the name of a case, or from a name that the suite relates to a case.
#[test]
fn solver_with_a_known_method_is_compared_with_its_curve() {
    for name in ["mpm-linear-flip-musl-lumped", "numpy-linear-musl"] {
        for gate in [false, true] {
            assert_eq!(outcome(&waves(name, 1.0), gate).result().name(), "pass");
            // The factor changes the phase error of sixteen cells by 4 %.
            assert_eq!(outcome(&waves(name, 1.0008), gate).result().name(), "FAIL");
        }
    }
    // The phase error of APIC is a quarter of the phase error of FLIP.
    assert_eq!(outcome(&waves("mpm-linear-apic-musl", 1.0), false).result().name(), "FAIL");
}

#[test]
fn single_precision_does_not_resolve_the_wave() {
    let solver = Solver { precision: Precision::Single, ..waves("mine", 1.0) };
    assert_eq!(outcome(&solver, false).lacks, ["double precision"]);
}
