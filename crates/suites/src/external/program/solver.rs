//! Starts solver programs and sets up levels that run in these programs.

use super::answer::{Answer, Hello, Points};
use super::connection::{Connection, ProgramLimits};
use super::error::{ProgramError, printable};
use super::frame::Outgoing;
use super::inquiry::Inquiry;
use super::subject::{
    ProgramSubject, QUESTIONS_PER_STEP, conclude, longest_answer, states_of_process,
};
use crate::external::SolverFactory;
use crate::external::capabilities::{Capabilities, ProblemNeeds};
use crate::external::gradient::{Gradient, GradientError, GradientRequest};
use crate::external::problem::LevelProblem;
use crate::subject::{
    Failure, HIGHEST_ORDER, Precision, RunCounters, Samples, Subject, SubjectError, is_solver_name,
};
use serde_json::json;
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};

pub(super) const PROTOCOL: u64 = 2;

pub(super) const VERSIONS: [u64; 2] = [1, PROTOCOL];

/// Maximum number of requests for values before the solver answers a problem with `ready`.
const SETUP_QUESTIONS: u64 = 10_000;

/// An external solver that a command starts.
#[derive(Debug, Clone)]
pub struct SolverProgram {
    command: Vec<String>,
    limits: ProgramLimits,
    hello: Hello,
    identity: u64,
    /// Name that replaces the name in `hello`, if set by [`Self::called`].
    called: Option<String>,
}

impl SolverProgram {
    /// Starts `command`, which is split into arguments like in a shell, and requests the identity
    /// and capabilities of the solver.
    ///
    /// # Errors
    /// If the command cannot run, or its answer violates the protocol.
    pub fn greet(command: &str, limits: ProgramLimits) -> Result<Self, ProgramError> {
        let command = shlex::split(command).ok_or(ProgramError::Quotes)?;
        if command.is_empty() {
            return Err(ProgramError::EmptyCommand);
        }
        let (connection, hello) = connected(&command, limits)?;
        connection.end();
        let identity = identity(&command, &hello);
        Ok(Self { command, limits, hello, identity, called: None })
    }

    /// Gives the solver another name, for example to distinguish two solvers that run the same
    /// program. Expectations that a suite states for an external solver are then looked up under
    /// `name`.
    ///
    /// # Errors
    /// If `name` is not a valid solver name.
    pub fn called(self, name: &str) -> Result<Self, ProgramError> {
        if !is_solver_name(name) {
            return Err(ProgramError::invalid_name(name));
        }
        Ok(Self { called: Some(name.to_owned()), ..self })
    }

    /// Returns warnings, one line for each unknown name in the solver's capabilities.
    pub fn warnings(&self) -> Vec<String> {
        self.hello.capabilities.known.unknown_names(&self.hello.capabilities.keys)
    }

    fn start(&self, problem: &LevelProblem) -> Result<ProgramSubject, ProgramError> {
        let Started { connection, inquiry, hello, points, bytes } = self.ready(problem)?;
        let states = states_of_process(connection, problem.dt);
        ProgramSubject::new(states, inquiry, problem, points, &bytes, &hello)
    }

    fn ready(&self, problem: &LevelProblem) -> Result<Started, ProgramError> {
        let (mut connection, hello) = connected(&self.command, self.limits)?;
        if hello != self.hello {
            let reason = "sent a different `hello` than in the first process";
            return Err(ProgramError::Protocol(reason.to_owned()));
        }
        connection.expect_up_to(longest_answer(problem));
        let binary = hello.capabilities.known.binary;
        connection.send(problem_message(problem, binary));
        let mut inquiry = Inquiry::new(problem, hello.protocol, binary);
        inquiry.allow(SETUP_QUESTIONS);
        match conclude(&mut connection, &mut inquiry)? {
            (Answer::Ready { points }, bytes) => {
                Ok(Started { connection, inquiry, hello, points, bytes })
            }
            (Answer::Cannot { reason }, _) => Err(ProgramError::Refused(printable(&reason))),
            (Answer::Failed { reason }, _) => Err(ProgramError::Failed(printable(&reason))),
            (other, _) => Err(ProgramError::unexpected("problem", other.name())),
        }
    }

