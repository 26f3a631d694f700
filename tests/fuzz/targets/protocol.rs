//! Bytes become answers of a solver, which are read or refused, and never panic.

#![no_main]

#[path = "../../it/fuzz_input/protocol_input.rs"]
mod protocol_input;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| protocol_input::answers(bytes));
