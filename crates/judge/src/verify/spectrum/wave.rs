//! Runs a solver with one wave and fits the recurrence of its particle velocities.

use super::recurrence::Recurrence;
use mpm_subject::{Samples, Subject};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Velocity amplitude of a wave divided by the wave speed. This equals the strain of the wave.
pub const AMPLITUDE: f64 = 1e-6;

/// Number of exact periods in a run.
pub const PERIODS: f64 = 20.0;

/// Fraction of the initial amplitude at which the run of a damped wave ends.
const LEAST_KEPT: f64 = 1e-6;

const FEWEST_STEPS: f64 = 16.0;

/// Trace and determinant of the 2 x 2 matrix of a step (see [`Recurrence`]), measured in a run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct MeasuredWave {
    /// Number of steps of the run.
    pub steps: u64,
    /// Trace of the matrix; NaN if the run failed or the wave does not change.
    pub trace: f64,
    /// Determinant of the matrix; NaN in the same cases.
    pub determinant: f64,
}

/// Returns the number of steps over [`PERIODS`] exact periods of a wave of `cells` cells. The run
/// ends earlier if the predicted amplitude decreases to a millionth; `log_kept` is the predicted
/// logarithm of the amplitude factor of a step, if there is a prediction.
pub fn steps_of_run(cells: f64, courant: f64, log_kept: Option<f64>) -> u64 {
    let whole = libm::ceil(PERIODS * cells / courant);
    let damped = log_kept.filter(|log_kept| *log_kept < 0.0);
    let until = damped.map_or(whole, |log_kept| libm::floor(libm::log(LEAST_KEPT) / log_kept));
    until.min(whole).max(FEWEST_STEPS) as u64
}

/// A wave in a periodic row of particles, and the steps of its run.
#[derive(Debug, Clone, Copy)]
pub struct ObservedWave {
    /// Position (m) of the start of the row, where the wave is zero.
    pub from: f64,
    /// Wavelength (m).
    pub length: f64,
    /// Length of a step (s).
    pub dt: f64,
    /// Number of steps of the run.
    pub steps: u64,
}

/// Runs `subject` and fits a recurrence to the series of `sum v sin(k X)` over its particles, with
/// the wave number `k = 2 pi/length` and X from the beginning of the row. The series excludes the
/// initial state, because this state may not result from a step.
///
/// # Errors
/// Message that names the failed step.
pub fn run_wave(subject: &mut dyn Subject, wave: ObservedWave) -> Result<MeasuredWave, String> {
    let ObservedWave { from, length, dt, steps } = wave;
    let (mut samples, mut weights) = (Samples::default(), Vec::new());
    let mut series = Vec::new();
    for step in 1..=steps {
        subject.step(dt).map_err(|failure| format!("{failure} (step {step})"))?;
        samples.clear();
        subject.sample(&mut samples);
        if weights.is_empty() {
            let weight = |x: &f64| libm::sin(TAU / length * (x - from));
            weights = samples.label.iter().map(weight).collect();
        }
        series.push(samples.velocity.iter().zip(&weights).map(|(v, weight)| v * weight).sum());
    }
    let fit = Recurrence::fit(&series);
    Ok(MeasuredWave { steps, trace: fit.trace(), determinant: fit.determinant() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use mpm_subject::{Failure, RunCounters};

    /// Two points a quarter of a wavelength apart. Only the velocity at the crest has an effect.
    struct Scripted {
        velocity: [f64; 2],
        step: u64,
    }

    impl Subject for Scripted {
        fn step(&mut self, _: f64) -> Result<(), Failure> {
            let [before, last] = self.velocity;
            self.velocity = [last, 1.8 * last - 0.9 * before];
            self.step += 1;
            if self.step == 100 { Err(Failure::External("stopped".to_owned())) } else { Ok(()) }
        }

        fn sample(&self, samples: &mut Samples) {
            samples.restart(1);
            samples.push(&[3.0], &[0.0], &[self.velocity[1]], 1.0);
            samples.push(&[2.0], &[0.0], &[self.step as f64], 1.0);
        }

        fn counters(&self) -> RunCounters {
            RunCounters::new(0)
        }
    }

    #[test]
    fn recurrence_is_fitted_to_the_wave_velocity() {
        let mut subject = Scripted { velocity: [1.0, 0.9], step: 0 };
        let wave = ObservedWave { from: 2.0, length: 4.0, dt: 1.0, steps: 40 };
        let found = run_wave(&mut subject, wave).unwrap();
        assert_relative_eq!(found.trace, 1.8, epsilon = 1e-12);
        assert_relative_eq!(found.determinant, 0.9, epsilon = 1e-12);
        let failure = run_wave(&mut subject, ObservedWave { steps: 100, ..wave }).unwrap_err();
        assert_eq!(failure, "the solver stopped (step 60)");
    }

    #[test]
    fn a_damped_run_ends_at_a_millionth() {
        assert_eq!(steps_of_run(8.0, 0.4, None), 400);
        assert_eq!(steps_of_run(8.0, 0.4, Some(0.0)), 400);
        assert_eq!(steps_of_run(8.0, 0.4, Some(libm::log(0.9))), 131);
        assert_eq!(steps_of_run(8.0, 0.4, Some(-40.0)), 16);
        assert_eq!(steps_of_run(8.0, 0.4, Some(f64::NAN)), 400);
    }
}
