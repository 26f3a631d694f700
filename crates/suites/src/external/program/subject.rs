//! Runs a level in a solver process.

use super::answer::{Answer, Hello, Points, State};
use super::connection::Connection;
use super::error::{ProgramError, printable};
use super::frame::Outgoing;
use super::inquiry::Inquiry;
use crate::external::fields::FieldName;
use crate::external::problem::LevelProblem;
use crate::subject::{Failure, RunCounters, Samples, Subject, Totals};
use serde_json::json;

/// Maximum number of requests for values per step, averaged over the steps between two instants.
pub(super) const QUESTIONS_PER_STEP: u64 = 1000;

/// Returns the maximum length (bytes) of an answer to `problem`, enough for all columns as decimal
/// text at three times as many points as the problem has particles.
pub(super) fn longest_answer(problem: &LevelProblem) -> usize {
    let (d, points) = (problem.dimension, 1000 + 3 * problem.particles.len());
    32 * points * (3 * d + 2 * d * d + 2)
}

/// Answers requests for values until another answer arrives, and returns that answer.
pub(super) fn conclude(
    connection: &mut Connection,
    inquiry: &mut Inquiry,
) -> Result<(Answer, Vec<u8>), ProgramError> {
    loop {
        let (answer, bytes) = connection.answer()?;
        match answer.request() {
            Ok(request) => connection.send(inquiry.answer(request, &bytes)?),
            Err(answer) => return Ok((*answer, bytes)),
        }
    }
}

/// Returns the state after a number of steps, with the bytes of its columns.
pub(super) type StateSource =
    Box<dyn FnMut(u64, &mut Inquiry) -> Result<(State, Vec<u8>), ProgramError>>;

/// Returns the states of a solver process, with one message for all steps up to the next instant.
pub(super) fn states_of_process(mut connection: Connection, dt: f64) -> StateSource {
    let mut taken = 0;
    Box::new(move |called, inquiry| {
        let steps = called - taken;
        let content = json!({"steps": steps, "dt": dt, "from": taken as f64 * dt});
        connection.send(Outgoing::new("advance", content, false));
        inquiry.allow(steps.saturating_mul(QUESTIONS_PER_STEP));
        match conclude(&mut connection, inquiry)? {
            (Answer::State(state), bytes) => {
                taken = called;
                Ok((*state, bytes))
            }
            (Answer::Failed { reason }, _) => Err(ProgramError::Failed(printable(&reason))),
            (other, _) => Err(ProgramError::unexpected("advance", other.name())),
        }
    })
}

/// A level whose states are computed outside this program.
pub(super) struct ProgramSubject {
    states: StateSource,
    dimension: usize,
    dt: f64,
    /// Remaining steps after which the state is requested.
    instants: std::vec::IntoIter<u64>,
    next: Option<u64>,
    /// Number of steps that the caller has requested.
    called: u64,
    inquiry: Inquiry,
    /// Masses of the points (kg); `None` for sample points of several or varying densities.
    mass: Option<Vec<f64>>,
    samples: Samples,
    counters: RunCounters,
}

