//! Recorded runs of a few steps, and breaches of the contract.

use crate::subject::{Failure, RunCounters, Samples, Subject, Totals};
use std::fmt;

#[derive(Debug, Clone, PartialEq)]
pub(super) struct RunState {
    pub(super) samples: Samples,
    pub(super) counters: RunCounters,
    pub(super) totals: Option<Totals>,
}

impl RunState {
    pub(super) fn from_subject(subject: &dyn Subject) -> Self {
        let mut samples = Samples::default();
        subject.sample(&mut samples);
        Self { samples, counters: subject.counters(), totals: subject.totals() }
    }
}

/// Takes `steps` steps of length `dt` (s), until one fails, and appends the state after each step.
pub(super) fn record(
    subject: &mut dyn Subject,
    steps: usize,
    dt: f64,
    states: &mut Vec<RunState>,
) -> Result<(), Failure> {
    for _ in 0..steps {
        subject.step(dt)?;
        states.push(RunState::from_subject(subject));
    }
    Ok(())
}

/// Returns name, numbers and width of every sample column; width is the number of values per point.
pub(super) fn columns(samples: &Samples) -> [(&'static str, &[f64], usize); 8] {
    let d = samples.dimension;
    [
        ("label", &samples.label, d),
        ("displacement", &samples.displacement, d),
        ("velocity", &samples.velocity, d),
        ("weight", &samples.weight, 1),
        ("mass", &samples.mass, 1),
        ("stress", &samples.stress, d * d),
        ("deformation_gradient", &samples.deformation_gradient, d * d),
        ("temperature", &samples.temperature, 1),
    ]
}

/// Describes the first number that differs by more than `tolerance` times the column maximum.
pub(super) fn difference(wanted: &Samples, seen: &Samples, tolerance: f64) -> Option<String> {
    if wanted.dimension != seen.dimension {
        return Some(format!("dimension {} instead of {}", seen.dimension, wanted.dimension));
    }
    columns(wanted).into_iter().zip(columns(seen)).find_map(|((name, wanted, _), (_, seen, _))| {
        if wanted.len() != seen.len() {
            let (seen, wanted) = (seen.len(), wanted.len());
            return Some(format!("{seen} numbers in `{name}` instead of {wanted}"));
        }
        let most = tolerance * largest(wanted);
        let at = wanted.iter().zip(seen).position(|(a, b)| !((a - b).abs() <= most))?;
        Some(format!("{name}[{at}] = {:e} instead of {:e}", seen[at], wanted[at]))
    })
}

pub(super) fn largest(column: &[f64]) -> f64 {
    column.iter().fold(0.0, |most: f64, number| most.max(number.abs()))
}

/// A breach of the contract of [`Subject`].
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Breach {
    /// Name of the violated part of the contract, such as `counts`, `labels` or `repeat`.
    pub about: &'static str,
    /// Behaviour that the contract requires.
    pub expected: String,
    /// Observed behaviour of the solver.
    pub seen: String,
}

impl Breach {
    pub(super) fn new(
        about: &'static str,
        expected: impl Into<String>,
        seen: impl Into<String>,
    ) -> Self {
        Self { about, expected: expected.into(), seen: seen.into() }
    }
}

impl fmt::Display for Breach {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: expected {}; observed: {}", self.about, self.expected, self.seen)
    }
}
