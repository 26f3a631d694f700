//! Bytes become the text of a formula, which is refused or has values, and never panics.

#![no_main]

#[path = "../../it/fuzz_input/formula_input.rs"]
mod formula_input;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| formula_input::evaluate(bytes));
