//! Phase speed and damping of a wave, measured in a run and compared with a prediction.
//!
//! | module | content |
//! |---|---|
//! | [`recurrence`](Recurrence) | trace and determinant of a step, computed from a series |
//! | [`wave`](run_wave) | the run of a solver, whose particle velocities form the series |
//! | [`study`](SpectrumStudy) | the rows of a report |
//! | [`expectation`](SpectrumExpectation) | expectations of suites |

mod expectation;
mod recurrence;
mod study;
mod wave;

pub use expectation::SpectrumExpectation;
pub use recurrence::Recurrence;
pub use study::{SpectrumRow, SpectrumStudy, WaveFigures};
pub use wave::{AMPLITUDE, MeasuredWave, ObservedWave, PERIODS, run_wave, steps_of_run};
