//! All tests of the library and of the program from outside, in one binary.

mod allocation;
mod bad_input;
mod bodies;
mod cli;
mod closed_forms;
mod common;
mod conservation;
mod determinism;
mod documents;
mod effects;
mod external;
mod false_alarms;
mod fem;
mod figure;
mod formula;
mod fuzz_corpus;
mod judge;
mod motions;
mod mpm;
mod pitfalls;
mod schema;
mod study;
mod testing;
