//! Phase speed and damping of a wave, measured in a run and compared with a prediction.

mod expectation;
mod recurrence;
mod study;
mod wave;

pub use expectation::SpectrumExpectation;
pub use recurrence::Recurrence;
pub use study::{SpectrumRow, SpectrumStudy, WaveFigures};
pub use wave::{AMPLITUDE, MeasuredWave, ObservedWave, PERIODS, run_wave, steps_of_run};
