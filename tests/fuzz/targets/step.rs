//! Bytes become particles, a method and a law; three steps owe numbers or the particle to blame.

#![no_main]

#[path = "../../../crates/solvers/tests/solver/conservation/hostile/scene.rs"]
mod scene;
#[path = "../../../crates/solvers/tests/solver/conservation/hostile/step_input.rs"]
mod step_input;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| step_input::step(bytes));
