//! Runs a command that implements the protocol of docs/protocol.md.

mod answer;
mod connection;
mod error;
mod frame;
mod inquiry;
mod results;
mod schema;
mod solver;
mod subject;
#[cfg(test)]
mod tests;

pub use connection::ProgramLimits;
pub use error::ProgramError;
pub use results::{ResultFolder, ResultLevel};
pub use schema::protocol_schema;
pub use solver::SolverProgram;

use answer::Answer;
use std::sync::atomic::AtomicUsize;

#[doc(hidden)]
/// Parses `bytes` like the output of a solver process, including all columns, until an answer
/// violates the protocol. Returns the number of valid answers. Used by the fuzzer.
pub fn read_answers(mut bytes: &[u8]) -> usize {
    let longest = AtomicUsize::new(bytes.len());
    let mut count = 0;
    while let Ok(Some(frame)) = frame::read_one(&mut bytes, &longest) {
        let Ok(answer) = Answer::read(&frame) else { break };
        if answer.columns().into_iter().any(|(name, column)| {
            let entries = column.count();
            column.numbers(&name, entries, &frame.bytes).is_err()
        }) {
            break;
        }
        count += 1;
    }
    count
}
