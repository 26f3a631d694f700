//! All tests of the library and of the program from outside, in one binary.

mod bad_input;
mod cli;
mod closed_forms;
mod common;
mod documents;
mod external;
mod false_alarms;
mod fem;
mod figure;
mod formula;
mod fuzz_corpus;
mod judge;
mod motions;
mod schema;
mod study;
mod testing;
