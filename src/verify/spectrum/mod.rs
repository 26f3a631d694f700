//! Phase speed and damping of a wave, measured from a run and compared with a prediction.
//!
//! | module | content |
//! |---|---|
//! | [`recurrence`](Recurrence) | trace and determinant of a step, from a series |
//! | [`wave`](run_wave) | a run of a subject, whose particle velocities give the series |
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
