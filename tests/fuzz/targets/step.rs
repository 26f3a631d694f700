//! Bytes become particles, a method and a law; three steps owe numbers or the particle to blame.

#![no_main]

#[path = "../../it/fuzz_input/scene.rs"]
mod scene;
#[path = "../../it/fuzz_input/step_input.rs"]
mod step_input;

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| step_input::step(bytes));
