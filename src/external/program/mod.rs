//! A command that speaks the protocol of docs/protocol.md.
//!
//! ```text
//! solver       greets the command, and starts it for each level
//! connection   the process: requests in, answers out, within limits of time and memory
//! reader       answers, as they come
//! frame        one message: a line of JSON, and a block of bytes
//! answer       what a solver may say
//! hello        the first answer of a solver
//! column       columns of numbers
//! request      requests of a solver for values
//! inquiry      the answers to these
//! subject      a level on its way
//! schema       all messages as a JSON Schema
//! ```

mod answer;
mod column;
mod connection;
mod frame;
mod hello;
mod inquiry;
mod limits;
mod printable;
mod reader;
mod request;
mod schema;
mod solver;
mod subject;

/// Number of sound answers in bytes, read as those of a solver: for the fuzzer.
#[doc(hidden)]
pub fn read_answers(bytes: &[u8]) -> usize {
    reader::read_answers(bytes)
}

pub use limits::ProgramLimits;
pub use schema::protocol_schema;
pub use solver::SolverProgram;