    /// Requests a functional after all steps of `problem` and its gradient from a new process.
    fn differentiate(
        &self,
        problem: &LevelProblem,
        request: &GradientRequest,
    ) -> Result<Gradient, ProgramError> {
        let Started { mut connection, mut inquiry, .. } = self.ready(problem)?;
        let content = json!({
            "of": request.of,
            "with_respect_to": request.with_respect_to,
            "steps": problem.steps,
            "dt": problem.dt,
            "from": 0.0,
        });
        connection.send(Outgoing::new("differentiate", content, false));
        inquiry.allow(problem.steps.saturating_mul(QUESTIONS_PER_STEP));
        let answer = conclude(&mut connection, &mut inquiry).map_err(|error| match error {
            // The answer is invalid JSON, because it contains a word such as NaN. The index of the
            // number is unknown.
            ProgramError::NoNumber(word) => ProgramError::Protocol(format!(
                "answered `differentiate` with {word}, which is not a finite number; requested: {}",
                names(request).join(", ")
            )),
            error => error,
        });
        let gradient = match answer?.0 {
            Answer::Gradient { value, gradient } => checked(request, value, gradient)?,
            Answer::Cannot { reason } => return Err(ProgramError::Refused(printable(&reason))),
            Answer::Failed { reason } => return Err(ProgramError::Failed(printable(&reason))),
            other => return Err(ProgramError::unexpected("differentiate", other.name())),
        };
        connection.end();
        Ok(gradient)
    }
}

struct Started {
    connection: Connection,
    inquiry: Inquiry,
    hello: Hello,
    /// Sample points of the solver; `None` if it reports states at the particles.
    points: Option<Points>,
    /// Block of bytes after the `ready` answer, with the columns of `points`.
    bytes: Vec<u8>,
}

pub(super) fn problem_message(problem: &LevelProblem, binary: bool) -> Outgoing {
    let mut message = Outgoing::new("problem", json!(problem), binary);
    let forced = match (&problem.constant_body_force, &problem.body_force) {
        (Some(_), _) => "constant",
        (None, Some(_)) => "asked",
        (None, None) => "none",
    };
    message.set("body_force", json!(forced));
    for (name, column) in problem.particles.columns() {
        message.column("particles", name, column);
    }
    message
}

/// Returns the hash of the command, of the files among its arguments, and of the hello message. If
/// the program reads other files, such as modules, their changes are detected only by a new version
/// in `hello`.
fn identity(command: &[String], hello: &Hello) -> u64 {
    let mut all = DefaultHasher::new();
    (command, format!("{hello:?}")).hash(&mut all);
    for word in command {
        // Only regular files are hashed, not folders or devices.
        let is_file = fs::metadata(word).is_ok_and(|found| found.is_file());
        is_file.then(|| fs::read(word).ok()).flatten().hash(&mut all);
    }
    all.finish()
}

fn connected(
    command: &[String],
    limits: ProgramLimits,
) -> Result<(Connection, Hello), ProgramError> {
    let mut connection = Connection::start(command, limits)?;
    let harness = concat!("mpm-verify ", env!("CARGO_PKG_VERSION"));
    let message = json!({"protocol": PROTOCOL, "versions": VERSIONS, "harness": harness});
    connection.send(Outgoing::new("hello", message, false));
    let (answer, _) = connection.answer()?;
    let Answer::Hello(hello) = answer else {
        return Err(ProgramError::unexpected("hello", answer.name()));
    };
    let (stated, order, [first, last]) = (hello.protocol, hello.formal_order, VERSIONS);
    if !VERSIONS.contains(&stated) {
        return Err(ProgramError::Protocol(format!(
            "uses version {stated} of the protocol; expected version {first} or {last}"
        )));
    }
    if !is_solver_name(&hello.name) {
        return Err(ProgramError::invalid_name(&hello.name));
    }
    if !(order > 0.0 && order <= HIGHEST_ORDER) {
        return Err(ProgramError::Protocol(format!(
            "has the formal order {order}: expected a number above 0 and up to {HIGHEST_ORDER}"
        )));
    }
    Ok((connection, hello))
}

