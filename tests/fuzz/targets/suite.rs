//! Bytes become the text of a suite, which is accepted or refused with a place, and never panics.

#![no_main]

#[path = "../../it/fuzz_input/suite_input.rs"]
mod suite_input;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| suite_input::load(bytes));
