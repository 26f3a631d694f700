//! Spectrum studies of external solvers.

use crate::common::built_in_suite;
use mpm_verify::external::{LevelProblem, SolverFactory};
use mpm_verify::study::{Runner, under};
use mpm_verify::subject::{Failure, Precision, RunCounters, Samples, Subject, SubjectError};
use mpm_verify::verify::CaseOutcome;
use std::f64::consts::TAU;

/// A subject with a standing wave, whose amplitude has a given angle and modulus per step.
struct Oscillator {
    problem: LevelProblem,
    angle: f64,
    modulus: f64,
    step: u32,
}

impl Subject for Oscillator {
    fn step(&mut self, _: f64) -> Result<(), Failure> {
        self.step += 1;
        Ok(())
    }

    fn sample(&self, samples: &mut Samples) {
        let particles = &self.problem.particles;
        let kept =
            self.modulus.powi(self.step as i32) * libm::cos(self.angle * f64::from(self.step));
        samples.restart(1);
        samples.label.clone_from(&particles.reference_position);
        samples.weight.clone_from(&particles.reference_volume);
        samples.displacement = vec![0.0; particles.len()];
        samples.velocity = particles.velocity.iter().map(|v| v * kept).collect();
    }

    fn counters(&self) -> RunCounters {
        RunCounters::new(0)
    }
}

/// A solver whose waves have the angle and the modulus of FLIP under MUSL with linear functions.
/// `factor` multiplies the angle.
struct Waves {
    name: &'static str,
    factor: f64,
    precision: Precision,
}

impl SolverFactory for Waves {
    fn name(&self) -> &str {
        self.name
    }

    fn precision(&self) -> Precision {
        self.precision
    }

    fn subject(&self, problem: LevelProblem) -> Result<Box<dyn Subject>, SubjectError> {
        assert!(problem.instants.iter().copied().eq(1..=problem.steps), "every step is an instant");
        let largest = problem.particles.velocity.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
        assert!(largest > 0.9e-6 && largest <= 1e-6, "{largest}");
        // The run covers twenty exact periods of h/c = 1 s with C = 0.4.
        let theta = TAU / (problem.steps as f64 * problem.dt / 20.0);
        let lost = 1.0 - libm::cos(theta);
        let (kappa, s) = (2.0 * lost, 1.0 - 0.375 * lost);
        let angle = libm::acos(1.0 - 0.5 * kappa * s * problem.dt * problem.dt);
        let (angle, modulus) = (self.factor * angle, 1.0);
        Ok(Box::new(Oscillator { problem, angle, modulus, step: 0 }))
    }
}

fn outcome(solver: &Waves, gate: bool) -> CaseOutcome {
    let suite =
        under(&built_in_suite("wave-spectrum"), solver, gate).expect("a study of external solvers");
    assert_eq!(suite.case_names(), [solver.name]);
    Runner::new(&suite).judging(solver).case(0, &|| ())
}

fn waves(name: &'static str, factor: f64) -> Waves {
    Waves { name, factor, precision: Precision::Double }
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
    let solver = Waves { precision: Precision::Single, ..waves("mine", 1.0) };
    assert_eq!(outcome(&solver, false).lacks, ["double precision"]);
}