impl SolverFactory for SolverProgram {
    fn name(&self) -> &str {
        self.called.as_deref().unwrap_or(&self.hello.name)
    }

    fn formal_order(&self) -> f64 {
        self.hello.formal_order
    }

    fn precision(&self) -> Precision {
        self.hello.precision
    }

    fn settings(&self) -> Vec<(String, String)> {
        self.hello.settings()
    }

    fn identity(&self) -> Option<u64> {
        Some(self.identity)
    }

    fn lacks(&self, needs: &ProblemNeeds) -> Vec<String> {
        let mut lacking = self.hello.capabilities.known.lacking(needs);
        if self.hello.protocol == 1 {
            // Excludes capabilities that are already in `lacking`.
            let stated = needs.beyond_version_1().into_iter();
            let stated = stated.filter(|need| !lacking.iter().any(|known| known.starts_with(need)));
            let new: Vec<String> = stated
                .map(|need| format!("{need} (available in version 2 of the protocol only)"))
                .collect();
            lacking.extend(new);
        }
        lacking
    }

    fn capabilities(&self) -> Option<&Capabilities> {
        Some(&self.hello.capabilities.known)
    }

    fn subject(&self, problem: LevelProblem) -> Result<Box<dyn Subject>, SubjectError> {
        match self.start(&problem) {
            Ok(subject) => Ok(Box::new(subject)),
            Err(ProgramError::Refused(reason)) => Err(SubjectError::Unsupported(reason)),
            Err(error) => Ok(Box::new(Broken(error.to_string()))),
        }
    }

    fn gradient(
        &self,
        problem: LevelProblem,
        request: &GradientRequest,
    ) -> Result<Gradient, GradientError> {
        self.differentiate(&problem, request).map_err(|error| match error {
            ProgramError::Refused(reason) => GradientError::Cannot(reason),
            error => GradientError::Failed(error.to_string()),
        })
    }
}

struct Broken(String);

impl Subject for Broken {
    fn step(&mut self, _: f64) -> Result<(), Failure> {
        Err(Failure::External(self.0.clone()))
    }

    fn sample(&self, samples: &mut Samples) {
        samples.clear();
    }

    fn counters(&self) -> RunCounters {
        RunCounters::new(0)
    }
}

/// Checks that the answer to `request` has one finite number for each parameter, and returns it.
fn checked(
    request: &GradientRequest,
    value: f64,
    gradient: Vec<f64>,
) -> Result<Gradient, ProgramError> {
    let names = names(request);
    if gradient.len() != names.len() {
        let (found, expected, names) = (gradient.len(), names.len(), names.join(", "));
        let reason = format!("sent a gradient of {found} numbers, expected {expected}: {names}");
        return Err(ProgramError::Protocol(reason));
    }
    let entries = names.iter().map(|name| format!("derivative with respect to `{name}`"));
    let entries = entries.zip(&gradient).map(|(of, entry)| (of, *entry));
    let value_of = (format!("value of `{}`", request.of.name()), value);
    let mut all = std::iter::once(value_of).chain(entries);
    match all.find(|(_, number)| !number.is_finite()) {
        Some((of, value)) => Err(ProgramError::Protocol(format!("sent {value} as the {of}"))),
        None => Ok(Gradient { value, gradient }),
    }
}

fn names(request: &GradientRequest) -> Vec<&'static str> {
    request.with_respect_to.iter().map(|one| one.name()).collect()
}
