//! Bytes become two snapshots or JSON documents, which are compared or refused, and never panic.

#![no_main]

#[path = "../../it/fuzz_input/compare_input.rs"]
mod compare_input;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| compare_input::differences(bytes));