impl ProgramSubject {
    /// Creates the level. Without `points`, the sample points are the particles.
    pub(super) fn new(
        states: StateSource,
        mut inquiry: Inquiry,
        problem: &LevelProblem,
        points: Option<Points>,
        bytes: &[u8],
        hello: &Hello,
    ) -> Result<Self, ProgramError> {
        let (d, particles) = (problem.dimension, &problem.particles);
        let mut samples = Samples { dimension: d, ..Samples::default() };
        let has_stress = hello.capabilities.known.columns.iter().any(|column| column == "stress");
        let has_own_points = points.is_some();
        let mass = if let Some(points) = points {
            let count = points.weight.count();
            samples.weight = points.weight.numbers("weight", count, bytes)?;
            let places = points.reference_position;
            samples.label = places.numbers("reference_position", count * d, bytes)?;
            if count == 0 {
                return Err(ProgramError::Protocol("sent an empty list of points".to_owned()));
            }
            inquiry.set_points(&samples.label)?;
            let start = |of| inquiry.start(of).unwrap_or_else(|| vec![0.0; count * d]);
            samples.displacement = start(FieldName::Displacement);
            samples.velocity = start(FieldName::Velocity);
            if has_stress {
                samples.stress = inquiry.start(FieldName::Stress).unwrap_or_default();
            }
            match problem.materials.as_slice() {
                [material] if material.varying_density.is_none() => {
                    let mass = samples.weight.iter().map(|volume| volume * material.density);
                    Some(mass.collect::<Vec<f64>>())
                }
                _ => None,
            }
        } else {
            let displaced = particles.position.iter().zip(&particles.reference_position);
            samples.displacement = displaced.map(|(x, label)| x - label).collect();
            samples.label.clone_from(&particles.reference_position);
            samples.velocity.clone_from(&particles.velocity);
            samples.weight.clone_from(&particles.reference_volume);
            if has_stress {
                samples.stress.clone_from(&particles.stress);
            }
            Some(particles.mass.clone())
        };
        samples.mass = mass.clone().unwrap_or_default();
        let counters = RunCounters {
            particles: (!has_own_points).then_some(particles.len() as u64),
            ..RunCounters::new(0)
        };
        let mut instants = problem.instants.clone().into_iter();
        Ok(Self {
            states,
            dimension: d,
            dt: problem.dt,
            next: instants.next(),
            instants,
            called: 0,
            inquiry,
            mass,
            samples,
            counters,
        })
    }

    /// Removes the initial velocities, if the states contain no velocities.
    pub(super) fn omit_velocities(mut self) -> Self {
        self.samples.velocity.clear();
        self
    }

    fn look(&mut self, state: State, bytes: &[u8]) -> Result<(), ProgramError> {
        let (d, n) = (self.dimension, self.samples.len());
        let State { mut columns, crossings, left_domain, min_j } = state;
        let mut column = |name: &str, count: usize| -> Result<Option<Vec<f64>>, ProgramError> {
            columns.remove(name).map(|column| column.numbers(name, count, bytes)).transpose()
        };
        let samples = &mut self.samples;
        let missing = |name| ProgramError::Protocol(format!("sent no column `{name}`"));
        samples.displacement =
            column("displacement", n * d)?.ok_or_else(|| missing("displacement"))?;
        // A solver with results in files may omit all velocities.
        let velocity = column("velocity", n * d)?;
        samples.velocity = match velocity {
            None if !samples.velocity.is_empty() => return Err(missing("velocity")),
            velocity => velocity.unwrap_or_default(),
        };
        samples.stress = column("stress", n * d * d)?.unwrap_or_default();
        let across = if d == 2 { column("stress_across", n)? } else { None };
        samples.stress_across = across.unwrap_or_default();
        samples.deformation_gradient =
            column("deformation_gradient", n * d * d)?.unwrap_or_default();
        samples.temperature = column("temperature", n)?.unwrap_or_default();
        self.counters.crossings = crossings;
        self.counters.left_domain = left_domain;
        if let Some(j) = min_j.filter(|j| !(*j > 0.0 && j.is_finite())) {
            let reason = format!("sent {j} as `min_j`, which must be positive");
            return Err(ProgramError::Protocol(reason));
        }
        self.counters.min_j = min_j.unwrap_or(f64::NAN);
        Ok(())
    }
}

impl Subject for ProgramSubject {
    fn step(&mut self, dt: f64) -> Result<(), Failure> {
        if dt != self.dt {
            let told = self.dt;
            let reason = format!("was initialised for steps of {told} s, not of {dt} s");
            return Err(Failure::External(reason));
        }
        self.called += 1;
        if self.next == Some(self.called) {
            self.next = self.instants.next();
            let state = (self.states)(self.called, &mut self.inquiry);
            let seen = state.and_then(|(state, bytes)| self.look(state, &bytes));
            seen.map_err(|error| Failure::External(error.to_string()))?;
        }
        Ok(())
    }

    fn sample(&self, samples: &mut Samples) {
        samples.clone_from(&self.samples);
    }

    fn counters(&self) -> RunCounters {
        self.counters
    }

    fn totals(&self) -> Option<Totals> {
        let masses = self.mass.as_ref().filter(|_| !self.samples.velocity.is_empty())?;
        Some(Totals::of_points(masses, &self.samples))
    }
}
