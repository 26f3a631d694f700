//! A solver behind a command, as a maker of subjects.

use super::answer::{Answer, Hello};
use super::connection::{Connection, ProgramLimits};
use super::frame::Outgoing;
use super::inquiry::Inquiry;
use super::printable::printable;
use super::subject::{ProgramSubject, conclude, longest_answer};
use crate::external::capabilities::ProblemNeeds;
use crate::external::factory::SolverFactory;
use crate::external::problem::LevelProblem;
use crate::subject::{
    Failure, HIGHEST_ORDER, LONGEST_NAME, Precision, RunCounters, Samples, Subject, is_solver_name,
};
use serde_json::json;
use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};

/// Version of the protocol.
pub(super) const PROTOCOL: u64 = 2;

/// Versions that a solver may speak.
pub(super) const VERSIONS: [u64; 2] = [1, PROTOCOL];

/// Maximum number of requests for values before a solver is ready.
const SETUP_QUESTIONS: u64 = 10_000;

/// A solver behind a command.
#[derive(Debug, Clone)]
pub struct SolverProgram {
    command: Vec<String>,
    limits: ProgramLimits,
    hello: Hello,
    identity: u64,
}

impl SolverProgram {
    /// Starts `command` (words as a shell splits them) and asks who it is.
    ///
    /// # Errors
    /// One line that says what is wrong with the command or its answer.
    pub fn greet(command: &str, limits: ProgramLimits) -> Result<Self, String> {
        let command = shlex::split(command)
            .ok_or("command has a quote that is not closed, or ends with a backslash")?;
        if command.is_empty() {
            return Err("is empty: expected a command with its arguments".to_owned());
        }
        let (connection, hello) = connected(&command, limits)?;
        connection.end();
        let identity = identity(&command, &hello);
        Ok(Self { command, limits, hello, identity })
    }

    /// One line for each name in the solver's capabilities that has no meaning.
    pub fn warnings(&self) -> Vec<String> {
        self.hello.capabilities.known.unknown_names(&self.hello.capabilities.keys)
    }

    fn start(&self, problem: &LevelProblem) -> Result<Result<ProgramSubject, String>, String> {
        let (mut connection, hello) = connected(&self.command, self.limits)?;
        if hello != self.hello {
            return Err("said another hello than the first time".to_owned());
        }
        connection.expect_up_to(longest_answer(problem));
        let binary = hello.capabilities.known.binary;
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
        connection.send(message);
        let mut inquiry = Inquiry::new(problem, hello.protocol, binary);
        inquiry.allow(SETUP_QUESTIONS);
        Ok(match conclude(&mut connection, &mut inquiry)? {
            (Answer::Ready { points }, bytes) => {
                Ok(ProgramSubject::new(connection, inquiry, problem, points, &bytes, &hello)?)
            }
            (Answer::Cannot { reason }, _) => Err(printable(&reason)),
            (Answer::Failed { reason }, _) => return Err(format!("says: {}", printable(&reason))),
            (other, _) => return Err(format!("answered `problem` with `{}`", other.name())),
        })
    }
}

/// A hash of the command, of the files that its words name, and of what the solver says of itself.
/// Modules of its language and the like, which a program reads besides, are known by its version.
fn identity(command: &[String], hello: &Hello) -> u64 {
    let mut all = DefaultHasher::new();
    (command, format!("{hello:?}")).hash(&mut all);
    for word in command {
        // A folder or a device is no program.
        let is_file = fs::metadata(word).is_ok_and(|found| found.is_file());
        is_file.then(|| fs::read(word).ok()).flatten().hash(&mut all);
    }
    all.finish()
}

fn connected(command: &[String], limits: ProgramLimits) -> Result<(Connection, Hello), String> {
    let mut connection = Connection::start(command, limits)?;
    let harness = concat!("mpm-verify ", env!("CARGO_PKG_VERSION"));
    let message = json!({"protocol": PROTOCOL, "versions": VERSIONS, "harness": harness});
    connection.send(Outgoing::new("hello", message, false));
    let (answer, _) = connection.answer()?;
    let Answer::Hello(hello) = answer else {
        return Err(format!("answered `hello` with `{}`", answer.name()));
    };
    if !VERSIONS.contains(&hello.protocol) {
        let (theirs, [oldest, newest]) = (hello.protocol, VERSIONS);
        return Err(format!(
            "speaks version {theirs} of the protocol; expected version {oldest} or {newest}"
        ));
    }
    let name = &hello.name;
    if !is_solver_name(name) {
        return Err(format!(
            "is called `{}`: expected up to {LONGEST_NAME} letters, digits, `-`, `_` or `.`",
            printable(name)
        ));
    }
    if !(hello.formal_order > 0.0 && hello.formal_order <= HIGHEST_ORDER) {
        return Err(format!(
            "has the formal order {}: expected one up to {HIGHEST_ORDER}",
            hello.formal_order
        ));
    }
    Ok((connection, hello))
}

impl SolverFactory for SolverProgram {
    fn name(&self) -> &str {
        &self.hello.name
    }

    fn formal_order(&self) -> f64 {
        self.hello.formal_order
    }

    fn precision(&self) -> Precision {
        self.hello.precision
    }

    fn settings(&self) -> Vec<(String, String)> {
        let version = printable(&self.hello.version);
        let version = if version.is_empty() { "not said".to_owned() } else { version };
        vec![
            ("solver".to_owned(), self.hello.name.clone()),
            ("version".to_owned(), version),
            ("precision".to_owned(), self.hello.precision.name().to_owned()),
            ("formal order".to_owned(), format!("{}, by its own account", self.hello.formal_order)),
        ]
    }

    fn identity(&self) -> Option<u64> {
        Some(self.identity)
    }

    fn lacks(&self, needs: &ProblemNeeds) -> Vec<String> {
        let mut lacking = self.hello.capabilities.known.lacking(needs);
        if self.hello.protocol == 1 {
            // What is lacking for another reason too is reported once.
            let stated = needs.beyond_version_1().into_iter();
            let stated = stated.filter(|need| !lacking.iter().any(|known| known.starts_with(need)));
            let new: Vec<String> = stated
                .map(|need| format!("{need} (handed over in version 2 of the protocol only)"))
                .collect();
            lacking.extend(new);
        }
        lacking
    }

    fn subject(&self, problem: LevelProblem) -> Result<Box<dyn Subject>, String> {
        match self.start(&problem) {
            Ok(Ok(subject)) => Ok(Box::new(subject)),
            Ok(Err(cannot)) => Err(cannot),
            Err(broken) => Ok(Box::new(Broken(broken))),
        }
    }
}

/// A solver that failed before its first step.
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
